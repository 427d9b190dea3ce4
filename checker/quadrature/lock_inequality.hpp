// Does the expected value of W = exp(level) shrink, but for the drift, in a cell of (T e, s)? With room for
// the rounding of a step: the checker's own proof of (4) of docs/gaussian.md.
#pragma once

#include <array>
#include <cstddef>

#include "checker/quadrature/lock_level.hpp"

namespace veritrack::checker {

/// A box of (u1, u2, u3, s), u = T e.
struct LockCell {
  std::array<double, 4> low, high;
};

/// What a look at a cell found.
struct LockLook {
  bool proved = false;
  bool hopeless = false;  ///< in the middle the inequality seems to fail: a matter of speed
  std::size_t side = 0;   ///< which variable to bisect, if not proved
};

class LockInequality {
 public:
  /// The set must have its form and its signs (lock_set.hpp).
  LockInequality(const LockFilter& filter, const LockSet& set);

  /// True only when no point of the cell has a level of at most L.
  [[nodiscard]] bool outside(const LockCell& cell) const;
  /// `proved` is true only when
  ///   E[exp((1 + room) |T e+|^2/2)] exp(gamma (t + room)^2/2) exp(room) <= kappa W + c_0
  /// for all (u, s) in the cell and all covariances of level s or less, t being a level of their images.
  [[nodiscard]] LockLook look(const LockCell& cell) const;

 private:
  struct Forms;
  using Rests = std::array<Ball, kLockCorners>;
  /// l at the corners of the box, for these levels of the images.
  [[nodiscard]] Rests rests(const LockBox& box, const Rests& levels) const;
  [[nodiscard]] bool seems_to_fail(const LockBox& box, const LockStep& step, const Forms& forms) const;

  LockFilter filter_;
  LockSet set_;
  Metric next_;  ///< (1 + room) T
  LockLevels levels_;
  SquareMatrix<lock_form::kSize> constant_;
  lock_proposal::Matrix6 rough_constant_;
  Ball walk_loss_;  ///< log(1 - w^2 |T e3|^2)
  double rough_deviation_, rough_r_;
};

}  // namespace veritrack::checker
