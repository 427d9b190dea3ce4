// A level of the images of a step over a cell: (3) of docs/gaussian.md.
#pragma once

#include <array>

#include "checker/quadrature/lock_proposal.hpp"

namespace veritrack::checker {

/// A box around the middle of a cell in (u, s), u = T e.
struct LockBox {
  explicit LockBox(const std::array<double, 4>& low, const std::array<double, 4>& high);

  std::array<Ball, kSides> middle, half_widths;
  std::array<Chord, kSides> u;
  Ball level;
  std::array<Ball, 2> ends;  ///< of the level, from `level`
};

/// The corners of the box: the bits 0 to 2 are the ends of u, bit 3 that of s.
constexpr std::size_t kLockCorners = 16;

class LockLevels {
 public:
  /// `next` is the metric of the coordinates in which the images are compared.
  LockLevels(const LockSet& set, const Metric& next);

  /// Finds numbers at the corners of the box, none of them negative, such that the function t of (u, s) that
  /// is affine along each variable and has these values at the corners is a level of the image of every
  /// covariance of level s or less, everywhere in the box. False when none are found.
  [[nodiscard]] bool find(const LockBox& box, const LockStep& step,
                          std::array<Ball, kLockCorners>& levels) const;
  /// The least level of the images in the middle of the box, roughly.
  [[nodiscard]] double near_middle(const LockStep& step) const;

 private:
  [[nodiscard]] bool is_level(const SquareMatrix<3>& upper, const SquareMatrix<3>& lower,
                              const Ball& level) const;

  Metric next_;
  // In the coordinates next e: P_0, D_h, P_0^-1, D_l.
  LockCovariance centre_, above_, centre_inverse_, below_;
  lock_proposal::LevelOf level_of_;
};

}  // namespace veritrack::checker
