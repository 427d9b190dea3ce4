#include "analysis/model/shape_proposal.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/rigor/rounding.hpp"
#include "analysis/search/maximize.hpp"

namespace veritrack::model {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kWorthless = -std::numeric_limits<double>::infinity();

/// The right side of the Lyapunov equation: n^2 x grid.size().
MatrixXd source_of(const CurveDynamics& dynamics, const ShapeParameters& parameters) {
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

/// The places of the parameters in the space of the search: the logit of lambda between the square of the
/// rate and 1, the logarithms of W along its axes, and of c where it is wanted.
class SearchCoordinates {
 public:
  SearchCoordinates(const CurveDynamics& dynamics, const ShapeSettings& settings)
      : rate_squared_(dynamics.cocycle.rate() * dynamics.cocycle.rate()) {
    const bool with_noise = settings.noise > 0.0 || settings.slew == 0.0;
    const bool for_slew = settings.objective == ShapeObjective::largest_slew ||
                          (settings.objective == ShapeObjective::least_long_run_error && settings.slew > 0.0);
    weights_ = for_slew ? DisturbanceWeights{0.0, 1.0} : DisturbanceWeights{1.0, 0.0};
    is_both_ = for_slew && settings.objective == ShapeObjective::least_long_run_error && with_noise;
    if (is_both_) {
      weights_.noise = 1.0;
    }
    find_axes(dynamics);
    size_ = dynamics.size;
  }

  [[nodiscard]] bool is_usable() const { return axes_.allFinite() && axes_.size() > 0; }
  [[nodiscard]] Index size() const { return 1 + axes_.cols() + (is_both_ ? 1 : 0); }
  /// W is exp(logarithm) of the covariance, and along every axis at least exp(floor) of the state's size.
  [[nodiscard]] Eigen::VectorXd start(double logit, double logarithm, double floor) const {
    Eigen::VectorXd x = Eigen::VectorXd::Constant(size(), logarithm);
    x[0] = logit;
    for (Index i = 0; i < axes_.cols(); ++i) {
      x[1 + i] = std::max(logarithm, std::min(25.0, 2.0 * (floor + std::log(size_[i] / axes_(i, i)))));
    }
    if (is_both_) {
      x[size() - 1] = 0.0;
    }
    return x;
  }
  [[nodiscard]] ShapeParameters at(const Eigen::VectorXd& x) const {
    ShapeParameters parameters;
    parameters.lambda = rate_squared_ + (1.0 - rate_squared_) / (1.0 + std::exp(-x[0]));
    parameters.weights = weights_;
    if (is_both_) {
      parameters.weights.slew *= std::exp(x[size() - 1]);
    }
    const Eigen::VectorXd sizes = x.segment(1, axes_.cols()).array().exp();
    parameters.source = axes_ * sizes.asDiagonal() * axes_.transpose();
    return parameters;
  }

 private:
  /// The axes are those of the states' covariance under the disturbance: states that move together (delays)
  /// would make a diagonal W useless.
  void find_axes(const CurveDynamics& dynamics) {
    const int n = dynamics.cocycle.states();
    if (weights_.slew > 0.0) {
      // In units of a slew that does as much as a noise of 1.
      const double noise = dynamics.noise_source.colwise().sum().cwiseAbs().maxCoeff();
      const double drift = dynamics.slew.colwise().squaredNorm().maxCoeff();
      weights_.slew = drift > 0.0 && noise > 0.0 ? noise / drift : 1.0;
    }
    ShapeParameters plain;
    plain.lambda = 0.5 * (1.0 + rate_squared_);
    plain.weights = {1.0, weights_.slew};
    plain.source = MatrixXd::Zero(n, n);
    const MatrixXd pi = dynamics.cocycle.lyapunov_solution(plain.lambda, source_of(dynamics, plain));
    MatrixXd mean = pi.rowwise().mean().reshaped(n, n);
    // States that no disturbance reaches still have to have an axis.
    const double largest = mean.diagonal().maxCoeff();
    mean.diagonal() = mean.diagonal() * (1.0 + 1e-6) + Eigen::VectorXd::Constant(n, 1e-10 * largest);
    const Eigen::LLT<MatrixXd> factor(mean);
    if (factor.info() == Eigen::Success) {
      axes_ = factor.matrixL();
    }
  }

  double rate_squared_;
  DisturbanceWeights weights_;
  bool is_both_ = false;
  MatrixXd axes_;
  Eigen::VectorXd size_;
};

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

std::optional<MatrixXd> cholesky_factors(const CurveDynamics& dynamics, const ShapeParameters& parameters) {
  const int n = dynamics.cocycle.states();
  MatrixXd factors = dynamics.cocycle.lyapunov_solution(parameters.lambda, source_of(dynamics, parameters));
  for (Index j = 0; j < factors.cols(); ++j) {
    const MatrixXd pi = factors.col(j).reshaped(n, n);
    const Eigen::LLT<MatrixXd> factor(0.5 * (pi + pi.transpose()));
    if (factor.info() != Eigen::Success || !pi.allFinite()) {
      return std::nullopt;
    }
    const MatrixXd lower = factor.matrixL();
    factors.col(j) = lower.reshaped();
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

std::optional<ShapeWorth> worth_of(const CurveDynamics& dynamics, const ShapeOnGrid& shape,
                                   const DisturbanceWeights& weights, const ShapeSettings& settings) {
  DisturbanceWeights present = weights;
  const bool is_for_starts = settings.objective == ShapeObjective::largest_starts;
  present.noise = is_for_starts ? 0.0 : weights.noise;
  present.slew = is_for_starts ? 0.0 : weights.slew;
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
      worth.score =
          std::log(settings.start.size() > 0 ? worth.start_share : worth.level * worth.least_reach);
      break;
    case ShapeObjective::largest_noise: {
      const ToleratedDisturbance tolerated = largest_noise(*bounds, weights.noise);
      worth.level = tolerated.level;
      worth.noise = tolerated.size;
      worth.score = std::log(tolerated.size);
      break;
    }
    case ShapeObjective::largest_slew: {
      const ToleratedDisturbance tolerated = largest_slew(*bounds, weights.slew);
      worth.level = tolerated.level;
      worth.slew = tolerated.size;
      worth.score = std::log(tolerated.size);
      break;
    }
    case ShapeObjective::least_long_run_error:
      worth.level = long_run_level(*bounds, weights, settings.noise, settings.slew);
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

std::optional<ShapeProposal> propose_shape(const CurveDynamics& dynamics, const ShapeSettings& settings) {
  const rigor::NearestRounding nearest;
  if (!(dynamics.cocycle.rate() < 1.0)) {
    return std::nullopt;
  }
  const SearchCoordinates coordinates(dynamics, settings);
  if (!coordinates.is_usable()) {
    return std::nullopt;
  }
  const auto worth_at = [&](const ShapeParameters& parameters, int harmonics) -> std::optional<ShapeWorth> {
    const auto shape = shape_on_grid(dynamics, parameters, harmonics);
    return shape ? worth_of(dynamics, *shape, parameters.weights, settings) : std::nullopt;
  };
  const int most = std::min(settings.harmonics, dynamics.cocycle.grid().harmonics());
  const auto score = [&](const Eigen::VectorXd& x) {
    const auto worth = worth_at(coordinates.at(x), most);
    return worth ? worth->score : kWorthless;
  };
  search::SearchSpace space;
  double best = kWorthless;
  constexpr double kNone = -50.0;
  space.start = coordinates.start(0.0, -3.0, kNone);
  for (const double floor : {kNone, -6.0, -4.5, -3.0, -1.5, 0.0}) {
    for (const double logit : {-1.5, 0.0, 1.5}) {
      for (const double logarithm : {-7.0, -4.0, -1.0}) {
        const Eigen::VectorXd x = coordinates.start(logit, logarithm, floor);
        const double value = score(x);
        if (value > best) {
          best = value;
          space.start = x;
        }
      }
    }
  }
  constexpr double kWidest = 30.0;
  space.step = Eigen::VectorXd::Constant(coordinates.size(), 1.5);
  space.step[0] = 0.7;
  space.lower = Eigen::VectorXd::Constant(coordinates.size(), -kWidest);
  space.upper = Eigen::VectorXd::Constant(coordinates.size(), kWidest);
  space.lower[0] = -4.0;
  space.upper[0] = 6.0;
  space.evaluations = settings.evaluations;
  space.tolerance = 1e-3;
  const search::BestPoint found = search::maximize(score, space);
  ShapeProposal proposal;
  proposal.parameters = coordinates.at(found.point);
  // As few harmonics as lose hardly anything.
  constexpr double kLoss = 0.01;
  proposal.harmonics = most;
  auto worth = worth_at(proposal.parameters, most);
  for (int harmonics = 0; worth && harmonics < most; ++harmonics) {
    const auto fewer = worth_at(proposal.parameters, harmonics);
    if (fewer && fewer->score > worth->score - kLoss) {
      proposal.harmonics = harmonics;
      worth = fewer;
      break;
    }
  }
  if (!worth) {
    return std::nullopt;
  }
  const double scale = worth->level / worth->reach;
  proposal.parameters.source *= scale * scale;
  proposal.parameters.weights.noise *= scale * scale;
  proposal.parameters.weights.slew *= scale * scale;
  worth->level = worth->reach;
  proposal.worth = *worth;
  return proposal;
}

}  // namespace veritrack::model
