// Proposals, in floating point, of the bounds between which the covariance stays.
#pragma once

#include <array>
#include <optional>

#include "analysis/quadrature/contraction/riccati_order.hpp"

namespace veritrack::quadrature {

/// The steady state of riccati_update at |z| = 1; nothing when there is none that is positive definite (q1 =
/// 0: the amplitude's variance falls like 1/k for ever) or it was not reached.
[[nodiscard]] std::optional<BlockCovariance<double>> steady_covariance(
    const trackers::ToneModel<double>& design);

/// Two covariances in the Loewner order.
struct CovarianceRange {
  BlockCovariance<double> lower, upper;
};

/// A value of |z| and the tangent of the turn that goes with it.
struct TurnSample {
  double rho;
  double tangent;
};

/// Upper and lower bounds in the Loewner order, in coordinates in which the steady state is the identity.
class CovarianceBounds {
 public:
  explicit CovarianceBounds(const BlockCovariance<double>& steady);

  [[nodiscard]] BlockCovariance<double> lower() const { return leave(low_); }
  [[nodiscard]] BlockCovariance<double> upper() const { return leave(high_); }
  /// Moves both bounds out until they hold the range, with a margin (in units of the steady state).
  void include(const CovarianceRange& range, double margin);
  /// Moves both bounds to bounds of their images under the samples, with a margin (in units of the steady
  /// state). Returns how far they moved.
  double iterate(const std::array<TurnSample, 9>& samples, const trackers::ToneModel<double>& design,
                 double margin);
  /// Finite, ordered, and of a size that can be of use.
  [[nodiscard]] bool usable() const;

 private:
  [[nodiscard]] BlockCovariance<double> enter(const BlockCovariance<double>& p) const;
  [[nodiscard]] BlockCovariance<double> leave(const BlockCovariance<double>& p) const;
  [[nodiscard]] BlockCovariance<double> image(const BlockCovariance<double>& p, const TurnSample& sample,
                                              const trackers::ToneModel<double>& design, double sign) const;

  double l11_, l22_, l32_, l33_;  ///< Cholesky factor of the steady state
  BlockCovariance<double> low_, high_;
};

}  // namespace veritrack::quadrature
