// The bounds that several certified sets prove together for the assumed starts, noise and slew.
#pragma once

#include <optional>
#include <vector>

#include "analysis/quadrature/contraction/start_bounds.hpp"

namespace veritrack::quadrature {

/// Each set proves its own bounds; the best are taken. All members need the upward mode.
class Promises {
 public:
  /// The sets must be certified for at least the noise and slew of the question. If none of them contains the
  /// assumed starts, the bounds are for every start in the first.
  Promises(const sets::ContractionQuestion& question, const std::vector<CertifiedSet>& sets);

  /// True only when some set contains every assumed start.
  [[nodiscard]] bool starts_inside() const { return starts_inside_; }
  /// A bound on |frequency error| in the long run, rad/sample: that of a set that contains the starts, or of
  /// one into which such a set is mapped. Empty when there is no set.
  [[nodiscard]] const rigor::Interval& ultimate_frequency_error() const { return ultimate_; }
  /// A bound on |frequency error| at every sample, rad/sample. Empty when there is none.
  [[nodiscard]] rigor::Interval frequency_error_bound() const;
  /// A frequency error (rad/sample), and a number of samples after which it is not exceeded: the required
  /// settled error, or twice the ultimate one where none is required or no set gives a number for it.
  struct Settling {
    rigor::Interval frequency_error, samples;
  };
  [[nodiscard]] std::optional<Settling> settling() const;
  /// True only when all that is required of the assumed starts is certainly so.
  [[nodiscard]] bool satisfy(const sets::RequiredBounds& required VERITRACK_CALL_SITE) const;
  /// The multiples of the start covariance for which all this is true; nothing when no set contains the
  /// starts.
  [[nodiscard]] const std::optional<rigor::Interval>& covariance_multiples() const { return multiples_; }

 private:
  /// The smallest number of samples that a set gives; empty when none does.
  [[nodiscard]] rigor::Interval samples_until(const rigor::Interval& frequency_error) const;

  std::vector<StartBounds> bases_;  ///< of the sets that contain the starts
  bool starts_inside_ = false;
  bool disturbed_ = false;  ///< by noise or slew: what rounding alone leaves, nobody waits for
  rigor::Interval ultimate_;
  std::optional<double> settled_;
  std::optional<rigor::Interval> multiples_;
};

}  // namespace veritrack::quadrature
