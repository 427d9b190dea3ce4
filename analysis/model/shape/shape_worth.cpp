#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/model/shape/shape_proposal.hpp"
#include "analysis/rigor/small_matrix.hpp"

namespace veritrack::model {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// One over the largest |U^-1 d| over the phase and the signs of the entries of d; 0 for an empty d.
double start_share(const ShapeOnGrid& shape, const Eigen::VectorXd& deviations) {
  std::vector<Index> named;
  for (Index i = 0; i < deviations.size(); ++i) {
    if (deviations[i] != 0.0) {
      named.push_back(i);
    }
  }
  constexpr std::size_t kMost = 10;
  if (named.empty() || named.size() > kMost) {
    return 0.0;
  }
  double largest = 0.0;
  for (Index j = 0; j < shape.here.cols(); ++j) {
    const MatrixXd u = shape.here.col(j).reshaped(deviations.size(), deviations.size());
    for (unsigned signs = 0; signs < (1U << (named.size() - 1)); ++signs) {
      Eigen::VectorXd corner = deviations;
      for (std::size_t k = 1; k < named.size(); ++k) {
        corner[named[k]] *= (signs >> (k - 1) & 1U) != 0U ? -1.0 : 1.0;
      }
      largest = std::max(largest, u.triangularView<Eigen::Lower>().solve(corner).norm());
    }
  }
  return 1.0 / largest;
}

}  // namespace

MatrixXd lyapunov_source(const CurveDynamics& dynamics, const ShapeParameters& parameters) {
  MatrixXd source = parameters.weights.noise * dynamics.noise_source;
  source.colwise() += parameters.source.reshaped();
  if (parameters.weights.slew > 0.0) {
    for (Index j = 0; j < source.cols(); ++j) {
      const auto drift = dynamics.slew.col(j);
      const MatrixXd square = parameters.weights.slew * drift * drift.transpose();
      source.col(j) += square.reshaped();
    }
  }
  return source;
}

std::optional<MatrixXd> cholesky_factors(const CurveDynamics& dynamics, const ShapeParameters& parameters) {
  const int n = dynamics.cocycle.states();
  MatrixXd factors =
      dynamics.cocycle.lyapunov_solution(parameters.lambda, lyapunov_source(dynamics, parameters));
  for (Index j = 0; j < factors.cols(); ++j) {
    const MatrixXd pi = factors.col(j).reshaped(n, n);
    const auto factor = rigor::cholesky(rigor::combination(0.5, pi, 0.5, rigor::transposed(pi)));
    if (!factor) {
      return std::nullopt;
    }
    factors.col(j) = factor->reshaped();
  }
  return factors;
}

std::optional<ShapeOnGrid> shape_on_grid(const CurveDynamics& dynamics, const ShapeParameters& parameters,
                                         int harmonics) {
  const auto factors = cholesky_factors(dynamics, parameters);
  if (!factors) {
    return std::nullopt;
  }
  const PhaseGrid& grid = dynamics.cocycle.grid();
  return ShapeOnGrid{*factors * grid.shift(0.0, harmonics),
                     *factors * grid.shift(dynamics.cocycle.frequency(), harmonics)};
}

bool is_well_conditioned(const ShapeOnGrid& shape) {
  constexpr double kLeast = 1e-4;
  const auto n = static_cast<Index>(std::lround(std::sqrt(static_cast<double>(shape.here.rows()))));
  for (Index j = 0; j < shape.here.cols(); ++j) {
    const MatrixXd u = shape.here.col(j).reshaped(n, n);
    if (!((u.diagonal().array() >= kLeast * u.rowwise().norm().array()).all())) {
      return false;
    }
  }
  return true;
}

std::optional<ShapeWorth> worth_of(const CurveDynamics& dynamics, const ShapeOnGrid& shape,
                                   const DisturbanceWeights& weights, const ShapeSettings& settings) {
  // A little less than the weights that made the shape: interpolated and rounded, it does not satisfy its
  // equation exactly.
  constexpr double kMargin = 0.99;
  const bool is_for_starts = settings.objective == ShapeObjective::largest_starts;
  const DisturbanceWeights present{is_for_starts ? 0.0 : kMargin * weights.noise,
                                   is_for_starts ? 0.0 : kMargin * weights.slew};
  const auto bounds = bound_along(dynamics, shape, present);
  if (!bounds) {
    return std::nullopt;
  }
  ShapeWorth worth;
  worth.rate = 0.0;
  worth.least_reach = std::numeric_limits<double>::infinity();
  for (const PhaseBounds& b : *bounds) {
    worth.rate = std::max(worth.rate, b.rate);
    worth.reach = std::max(worth.reach, b.reach);
    worth.least_reach = std::min(worth.least_reach, b.reach);
  }
  switch (settings.objective) {
    case ShapeObjective::largest_starts:
      worth.level = largest_start_level(*bounds);
      worth.start_share = worth.level * start_share(shape, settings.start);
      worth.score = std::log(settings.start.size() > 0 ? worth.start_share : worth.level * worth.least_reach);
      break;
    case ShapeObjective::largest_noise: {
      const ToleratedDisturbance tolerated = largest_noise(*bounds, present.noise);
      worth.level = tolerated.level;
      worth.noise = tolerated.size;
      worth.score = std::log(tolerated.size);
      break;
    }
    case ShapeObjective::largest_slew: {
      const ToleratedDisturbance tolerated = largest_slew(*bounds, present.slew);
      worth.level = tolerated.level;
      worth.slew = tolerated.size;
      worth.score = std::log(tolerated.size);
      break;
    }
    case ShapeObjective::largest_deviation: {
      const ToleratedDisturbance tolerated = largest_deviation(*bounds, present.noise, settings.exponent);
      worth.level = tolerated.level;
      worth.noise = tolerated.size;
      worth.score = std::log(tolerated.size);
      break;
    }
    case ShapeObjective::least_long_run_error:
      worth.level = long_run_level(*bounds, present, settings.noise, settings.slew);
      worth.score = -std::log(worth.level * worth.reach);
      break;
  }
  worth.reach *= worth.level;
  worth.least_reach *= worth.level;
  if (!std::isfinite(worth.score)) {
    return std::nullopt;
  }
  return worth;
}

}  // namespace veritrack::model
