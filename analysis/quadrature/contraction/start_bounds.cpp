#include "analysis/quadrature/contraction/start_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/rigor/definiteness.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::quadrature {

using rigor::Interval;
using rigor::IntervalVector;

bool certainly_maps_into(const CertifiedSet& outer, const CertifiedSet& inner, const Interval& noise,
                         const Interval& slew VERITRACK_DECLARED_CALL_SITE) {
  VERITRACK_MUTANT_RETURNS(true)
  // |T e| comes below any level above the ultimate one after finitely many samples.
  const Interval above_one(1.0 + 0x1p-20);
  const IntervalVector<3> bounds = error_bounds(outer, above_one * ultimate_level(outer, noise, slew));
  IntervalVector<3> errors;
  for (int i = 0; i < 3; ++i) {
    errors[i] = rigor::symmetric(bounds[i].upper());
  }
  const auto ordered = [](const rigor::Matrix<3>& low, const rigor::Matrix<3>& high) {
    return rigor::is_positive_definite(rigor::IntervalMatrix<3>(
               rigor::to_interval(high) - rigor::to_interval(low))) == rigor::Verdict::proved;
  };
  return certainly_positive(ultimate_level(outer, noise, slew)) &&
         certainly_less_equal(metric_norm(inner, errors), Interval(inner.radius)) &&
         ordered(inner.covariance_lower, outer.covariance_lower) &&
         ordered(outer.covariance_upper, inner.covariance_upper);
}

StartBounds::StartBounds(const sets::ContractionQuestion& question, const CertifiedSet& set)
    : set_(set), ultimate_level_(veritrack::quadrature::ultimate_level(set, question.noise, question.slew)) {
  IntervalVector<3> start;
  start << rigor::symmetric(question.initial_amplitude_error.upper()),
      rigor::symmetric(question.initial_phase_error.upper()),
      rigor::symmetric(question.initial_frequency_error.upper());
  start_level_ = metric_norm(set, start);
  if (question.start_covariance) {
    multiples_ =
        sets::multiples_between(*question.start_covariance, set.covariance_lower, set.covariance_upper);
  }
  contains_starts_ = multiples_ && certainly_less_equal(start_level_, Interval(set.radius));
}

Interval StartBounds::ultimate_frequency_error() const {
  return error_bounds(set_, ultimate_level_)[2];
}

Interval StartBounds::frequency_error_bound() const {
  // next_level does not exceed the larger of l and u, if l does not.
  const double start = contains_starts_ ? start_level_.upper() : set_.radius;
  return error_bounds(set_, Interval(std::max(start, ultimate_level_.upper())))[2];
}

std::optional<Interval> StartBounds::samples_until(const Interval& frequency_error) const {
  // The level that keeps the frequency error below the one asked for: |nu| <= level / |t33|.
  const Interval level = frequency_error * rigor::abs(Interval(set_.metric(2, 2)));
  const Interval start(contains_starts_ ? start_level_.upper() : set_.radius);
  const Interval room = rigor::square(level) - rigor::square(ultimate_level_);
  if (!certainly_positive(room)) {
    return std::nullopt;
  }
  if (certainly_less_equal(start, level)) {
    return Interval(0.0);
  }
  // rate'^(2k) (l^2 - u^2) + u^2 <= level^2; l^2 - u^2 is positive, since l may exceed the level, which
  // exceeds u. For l >= u a step takes l^2 - u^2 to at most rate'^2 (l^2 - u^2), where rate'^2 = rate^2 u/(u
  // - rounding): docs/rounding.md.
  const Interval excess = rigor::square(start) - rigor::square(ultimate_level_);
  Interval shrinking = rigor::square(Interval(set_.rate));
  if (set_.error_rounding > 0.0) {
    shrinking *= ultimate_level_ / (ultimate_level_ - Interval(set_.error_rounding));
  }
  const Interval samples = rigor::log(room / excess) / rigor::log(shrinking);
  const double count = std::ceil(samples.upper());
  // cannot bind (excess): the start is above the lower end of the level, and all of the level above u.
  return std::isfinite(count) && certainly_positive(excess) ? std::optional(Interval(std::max(count, 0.0)))
                                                            : std::nullopt;
}

}  // namespace veritrack::quadrature
