// The quadratic forms whose positivity certificates/coq/ekf/leaf.v asks for, for a proposal of what Coq will
// accept. Frame of the true phase: e = (Re d, Im d, nu), d = z e^{-i phi} - 1, nu = x3 - omega; amplitude 1.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "analysis/rigor/interval.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::quadrature {

/// The errors e with e' M e <= 1, and the covariances between two; N is just below M^-1. All are exact
/// numbers.
struct ErrorEllipsoid {
  Eigen::Matrix3d shape;    ///< M
  Eigen::Matrix3d inverse;  ///< N
  Eigen::Matrix3d lowest;   ///< of the covariances, in the frame of the true phase
  Eigen::Matrix3d highest;
  double kappa2 = 1.0;      ///< e+' M e+ <= kappa2 e' M e + noise_gain |v|^2 + slew_gain w^2
  double noise_gain = 0.0;  ///< signal units^-2
  double slew_gain = 0.0;   ///< (rad/sample)^-2
};

/// The record of a box of errors: see the record `leaf` of leaf.v.
struct CellNumbers {
  Eigen::Matrix3d lowest, highest;  ///< bounds on the covariance after the step, before it is turned
  Eigen::Matrix<double, 3, 2> gain;
  double lambda = 0.0, mu = 0.0;
};

/// A box of e.
struct ErrorBox {
  std::array<rigor::Interval, 3> sides;
};

/// Are the forms of leaf.v positive over the box? The names are those of the forms there. All need the upward
/// mode.
[[nodiscard]] bool upper_form_is_positive(const trackers::ToneModel<double>& design,
                                          const ErrorEllipsoid& set, const CellNumbers& cell,
                                          const ErrorBox& box);
[[nodiscard]] bool lower_form_is_positive(const trackers::ToneModel<double>& design,
                                          const ErrorEllipsoid& set, const CellNumbers& cell,
                                          const ErrorBox& box);
[[nodiscard]] bool error_form_is_positive(const trackers::ToneModel<double>& design,
                                          const ErrorEllipsoid& set, const CellNumbers& cell,
                                          const ErrorBox& box);

/// Is `inner`, turned by any angle of the interval, below `outer` (or above, for `outer_is_below`)?
[[nodiscard]] bool is_inside_when_turned(const Eigen::Matrix3d& inner, const Eigen::Matrix3d& outer,
                                         const rigor::Interval& angle, bool outer_is_below);

/// Is e' M e > 1 everywhere in the box?
[[nodiscard]] bool is_outside(const ErrorEllipsoid& set, const ErrorBox& box);

}  // namespace veritrack::quadrature
