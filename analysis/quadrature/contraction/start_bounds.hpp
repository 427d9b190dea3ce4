// The bounds of a certified set for the assumed starts, noise and slew.
#pragma once

#include <optional>

#include "analysis/quadrature/contraction/certified_set.hpp"
#include "analysis/sets/contraction_question.hpp"

namespace veritrack::quadrature {

/// True only when every trajectory in `outer`, noise and slew as given, lies in `inner` from some sample on:
/// the ellipsoid that |T e| tends to in the one lies within that of the other, and so do the covariance
/// bounds. Needs the upward mode.
[[nodiscard]] bool certainly_maps_into(const CertifiedSet& outer, const CertifiedSet& inner,
                                       const rigor::Interval& noise,
                                       const rigor::Interval& slew VERITRACK_CALL_SITE);

/// The bounds of one set; the noise and slew of the question must not exceed those of the set. All members
/// need the upward mode.
class StartBounds {
 public:
  StartBounds(const sets::ContractionQuestion& question, const CertifiedSet& set);

  /// True only when every assumed start lies in the set, with every covariance of the question.
  [[nodiscard]] bool contains_starts() const { return contains_starts_; }
  [[nodiscard]] const CertifiedSet& set() const { return set_; }
  /// The multiples of the question's start covariance that lie between the bounds of the set; nothing when it
  /// does not itself.
  [[nodiscard]] const std::optional<rigor::Interval>& covariance_multiples() const { return multiples_; }
  /// The largest |T e(0)| that is assumed.
  [[nodiscard]] const rigor::Interval& start_level() const { return start_level_; }

  /// A bound on the limit of |frequency error|, from anywhere in the set, rad/sample.
  [[nodiscard]] rigor::Interval ultimate_frequency_error() const;
  /// A bound on |frequency error| at every sample, rad/sample; from the assumed starts if the set contains
  /// them, from anywhere in the set if not.
  [[nodiscard]] rigor::Interval frequency_error_bound() const;
  /// A number of samples after which |frequency error| is at most `frequency_error` (rad/sample), from the
  /// same starts; nothing when the set gives none.
  [[nodiscard]] std::optional<rigor::Interval> samples_until(const rigor::Interval& frequency_error) const;

 private:
  CertifiedSet set_;
  rigor::Interval start_level_, ultimate_level_;
  std::optional<rigor::Interval> multiples_;
  bool contains_starts_ = false;
};

}  // namespace veritrack::quadrature
