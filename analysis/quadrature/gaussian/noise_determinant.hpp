// What the noise of a step adds to the expected value of W, whatever the covariance: its determinant.
#pragma once

#include "analysis/quadrature/gaussian/drift_form.hpp"

namespace veritrack::quadrature {

/// -log det(I - Sigma M), docs/gaussian.md, section 5. Every function needs the upward mode.
class NoiseDeterminant {
 public:
  explicit NoiseDeterminant(const LockSetting<rigor::Interval>& setting);

  /// An upper bound over all covariances between the two images; infinite or empty when there is none.
  [[nodiscard]] rigor::Interval bound(const LevelImages<rigor::Interval>& images) const;

 private:
  rigor::Interval r_, noise_variance_;
  Symmetric<rigor::Interval> weight_;  ///< M_t = (M^-1 - w^2 e3 e3')^-1
  rigor::Interval walk_determinant_;   ///< det(I - w^2 e3 e3' M)
};

}  // namespace veritrack::quadrature
