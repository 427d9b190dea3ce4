#include "analysis/model/shape/shape_proposal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/model/shape/shape_search.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/search/maximize.hpp"

namespace veritrack::model {

namespace {

using detail::Axes;
using detail::SearchCoordinates;

constexpr double kWorthless = -std::numeric_limits<double>::infinity();

/// A search among the parameters with these axes, from the best of a few starts.
class ShapeSearch {
 public:
  ShapeSearch(const CurveDynamics& dynamics, const ShapeSettings& settings, Axes axes)
      : dynamics_(&dynamics), settings_(&settings), coordinates_(dynamics, settings, axes) {}
  ShapeSearch(const CurveDynamics& dynamics, const ShapeSettings& settings, const ShapeParameters& nearby)
      : dynamics_(&dynamics), settings_(&settings), coordinates_(dynamics, settings, nearby) {}

  /// Empty when there is no such shape.
  [[nodiscard]] std::optional<ShapeWorth> worth_at(const ShapeParameters& parameters, int harmonics) const {
    const auto shape = shape_on_grid(*dynamics_, parameters, harmonics);
    return shape && is_well_conditioned(*shape) ? worth_of(*dynamics_, *shape, parameters.weights, *settings_)
                                                : std::nullopt;
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
  /// Starts from the parameters nearby.
  void begin_nearby() {
    if (coordinates_.is_usable()) {
      point_ = coordinates_.nearby();
      score_ = score_at(point_);
    }
  }
  /// Continues from the best so far.
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
    const auto worth =
        settings_->deadline.is_over() ? std::nullopt : worth_at(coordinates_.at(x), most_harmonics());
    if (!worth) {
      return kWorthless;
    }
    return worth->score;
  }

  const CurveDynamics* dynamics_;
  const ShapeSettings* settings_;
  SearchCoordinates coordinates_;
  Eigen::VectorXd point_;
  double score_ = kWorthless;
};

/// The best parameters found, with the fewest harmonics that lose hardly anything.
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
  if (!(dynamics.cocycle.rate() < 1.0) || !(settings.largest_rate < 1.0)) {
    return std::nullopt;
  }
  constexpr int kFew = 300;
  constexpr int kManyStates = 5;
  const int usual = dynamics.cocycle.states() > kManyStates ? 2 * kFew : kFew;
  const int evaluations = settings.evaluations > 0 ? settings.evaluations : usual;
  if (nearby) {
    ShapeSearch search(dynamics, settings, *nearby);
    search.begin_nearby();
    if (std::isfinite(search.score())) {
      search.improve(evaluations / 5);
      return finished(search);
    }
  }
  ShapeSearch search(dynamics, settings, Axes::of_states);
  ShapeSearch other(dynamics, settings, Axes::of_covariance);
  for (ShapeSearch* one : {&search, &other}) {
    one->begin();
    one->improve(evaluations / 4);
  }
  if (other.score() > search.score()) {
    search = other;
  }
  // Twice: a restart leaves valleys in which the first search crept.
  search.improve(evaluations / 4);
  search.improve(evaluations / 4);
  return finished(search);
}

}  // namespace veritrack::model
