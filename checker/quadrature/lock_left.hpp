// The left side of the inequality of docs/gaussian.md, (6), l without d: a lower bound over a box.
#pragma once

#include <array>
#include <functional>

#include "checker/quadrature/lock_level.hpp"

namespace veritrack::checker {

/// At the corners of a box.
using LockCorners = std::array<Ball, kLockCorners>;

/// For levels t of the images, one at each corner of a box: l there, for the inequality
///     E exp(|S (e+ - f)|^2/2) <= exp(l/2),  S = `next`, f = `offset`.
/// Between the corners l is at least the function that is affine along each variable and has these values
/// there, minus a convex one.
struct LockLeft {
  Metric next;
  std::function<LockCorners(const LockBox&, const LockCorners&)> at_corners;
  /// In the middle of the box, roughly, for this level of the image.
  std::function<double(const LockBox&, double)> near_middle;
  std::array<Ball, 3> offset = {};
};

/// |u|^2 + gamma s^2 in the middle of the box, roughly.
double near_twice_level(const LockSet& set, const LockBox& box);

/// (1 + room) T.
Metric with_lock_room(const Metric& metric);

/// For E W+ <= kappa W + c_0, with room for the rounding of a step: docs/gaussian.md, (7).
LockLeft left_of_drift(const LockSet& set);

/// A function that bounds the mean square of the frequency error nu in lock, docs/gaussian.md, section 14:
/// U = |R (e - f)|^2 + g s(P)^2 + beta W.
struct LockMeanSquare {
  Metric metric;                    ///< R
  Ball weight, share, rate, bound;  ///< g, beta, h, c
  std::array<Ball, 3> offset = {};  ///< f; zero without a leak
};

/// For E U+ <= U + h (c - nu^2), with room for the rounding of a step. `metric.frequency`^2 must be at least
/// `rate`, and the other numbers must have their signs.
LockLeft left_of_mean_square(const LockSet& set, const LockMeanSquare& mean_square);

/// At least |R x|^2/|T x|^2 for every x.
Ball relative_norm_squared(const LockMeanSquare& mean_square, const LockSet& set);

/// |R f|.
Ball offset_length(const LockMeanSquare& mean_square);

}  // namespace veritrack::checker
