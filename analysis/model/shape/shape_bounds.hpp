// The worth of a shape around a curve, in floating point: bounds on a tracker's step in its coordinates to
// third order at the curve. For choosing a shape; nothing here is a claim.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "analysis/model/steady_state/curve_dynamics.hpp"

namespace veritrack::model {

/// A shape at the phases of the grid and one sample later: n^2 x grid.size(), lower triangular matrices.
struct ShapeOnGrid {
  Eigen::MatrixXd here, next;
};

/// Per phase: with |xi| <= R, |v| <= V, a slew W |zeta| <= W, to third order
///   |F| <= sqrt(linear^2 + (V^2/b + W^2/c)) + second R^2/2 + third R^3/6 + mixed R V + sample V^2/2,
/// linear = disturbed_rate R; without disturbances `rate` R.
struct PhaseBounds {
  double rate = 0.0;
  double disturbed_rate = 0.0;
  double second = 0.0, third = 0.0, mixed = 0.0, sample = 0.0;
  /// The R up to which the estimated frequency is nearly a linear function: R |U' h'' U| <= |grad h U|/2.
  double straight = 0.0;
  double reach = 0.0;  ///< |grad h U|: the largest deviation of the estimated frequency, for R = 1
};

/// Weights b of the noise and c of the slew. One may be 0: then that disturbance is absent.
struct DisturbanceWeights {
  double noise = 1.0;
  double slew = 0.0;
};

/// Empty when the shape or the weights do not fit anywhere.
[[nodiscard]] std::optional<std::vector<PhaseBounds>> bound_along(const CurveDynamics& dynamics,
                                                                  const ShapeOnGrid& shape,
                                                                  const DisturbanceWeights& weights);

/// The largest R with rate + second R/2 + third R^2/6 <= 1 and R <= straight at all phases; 0 when there is
/// none.
[[nodiscard]] double largest_start_level(const std::vector<PhaseBounds>& bounds);

/// The size of disturbances at a level that they never leave.
struct ToleratedDisturbance {
  double size = 0.0;
  double level = 0.0;
};
/// The largest noise, without slew, over all levels.
[[nodiscard]] ToleratedDisturbance largest_noise(const std::vector<PhaseBounds>& bounds, double weight);
/// The largest slew, without noise.
[[nodiscard]] ToleratedDisturbance largest_slew(const std::vector<PhaseBounds>& bounds, double weight);

/// The largest deviation of Gaussian noise for which exp(exponent (level/R)^2) does not grow in the mean,
/// over all R; the linear part is averaged over the noise, the rest bounded.
[[nodiscard]] ToleratedDisturbance largest_deviation(const std::vector<PhaseBounds>& bounds, double weight,
                                                     double exponent);

/// The least level that is never left under these disturbances, or infinity. `noise` 0 and `slew` 0 mean
/// disturbances so small that second orders do not count: then the level for noise 1.
[[nodiscard]] double long_run_level(const std::vector<PhaseBounds>& bounds, const DisturbanceWeights& weights,
                                    double noise, double slew);

}  // namespace veritrack::model
