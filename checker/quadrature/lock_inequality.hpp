// Is E exp(|S (e+ - f)|^2/2) <= exp(l/2) in a cell of (T e, s)? The checker's own proof of (4) of
// docs/gaussian.md, and of the inequality of section 14.
#pragma once

#include <array>
#include <cstddef>

#include "checker/quadrature/lock_left.hpp"

namespace veritrack::checker {

/// A box of (u1, u2, u3, s), u = T e.
struct LockCell {
  std::array<double, 4> low, high;
};

/// The finding on a cell.
struct LockLook {
  bool proved = false;
  bool hopeless = false;  ///< in the middle the inequality seems to fail: a matter of speed
  std::size_t side = 0;   ///< which variable to bisect, if not proved
};

class LockInequality {
 public:
  /// The set must have its form and its signs (lock_set.hpp).
  LockInequality(const LockFilter& filter, const LockSet& set, LockLeft left);

  /// True only when no point of the cell has a level of at most L.
  [[nodiscard]] bool outside(const LockCell& cell) const;
  /// `proved` is true only when the inequality of `left` is true for all (u, s) in the cell and all
  /// covariances of level s or less, t being a level of their images.
  [[nodiscard]] LockLook look(const LockCell& cell) const;

 private:
  struct Forms;
  [[nodiscard]] bool seems_to_fail(const LockBox& box, const LockStep& step, const Forms& forms) const;
  /// For l at the corners of the box.
  [[nodiscard]] bool proves(Forms& forms, const LockCorners& rest) const;

  LockFilter filter_;
  LockSet set_;
  LockLeft left_;
  LockLevels levels_;
  SquareMatrix<lock_form::kSize> constant_;
  lock_proposal::Matrix6 rough_constant_;
  Ball walk_loss_;  ///< log(1 - w^2 |S e3|^2)
  double rough_deviation_, rough_r_;
};

}  // namespace veritrack::checker
