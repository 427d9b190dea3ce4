// The level of a covariance, and how it changes along a step: proposals in floating point.
#pragma once

#include <array>

#include "analysis/quadrature/gaussian/level_step.hpp"

namespace veritrack::quadrature {

/// A level t of the images of a step, with its slopes.
struct LevelSlope {
  double level = 0.0;
  std::array<double, 3> along{};  ///< u1, u2, u3
  double with_level = 0.0;        ///< s
};

/// The least t with Psi_hi <= hi(t) and Psi_lo >= lo(t), and its first-order change: `derivatives` are those
/// of the images along u. NaN when the images are not definite.
[[nodiscard]] LevelSlope propose_level(const LockSetting<double>& setting, const LevelStep<double>& step,
                                       const std::array<LevelStep<double>, 3>& derivatives);

}  // namespace veritrack::quadrature
