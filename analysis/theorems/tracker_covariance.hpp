// Bounds on the quadrature tracker's covariance P(k|k) along every run whose estimates stay near the signal,
// from the sound Riccati bounds of riccati_bounds.hpp.
//
// In the frame of the estimated phase the tracker's covariance obeys the Riccati equation of a linear
// time-varying system with two unknowns a step: the estimated amplitude rho = |z(k|k)| and the turn theta by
// which the measurement moved the estimated phase,
//     F(k) = U(-theta(k+1)) [[1,0,0], [0,1,rho(k)], [0,0,1-epsilon]],   U(theta) = diag(Rot(theta), 1),
// with H = [I 0], Q = diag(q1,q1,q2) and R = r I, which are invariant under U. All functions need the upward
// rounding mode.
#pragma once

#include <optional>

#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/verdict.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"

namespace veritrack::theorems {

using IntervalDesign = trackers::ToneModel<rigor::Interval>;

/// Bounds on the estimation errors, relative to a signal of amplitude 1.
struct ErrorBounds {
  rigor::Interval plane_error;      ///< |z(k|k) - z(k)| <= plane_error < 1, signal units
  rigor::Interval frequency_error;  ///< |x3(k|k) - x3(k)| <= frequency_error, rad/sample

  /// |z(k|k)|.
  [[nodiscard]] rigor::Interval amplitude() const;
  /// U(theta) for every turn that occurs. The phase errors of z(k|k) and its prediction are at most
  /// asin(plane_error), plus frequency_error for the prediction.
  [[nodiscard]] rigor::IntervalMatrix<3> turn() const;
};

/// Matrices of points with P(k|k) <= upper and P(k|k)^-1 <= information, in the frame of the predicted phase.
struct MatrixRange {
  rigor::IntervalMatrix<3> upper, information;
};

/// A matrix of points that is at least every symmetric 3x3 matrix in `matrix`; nothing when an entry is not
/// finite.
[[nodiscard]] std::optional<rigor::IntervalMatrix<3>> point_above(const rigor::IntervalMatrix<3>& matrix);

/// F(rho), the Jacobian in the frame of the estimated phase.
[[nodiscard]] rigor::IntervalMatrix<3> own_frame_transition(const rigor::Interval& amplitude,
                                                            const rigor::Interval& epsilon);

/// The range for all k > window when every estimate keeps the bounds; nothing when it could not be verified
/// (for example because q1 may be zero and the window is 1). `window` >= 1 is N of riccati_bounds.hpp.
[[nodiscard]] std::optional<MatrixRange> matrix_range(const IntervalDesign& design, const ErrorBounds& tube,
                                                      int window);

/// Does P(k|k) also lie in the range for k = 0, ..., window, when the filter starts with P(0|0) = `start` (in
/// the frame of the estimated phase) and every estimate keeps the bounds? Nothing is refuted.
[[nodiscard]] rigor::Verdict decide_start(const rigor::IntervalMatrix<3>& start, const MatrixRange& range,
                                          const IntervalDesign& design, const ErrorBounds& tube, int window);

}  // namespace veritrack::theorems
