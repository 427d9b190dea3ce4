#include "analysis/quadrature/contraction/certified_set.hpp"

#include "analysis/rigor/definiteness.hpp"

namespace veritrack::quadrature {

using rigor::Interval;
using rigor::IntervalMatrix;
using rigor::IntervalVector;

Interval metric_norm(const CertifiedSet& set, const IntervalVector<3>& error) {
  const IntervalVector<3> image = rigor::to_interval(set.metric) * error;
  return sqrt(square(image[0]) + square(image[1]) + square(image[2]));
}

bool certainly_contains(const CertifiedSet& set, const IntervalVector<3>& error,
                        const IntervalMatrix<3>& covariance VERITRACK_DECLARED_CALL_SITE) {
  VERITRACK_MUTANT_RETURNS(true)
  const IntervalMatrix<3> above = covariance - rigor::to_interval(set.covariance_lower);
  const IntervalMatrix<3> below = rigor::to_interval(set.covariance_upper) - covariance;
  return rigor::is_finite(covariance) &&
         certainly_less_equal(metric_norm(set, error), Interval(set.radius)) &&
         rigor::is_positive_definite(above) == rigor::Verdict::proved &&
         rigor::is_positive_definite(below) == rigor::Verdict::proved;
}

IntervalVector<3> error_bounds(const CertifiedSet& set, const Interval& level) {
  // T = diag(t_a, [[t22, t23], [0, t33]]): the inverse is written down.
  const IntervalMatrix<3> t = rigor::to_interval(set.metric);
  IntervalVector<3> bounds;
  bounds[0] = level / abs(t(0, 0));
  bounds[1] = level * sqrt(square(Interval(1.0) / t(1, 1)) + square(t(1, 2) / (t(1, 1) * t(2, 2))));
  bounds[2] = level / abs(t(2, 2));
  const bool has_the_form = set.metric(0, 1) == 0.0 && set.metric(0, 2) == 0.0 && set.metric(1, 0) == 0.0 &&
                            set.metric(2, 0) == 0.0 && set.metric(2, 1) == 0.0;
  if (!has_the_form) {
    bounds.setConstant(Interval::empty());
  }
  return bounds;
}

namespace {

/// The amount that noise and slew add to |T e|^2.
Interval pushed(const CertifiedSet& set, const Interval& noise, const Interval& slew) {
  return rigor::square(Interval(set.noise_gain) * noise) + rigor::square(Interval(set.slew_gain) * slew);
}

}  // namespace

Interval next_level(const CertifiedSet& set, const Interval& level, const Interval& noise,
                    const Interval& slew) {
  return rigor::sqrt(rigor::square(Interval(set.rate) * level) + pushed(set, noise, slew)) +
         Interval(set.error_rounding);
}

Interval ultimate_level(const CertifiedSet& set, const Interval& noise, const Interval& slew) {
  // (u - rounding)^2 = rate^2 u^2 + pushed.
  const Interval rounding(set.error_rounding);
  const Interval rate_squared = rigor::square(Interval(set.rate));
  const Interval left = Interval(1.0) - rate_squared;
  return (rounding + rigor::sqrt(rate_squared * rigor::square(rounding) + left * pushed(set, noise, slew))) /
         left;
}

}  // namespace veritrack::quadrature
