// A search for an ellipsoid of errors in the frame of the true phase that the tracker without a leak never
// leaves, with the boxes with which Coq proves it. Nothing here is evidence: Coq checks the numbers.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "analysis/quadrature/true_phase/cell_cover.hpp"

namespace veritrack::quadrature {

/// The request for the ellipsoid, at amplitude 1.
struct EllipsoidQuestion {
  trackers::ToneModel<double> design;                                      ///< epsilon = 0
  double noise = 0.0;                                                      ///< |v(k)| <= noise
  double slew = 0.0;                                                       ///< rad/sample per sample
  double amplitude_error = 0.0, phase_error = 0.0, frequency_error = 0.0;  ///< of the start, in size
  Eigen::Matrix3d start_lowest, start_highest;  ///< of P(0|0), in the frame of the estimated phase
};

struct CoveredEllipsoid {
  ErrorEllipsoid set;
  std::unique_ptr<CellTree> cells;
};

/// Where the frequency error is to be small: at all samples, or in the long run.
enum class EllipsoidAim { for_ever, in_the_long_run };

/// The least bound on the frequency error that is found; none where nothing is found. Deterministic. Needs
/// the upward mode.
[[nodiscard]] std::optional<CoveredEllipsoid> search_ellipsoid(const EllipsoidQuestion& question,
                                                               EllipsoidAim aim);

/// The share u of e' M e = 1 that noise and slew hold up: e' M e falls to u. At most 1.
[[nodiscard]] double ultimate_level(const EllipsoidQuestion& question, const ErrorEllipsoid& set);

/// The covariance after one step from `covariance` with the errors e1, e2, in the frame of the prediction.
[[nodiscard]] Eigen::Matrix3d covariance_after(const trackers::ToneModel<double>& design,
                                               const Eigen::Matrix3d& covariance, double e1, double e2);
/// The gain of that step.
[[nodiscard]] Eigen::Matrix<double, 3, 2> gain_at(const trackers::ToneModel<double>& design,
                                                  const Eigen::Matrix3d& covariance, double e1, double e2);

/// With 40 significant bits, so that exactly the checked numbers are written.
[[nodiscard]] double stored(double x);
template <typename Matrix>
[[nodiscard]] Matrix stored(const Matrix& x) {
  return x.unaryExpr([](double entry) { return stored(entry); });
}

}  // namespace veritrack::quadrature
