// Bounds on the quadrature tracker's covariance that are invariant under the Riccati recursion: an order
// interval that every step maps into itself. For small estimation errors it is sharper than the bounds of a
// window (tracker_covariance.hpp), and it is valid from k = 0 on when it contains P(0|0).
#pragma once

#include <optional>

#include "analysis/theorems/tracker_covariance.hpp"

namespace veritrack::theorems {

/// A range in which P(k|k) stays for ever if P(0|0) lies in it and every estimate stays in the tube. Proposed
/// in floating point, as the steady states of filters that inflate, or deflate, F P F' by a share of it;
/// verified: with Phi(P) the covariance after a step, Phi(U upper U') <= upper and Phi(U lower U') >= lower
/// for every amplitude and turn of the tube, which suffices because Phi is monotone. The steady state along
/// exact estimates lies in the range. Nothing when no proposal was verified. Needs the upward rounding mode.
[[nodiscard]] std::optional<MatrixRange> invariant_range(const IntervalDesign& design,
                                                         const ErrorBounds& tube);

/// The range between two proposed matrices, when the order interval that they bound is verified as above and
/// `lower` is positive definite. Needs the upward rounding mode.
[[nodiscard]] std::optional<MatrixRange> verified_range(const Eigen::Matrix3d& upper,
                                                        const Eigen::Matrix3d& lower,
                                                        const IntervalDesign& design,
                                                        const ErrorBounds& tube);

}  // namespace veritrack::theorems
