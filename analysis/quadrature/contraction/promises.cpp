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

Promises::Promises(const sets::ContractionQuestion& question, const std::vector<CertifiedSet>& sets) {
  std::vector<StartBounds> others;
  for (const CertifiedSet& set : sets) {
    const StartBounds bounds(question, set);
    (bounds.contains_starts() ? bases_ : others).push_back(bounds);
  }
  starts_inside_ = !bases_.empty();
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

Interval Promises::settling_samples() const {
  Interval samples;
  // cannot bind (ultimate_): where it may be zero, samples_until finds no room above it.
  if (certainly_positive(ultimate_)) {
    for (const StartBounds& base : bases_) {
      samples = better(samples, base.samples_until(Interval(2.0) * ultimate_).value_or(Interval()));
    }
  }
  return samples;
}

}  // namespace veritrack::quadrature
