// The shape of a tube around a tracker's curve: a proposal, by the periodic Lyapunov equation
//   Pi(phi + omega) = A Pi A'/lambda + b B B' + c (dC/domega)(dC/domega)' + W,  U = Cholesky factor of Pi,
// whose free parameters are chosen for their worth to third order at the curve (shape_bounds.hpp).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "analysis/model/shape/shape_bounds.hpp"
#include "analysis/search/deadline.hpp"

namespace veritrack::model {

/// The purpose of a tube.
enum class ShapeObjective {
  largest_starts,
  largest_noise,
  least_long_run_error,
  largest_slew,
  largest_deviation  ///< of Gaussian noise
};

struct ShapeSettings {
  ShapeObjective objective = ShapeObjective::largest_starts;
  /// For the largest starts: the deviations from the steady state that a start may have together, the sign of
  /// each free. As large a multiple of them as possible shall be in the tube. Empty: the least of R |grad h
  /// U| over the phase shall be large.
  Eigen::VectorXd start;
  /// For the largest deviation: the logarithm of the rarity with which the tube may be left.
  double exponent = 28.0;
  /// For the least error in the long run; both 0 mean a noise so small that second orders do not count.
  double noise = 0.0;  ///< of the samples together, Euclidean
  double slew = 0.0;   ///< rad/sample per sample
  int harmonics = 16;  ///< of the shape, at most
  /// For the tube of a filter whose covariance is bounded, rad/sample; 0: as large as possible.
  double largest_reach = 0.0;
  /// The largest rate at other frequencies at which the parameters must work: lambda is above its square.
  double largest_rate = 0.0;
  /// Evaluations of shapes in the search; 0 means 300, and 600 for more than 5 states.
  int evaluations = 0;
  search::Deadline deadline = {};  ///< after which nothing better is searched for
};

/// The free parameters. Equal ones at neighbouring frequencies give shapes that fit together.
struct ShapeParameters {
  double lambda = 0.0;          ///< between the square of the rate and 1
  DisturbanceWeights weights;   ///< b, c
  Eigen::MatrixXd source;       ///< W, n x n, positive semidefinite
  Eigen::VectorXd of_filter;    ///< in place of all these: see filter_proposal.cpp
  double unit_of_filter = 1.0;  ///< of its levels, rad/sample
};

/// The worth of a shape at the curve.
struct ShapeWorth {
  double score = 0.0;      ///< of the objective: its logarithm, to be large
  double level = 0.0;      ///< R
  double noise = 0.0;      ///< that it tolerates, for the largest noise, or its deviation
  double slew = 0.0;       ///< likewise
  double rate = 1.0;       ///< sup |U(phi+omega)^-1 A U|
  double reach = 0.0;      ///< R |grad h U|, the largest over the phase, rad/sample
  double least_reach = 0;  ///< the least over the phase
  double start_share = 0;  ///< the multiple of the start's deviations that is in the tube; 0 without any
};

struct ShapeProposal {
  ShapeParameters parameters;
  int harmonics = 0;
  ShapeWorth worth;
};

/// b B B' + c (dC/domega)(dC/domega)' + W along the curve: n^2 x grid.size().
[[nodiscard]] Eigen::MatrixXd lyapunov_source(const CurveDynamics& dynamics,
                                              const ShapeParameters& parameters);
/// The shape of these parameters with its first harmonics, on the grid of the dynamics: empty when there is
/// none.
[[nodiscard]] std::optional<ShapeOnGrid> shape_on_grid(const CurveDynamics& dynamics,
                                                       const ShapeParameters& parameters, int harmonics);
/// The Cholesky factors themselves, n^2 x grid.size().
[[nodiscard]] std::optional<Eigen::MatrixXd> cholesky_factors(const CurveDynamics& dynamics,
                                                              const ShapeParameters& parameters);

/// Whether no diagonal entry of U is tiny for its row: its coefficients, of 24 bits, could not hold it.
/// Shapes that are searched for have to be so with room to spare.
[[nodiscard]] bool is_well_conditioned(const ShapeOnGrid& shape);

/// Empty when the shape is invalid somewhere.
[[nodiscard]] std::optional<ShapeWorth> worth_of(const CurveDynamics& dynamics, const ShapeOnGrid& shape,
                                                 const DisturbanceWeights& weights,
                                                 const ShapeSettings& settings);

/// Searches for good parameters (Sbplx). The result is scaled so that |grad h U| is at most 1 over the phase:
/// levels are then in rad/sample. With parameters that are good at a frequency nearby, a fifth of the
/// evaluations is spent around them. Deterministic; holds round-to-nearest. Nothing when no shape contracts.
[[nodiscard]] std::optional<ShapeProposal> propose_shape(
    const CurveDynamics& dynamics, const ShapeSettings& settings,
    const std::optional<ShapeParameters>& nearby = std::nullopt);

}  // namespace veritrack::model
