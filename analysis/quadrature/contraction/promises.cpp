#include "analysis/quadrature/contraction/promises.hpp"

#include <algorithm>

namespace veritrack::quadrature {

using rigor::Interval;

namespace {

/// The smaller upper bound, as a point; what is not finite does not count.
Interval better(const Interval& best, const Interval& other) {
  if (!rigor::is_finite(other)) {
    return best;
  }
  return Interval(rigor::is_finite(best) ? std::min(best.upper(), other.upper()) : other.upper());
}

}  // namespace

Promises::Promises(const sets::ContractionQuestion& question, const std::vector<CertifiedSet>& sets)
    : settled_(question.settled_frequency_error) {
  disturbed_ = certainly_positive(question.noise) || certainly_positive(question.slew);
  std::vector<StartBounds> others;
  for (const CertifiedSet& set : sets) {
    const StartBounds bounds(question, set);
    (bounds.contains_starts() ? bases_ : others).push_back(bounds);
  }
  starts_inside_ = !bases_.empty();
  for (const StartBounds& base : bases_) {
    const Interval multiples = base.covariance_multiples().value();
    multiples_ = multiples_ ? rigor::intersection(*multiples_, multiples) : multiples;
  }
  if (!starts_inside_ && !others.empty()) {
    bases_ = {others.front()};
  }
  for (const StartBounds& base : bases_) {
    ultimate_ = better(ultimate_, base.ultimate_frequency_error());
  }
  for (const StartBounds& inner : others) {
    const bool led_into = std::any_of(bases_.begin(), bases_.end(), [&](const StartBounds& base) {
      return certainly_maps_into(base.set(), inner.set(), question.noise, question.slew);
    });
    if (led_into) {
      ultimate_ = better(ultimate_, inner.ultimate_frequency_error());
    }
  }
}

Interval Promises::frequency_error_bound() const {
  Interval bound;
  for (const StartBounds& base : bases_) {
    bound = better(bound, base.frequency_error_bound());
  }
  return bound;
}

Interval Promises::samples_until(const Interval& frequency_error) const {
  Interval samples;
  for (const StartBounds& base : bases_) {
    samples = better(samples, base.samples_until(frequency_error).value_or(Interval()));
  }
  return samples;
}

bool Promises::satisfy(const sets::RequiredBounds& required VERITRACK_DECLARED_CALL_SITE) const {
  VERITRACK_MUTANT_RETURNS(true)
  if (!starts_inside_) {
    return false;
  }
  if (required.frequency_error &&
      !certainly_less(frequency_error_bound(), Interval(*required.frequency_error))) {
    return false;
  }
  if (!required.samples) {
    return true;
  }
  const std::optional<Settling> settled = settling();
  // cannot bind (settled->frequency_error): the level that is asked for is the first that is tried.
  return settled && settled_ && settled->frequency_error == Interval(*settled_) &&
         certainly_less_equal(settled->samples, Interval(*required.samples));
}

std::optional<Promises::Settling> Promises::settling() const {
  std::vector<Interval> levels;
  if (settled_) {
    levels.emplace_back(*settled_);
  }
  // cannot bind (ultimate_): no start is ever within 0, nor within what is no number.
  if (disturbed_ && certainly_positive(ultimate_)) {
    levels.emplace_back((Interval(2.0) * ultimate_).upper());
  }
  for (const Interval& level : levels) {
    const Interval samples = samples_until(level);
    if (rigor::is_finite(samples)) {
      return Settling{level, samples};
    }
  }
  return std::nullopt;
}

}  // namespace veritrack::quadrature
