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
  /// The same without rounding, and where there is none a number that grows with what is missing: for
  /// searches.
  [[nodiscard]] double roughly(const LevelImages<rigor::Interval>& images) const;
  /// The same over a cell: with derivatives, from its middle. `over` are the images there, `middle` those in
  /// the middle.
  [[nodiscard]] rigor::Interval bound_over(const LevelImages<rigor::Interval>& middle,
                                           const LevelImages<rigor::Dual<rigor::Interval, 3>>& over,
                                           const std::array<double, 3>& half_widths) const;

 private:
  /// A lower bound on 1 - tr(sigma^2 K'M_t K), which is at most det(I - sigma^2 K'M_t K).
  template <typename Scalar>
  [[nodiscard]] Scalar trace_bound(const LevelImages<Scalar>& images) const;
  /// An upper bound on the eigenvalues of sigma^2 K'M_t K, by the sum of norms, with the values of a cell.
  [[nodiscard]] rigor::Interval eigenvalue_bound(
      const LevelImages<rigor::Dual<rigor::Interval, 3>>& images) const;

  rigor::Interval r_, noise_variance_;
  SymmetricMatrix<rigor::Interval> weight_;  ///< M_t = (M^-1 - w^2 e3 e3')^-1
  rigor::Interval walk_determinant_;         ///< det(I - w^2 e3 e3' M)
};

}  // namespace veritrack::quadrature
