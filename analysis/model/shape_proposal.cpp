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

/// Of W: the states themselves, or those of their covariance under the disturbance. Where states move
/// together (delays), a diagonal W would be useless; where they do not (a filter's covariances), it is
/// better.
enum class Axes { of_states, of_covariance };

/// The places of the parameters in the space of the search: the logit of lambda between the square of the
/// rate and 1, the logarithms of W along its axes, and of c where it is wanted.
class SearchCoordinates {
 public:
  SearchCoordinates(const CurveDynamics& dynamics, const ShapeSettings& settings, Axes axes)
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
    if (axes == Axes::of_states) {
      axes_ = MatrixXd(axes_.diagonal().asDiagonal());
    }
    size_ = dynamics.size;
  }

  /// Around parameters that were good nearby.
  SearchCoordinates(const CurveDynamics& dynamics, const ShapeParameters& nearby)
      : rate_squared_(dynamics.cocycle.rate() * dynamics.cocycle.rate()), weights_(nearby.weights) {
    is_both_ = weights_.noise > 0.0 && weights_.slew > 0.0;
    const Eigen::LLT<MatrixXd> factor(nearby.source);
    if (factor.info() == Eigen::Success) {
      axes_ = factor.matrixL();
    }
    const double share = (nearby.lambda - rate_squared_) / (1.0 - rate_squared_);
    nearby_ = Eigen::VectorXd::Zero(size());
    nearby_[0] = share > 0.05 && share < 0.95 ? std::log(share / (1.0 - share)) : 0.0;
  }

  [[nodiscard]] const Eigen::VectorXd& nearby() const { return nearby_; }
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
  Eigen::VectorXd nearby_;
};

/// Whether no diagonal entry of U is tiny for its row: its coefficients, of 24 bits, could not hold it.
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
  const auto bounds = is_well_conditioned(shape) ? bound_along(dynamics, shape, present) : std::nullopt;
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

namespace {

/// A search among the parameters with these axes, from the best of a few starts.
class ShapeSearch {
 public:
  ShapeSearch(const CurveDynamics& dynamics, const ShapeSettings& settings, Axes axes)
      : dynamics_(&dynamics), settings_(&settings), coordinates_(dynamics, settings, axes) {}
  ShapeSearch(const CurveDynamics& dynamics, const ShapeSettings& settings, const ShapeParameters& nearby)
      : dynamics_(&dynamics), settings_(&settings), coordinates_(dynamics, nearby) {}

  /// Nothing when there is no such shape.
  [[nodiscard]] std::optional<ShapeWorth> worth_at(const ShapeParameters& parameters, int harmonics) const {
    const auto shape = shape_on_grid(*dynamics_, parameters, harmonics);
    return shape ? worth_of(*dynamics_, *shape, parameters.weights, *settings_) : std::nullopt;
  }
  [[nodiscard]] int most_harmonics() const {
    return std::min(settings_->harmonics, dynamics_->cocycle.grid().harmonics());
  }
  [[nodiscard]] ShapeParameters best() const { return coordinates_.at(point_); }
  [[nodiscard]] double score() const { return score_; }

  void begin() {
    if (!coordinates_.is_usable()) {
      return;
    }
    constexpr double kNone = -50.0;
    for (const double floor : {kNone, -6.0, -4.5, -3.0, -1.5, 0.0}) {
      for (const double logit : {-1.5, 0.0, 1.5}) {
        for (const double logarithm : {-7.0, -4.0, -1.0}) {
          const Eigen::VectorXd x = coordinates_.start(logit, logarithm, floor);
          const double value = score_at(x);
          if (value > score_) {
            score_ = value;
            point_ = x;
          }
        }
      }
    }
  }
  /// From the parameters nearby.
  void begin_nearby() {
    if (coordinates_.is_usable()) {
      point_ = coordinates_.nearby();
      score_ = score_at(point_);
    }
  }
  /// Goes on from the best so far.
  void improve(int evaluations) {
    if (!std::isfinite(score_)) {
      return;
    }
    constexpr double kWidest = 30.0;
    search::SearchSpace space;
    space.start = point_;
    space.step = Eigen::VectorXd::Constant(coordinates_.size(), 1.5);
    space.step[0] = 0.7;
    space.lower = Eigen::VectorXd::Constant(coordinates_.size(), -kWidest);
    space.upper = Eigen::VectorXd::Constant(coordinates_.size(), kWidest);
    space.lower[0] = -4.0;
    space.upper[0] = 6.0;
    space.evaluations = evaluations;
    space.tolerance = 1e-3;
    const search::BestPoint found =
        search::maximize([this](const Eigen::VectorXd& x) { return score_at(x); }, space);
    if (found.value > score_) {
      score_ = found.value;
      point_ = found.point;
    }
  }

 private:
  [[nodiscard]] double score_at(const Eigen::VectorXd& x) const {
    const auto worth = worth_at(coordinates_.at(x), most_harmonics());
    return worth ? worth->score : kWorthless;
  }

  const CurveDynamics* dynamics_;
  const ShapeSettings* settings_;
  SearchCoordinates coordinates_;
  Eigen::VectorXd point_;
  double score_ = kWorthless;
};

/// The best parameters found, with as few harmonics as lose hardly anything.
std::optional<ShapeProposal> finished(const ShapeSearch& search) {
  if (!std::isfinite(search.score())) {
    return std::nullopt;
  }
  ShapeProposal proposal;
  proposal.parameters = search.best();
  constexpr double kLoss = 0.01;
  proposal.harmonics = search.most_harmonics();
  auto worth = search.worth_at(proposal.parameters, proposal.harmonics);
  for (int harmonics = 0; worth && harmonics < search.most_harmonics(); ++harmonics) {
    const auto fewer = search.worth_at(proposal.parameters, harmonics);
    if (fewer && fewer->score > worth->score - kLoss) {
      proposal.harmonics = harmonics;
      worth = fewer;
      break;
    }
  }
  if (!worth) {
    return std::nullopt;
  }
  // So that levels are in rad/sample; noise and slew do not change.
  const double scale = worth->level / worth->reach;
  proposal.parameters.source *= scale * scale;
  proposal.parameters.weights.noise *= scale * scale;
  proposal.parameters.weights.slew *= scale * scale;
  worth->level = worth->reach;
  proposal.worth = *worth;
  return proposal;
}

}  // namespace

std::optional<ShapeProposal> propose_shape(const CurveDynamics& dynamics, const ShapeSettings& settings,
                                           const std::optional<ShapeParameters>& nearby) {
  const rigor::NearestRounding nearest;
  if (!(dynamics.cocycle.rate() < 1.0)) {
    return std::nullopt;
  }
  if (nearby) {
    ShapeSearch search(dynamics, settings, *nearby);
    search.begin_nearby();
    if (std::isfinite(search.score())) {
      search.improve(settings.evaluations / 5);
      return finished(search);
    }
  }
  ShapeSearch search(dynamics, settings, Axes::of_states);
  ShapeSearch other(dynamics, settings, Axes::of_covariance);
  for (ShapeSearch* one : {&search, &other}) {
    one->begin();
    one->improve(settings.evaluations / 3);
  }
  if (other.score() > search.score()) {
    search = other;
  }
  search.improve(settings.evaluations / 3);
  return finished(search);
}

}  // namespace veritrack::model
