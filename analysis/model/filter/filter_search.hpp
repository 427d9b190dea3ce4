// The search for the parameters with which bounds and shape of a filter are carried along: see
// filter_proposal.hpp.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/model/filter/filter_orbit.hpp"
#include "analysis/model/shape/proposed_tube.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/search/maximize.hpp"

namespace veritrack::model::detail {

/// Parameters as a point: the logarithm of eta, the logits of theta and of lambda between the square of the
/// rate and 1, the logarithms of b and d, those of the process noise in units of the states, with a slew that
/// of c, and, when it is searched for, that of the noise V or the slew W.
struct FilterCoordinates {
  double rate_squared;
  VectorXd sizes;
  double given_noise;
  bool finds_noise;
  double given_slew = 0.0;
  bool finds_slew = false;
  double exponent = 0.0;  ///< of Gaussian noise; 0: the noise is bounded

  [[nodiscard]] bool moves() const { return given_slew > 0.0 || finds_slew; }
  [[nodiscard]] bool finds() const { return finds_noise || finds_slew; }
  [[nodiscard]] Index size() const { return 5 + sizes.size() + (moves() ? 1 : 0) + (finds() ? 1 : 0); }
  [[nodiscard]] FilterParameters at(const VectorXd& x) const {
    const auto logistic = [](double t) { return 1.0 / (1.0 + std::exp(-t)); };
    FilterParameters parameters;
    parameters.eta = std::exp(x[0]);
    parameters.theta = logistic(x[1]);
    parameters.lambda = rate_squared + (1.0 - rate_squared) * logistic(x[2]);
    parameters.source = std::exp(x[3]);
    parameters.spread = std::exp(x[4]);
    parameters.process = x.segment(5, sizes.size()).array().exp() * sizes.array().square();
    parameters.exponent = exponent;
    parameters.noise = finds_noise ? std::exp(x[size() - 1]) : given_noise;
    parameters.slew = finds_slew ? std::exp(x[size() - 1]) : given_slew;
    parameters.moving = moves() ? std::exp(x[5 + sizes.size()]) : 0.0;
    return parameters;
  }
};

/// What parameters are worth: the largest growth, that of its linear part without noise, and how far
/// frequency errors reach, over the phase.
struct FilterWorth {
  double growth = std::numeric_limits<double>::infinity();
  double linear = 1.0;
  double least_reach = std::numeric_limits<double>::infinity();
  double most_reach = 0.0;
};

/// Where the orbits of the search begin, rad.
inline constexpr double kFirstPhase = 0.3;

/// Over so many samples of an orbit, after `before`. With `enough`, the growth is only compared with it: it
/// is at most so much, or infinite.
inline FilterWorth worth_on_orbit(const TrackedTone& tone, const NodeCurve& curve,
                                  const FilterParameters& parameters, int before, int samples,
                                  const Surroundings& around = {}, const Eigen::MatrixXcd* slope = nullptr,
                                  const OrbitPoints* points = nullptr, double enough = 0.0) {
  FilterOrbit orbit(tone, curve, parameters, around, slope, points);
  orbit.begin(kFirstPhase);
  FilterWorth worth;
  double growth = 0.0;
  double linear = 0.0;
  for (int k = 0; k < before + samples; ++k) {
    if (!orbit.step()) {
      return worth;
    }
    if (k >= before) {
      const FilterGrowth here = orbit.growth(enough);
      growth = std::max(growth, here.whole);
      linear = std::max(linear, here.linear);
      const double reach = orbit.reach();
      constexpr double kFar = 3.0;
      if (!(here.whole < kFar) || !std::isfinite(reach)) {
        return worth;
      }
      worth.least_reach = std::min(worth.least_reach, reach);
      worth.most_reach = std::max(worth.most_reach, reach);
    }
  }
  worth.growth = growth;
  worth.linear = linear;
  return worth;
}

/// How many samples the shape remembers.
inline int memory_of(double rate_squared, const FilterParameters& parameters, double share) {
  const double factor = std::min(0.999, std::max(rate_squared / parameters.lambda, rate_squared));
  return std::clamp(static_cast<int>(std::ceil(std::log(share) / std::log(factor))), 12, 4000);
}

/// The least logit of lambda that is searched: nearer to the square of the rate a shape is settled after
/// thousands of samples only, each of which is followed in every trial.
inline constexpr double kLeastLogit = -2.5;

/// A point of a search and what it is worth; minus infinity: nothing.
struct ScoredPoint {
  double value = -std::numeric_limits<double>::infinity();
  VectorXd point;
};

/// Climbs from `best`, with so many evaluations of `score(point)`, a ScoredPoint; it may return another point
/// than it was asked for. Steps of the logarithms of parameters.
template <typename Score>
void climb(ScoredPoint& best, double step, int evaluations, const Score& score) {
  if (!std::isfinite(best.value)) {
    return;
  }
  const rigor::NearestRounding nearest;
  search::SearchSpace space;
  space.start = best.point;
  space.step = VectorXd::Constant(best.point.size(), step);
  space.lower = VectorXd::Constant(best.point.size(), -30.0);
  space.upper = VectorXd::Constant(best.point.size(), 12.0);
  space.evaluations = evaluations;
  space.tolerance = 1e-3;
  (void)search::maximize(
      [&](const VectorXd& x) {
        const ScoredPoint here = score(x);
        if (here.value > best.value) {
          best = here;
        }
        return here.value;
      },
      space);
}

/// The search for parameters: at the middle of the cell, and then scaled so that they do at its ends.
class FilterSearch {
 public:
  FilterSearch(const TrackedTone& tone, const CurveFit& curve, const TubeSettings& settings, double rate)
      : tone_(&tone),
        nodes_{curve.at(-1.0), curve.at(0.0), curve.at(1.0)},
        slopes_{curve.slope_at(-1.0), curve.slope_at(0.0), curve.slope_at(1.0)},
        points_(std::make_shared<const std::vector<OrbitPoints>>()) {
    const Index n = tone.filter->states;
    const VectorXd state = state_at(nodes_[1], 0.3);
    VectorXd sizes(n);
    // Of deviations: those that the filter itself expects.
    Index place = n;
    for (Index i = 0; i < n; ++i) {
      sizes[i] = std::sqrt(std::max(1e-300, state[place]));
      place += n - i;
    }
    const bool is_gaussian = settings.shape.objective == ShapeObjective::largest_deviation;
    const bool is_for_noise = settings.shape.objective == ShapeObjective::largest_noise || is_gaussian;
    // The largest reach at a given noise, or the largest noise.
    const bool is_for_slew = settings.shape.objective == ShapeObjective::largest_slew;
    coordinates_ = {rate * rate,
                    sizes,
                    settings.shape.noise,
                    is_for_noise && !(settings.shape.noise > 0.0),
                    settings.shape.slew,
                    is_for_slew && !(settings.shape.slew > 0.0),
                    is_gaussian ? settings.shape.exponent + std::log(kProposedConstant) : 0.0};
    largest_reach_ = settings.shape.largest_reach;
    deadline_ = settings.shape.deadline;
    const int usual = is_gaussian ? 150 : 100;
    evaluations_ = settings.shape.evaluations > 0 ? settings.shape.evaluations / 3 : usual;
  }

  [[nodiscard]] const FilterCoordinates& coordinates() const { return coordinates_; }
  /// At the middle and both ends.
  [[nodiscard]] FilterWorth worth_at(const FilterParameters& parameters, int samples,
                                     double enough = 0.0) const {
    std::array<FilterWorth, 3> each;
    tbb::parallel_for(std::size_t{0}, each.size(), [&](std::size_t i) {
      each.at(i) = worth_on_orbit(*tone_, nodes_.at(i), parameters,
                                  memory_of(coordinates_.rate_squared, parameters, 1e-4), samples, {},
                                  &slopes_.at(i), points_->empty() ? nullptr : &points_->at(i), enough);
    });
    FilterWorth worth{0.0, 0.0, std::numeric_limits<double>::infinity(), 0.0};
    for (const FilterWorth& one : each) {
      worth.growth = std::max(worth.growth, one.growth);
      worth.linear = std::max(worth.linear, one.linear);
      worth.least_reach = std::min(worth.least_reach, one.least_reach);
      worth.most_reach = std::max(worth.most_reach, one.most_reach);
    }
    return worth;
  }
  /// The point with a larger or smaller tube.
  [[nodiscard]] VectorXd with_size(VectorXd x, double logarithm) const {
    x[3] += logarithm;
    x.segment(5, coordinates_.sizes.size() + (coordinates_.moves() ? 1 : 0)).array() += logarithm;
    return x;
  }
  /// The point with a larger or smaller scale: of the tube, or of the noise.
  [[nodiscard]] VectorXd scaled(VectorXd x, double logarithm) const {
    if (coordinates_.finds()) {
      x[coordinates_.size() - 1] += logarithm;
      return x;
    }
    return with_size(std::move(x), logarithm);
  }
  /// The largest scale at which the growth is what it may be; -infinity when there is none nearby.
  template <typename Worth>
  [[nodiscard]] double largest_scale(const VectorXd& x, const Worth& worth_of) const {
    const auto may_be = [&](double logarithm) {
      const FilterWorth worth = worth_of(coordinates_.at(scaled(x, logarithm)));
      return worth.growth <= kLargestGrowth &&
             !(largest_reach_ > 0.0 && worth.most_reach > 0.97 * largest_reach_);
    };
    constexpr double kStep = 1.2;
    constexpr int kMostSteps = 9;
    double low = 0.0;
    int steps = 0;
    const bool grows = may_be(0.0);
    for (double tried = grows ? kStep : -kStep; steps < kMostSteps;
         ++steps, tried += grows ? kStep : -kStep) {
      const bool is_possible = may_be(tried);
      low = is_possible || !grows ? tried : low;
      if (is_possible != grows) {
        break;
      }
    }
    if (steps == kMostSteps) {
      return grows ? low : -std::numeric_limits<double>::infinity();
    }
    double high = low + kStep;
    const int halvings =
        coordinates_.exponent > 0.0 ? 12 : halvings_;  // the value is that of the noise alone
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (low + high);
      (may_be(middle) ? low : high) = middle;
    }
    return low;
  }
  [[nodiscard]] ScoredPoint score(const VectorXd& x) const {
    if (deadline_.is_over() || x[2] < kLeastLogit) {
      return {};
    }
    constexpr int kSamples = 20;
    const auto at_middle = [&](const FilterParameters& parameters) {
      return worth_on_orbit(*tone_, nodes_[1], parameters,
                            memory_of(coordinates_.rate_squared, parameters, 1e-2), kSamples, {}, &slopes_[1],
                            &points_->at(1), kLargestGrowth);
    };
    const double logarithm = largest_scale(x, at_middle);
    if (!std::isfinite(logarithm)) {
      return {};
    }
    ScoredPoint scored{0.0, scaled(x, logarithm)};
    const FilterParameters parameters = coordinates_.at(scored.point);
    scored.value = std::log(coordinates_.finds_noise  ? parameters.noise
                            : coordinates_.finds_slew ? parameters.slew
                                                      : at_middle(parameters).least_reach);
    return scored;
  }
  /// The best point found, scaled for the whole cell.
  [[nodiscard]] std::optional<VectorXd> run(const VectorXd& nearby) {
    follow_orbits();
    std::vector<ScoredPoint> starts;
    if (nearby.size() == coordinates_.size()) {
      starts.push_back(score(nearby));
    } else {
      if (!coordinates_.finds()) {
        starts = first_starts();
      } else {
        // From tubes without noise and slew, made smaller.
        std::vector<VectorXd> points;
        FilterSearch without_noise(*this);
        without_noise.coordinates_.finds_noise = without_noise.coordinates_.finds_slew = false;
        without_noise.coordinates_.given_slew = 0.0;
        without_noise.coordinates_.exponent = 0.0;
        for (const ScoredPoint& start : without_noise.best_of(without_noise.first_starts())) {
          for (const double scale : {-0.5, -1.4, -2.8}) {
            if (std::isfinite(start.value)) {
              const VectorXd smaller = without_noise.scaled(start.point, scale);
              VectorXd x = VectorXd::Constant(coordinates_.size(), coordinates_.moves() ? -10.0 : -6.0);
              x.head(smaller.size()) = smaller;
              points.push_back(std::move(x));
            }
          }
        }
        starts.assign(points.size(), {});
        tbb::parallel_for(std::size_t{0}, points.size(),
                          [&](std::size_t i) { starts[i] = score(points[i]); });
      }
      starts = best_of(std::move(starts));
    }
    if (starts.empty() || !std::isfinite(starts.front().value)) {
      return std::nullopt;
    }
    tbb::parallel_for(std::size_t{0}, starts.size(), [&](std::size_t i) { improve(starts[i], 1.0); });
    ScoredPoint best =
        *std::max_element(starts.begin(), starts.end(),
                          [](const ScoredPoint& a, const ScoredPoint& b) { return a.value < b.value; });
    if (starts.size() > 1) {
      improve(best, 0.5);
      improve(best, 0.8);
    }
    // Of the largest disturbance a search that begins anew finds more, again and again.
    // Its size is the value that is climbed, whose steps would hide what is gained.
    constexpr int kFineHalvings = 10;
    halvings_ = coordinates_.finds() ? kFineHalvings : halvings_;
    const int most_rounds = coordinates_.finds() && !(coordinates_.exponent > 0.0) ? 4 : 0;
    constexpr double kLeastGain = 0.004;
    for (int round = 0; round < most_rounds; ++round) {
      const double before = best.value;
      improve(best, 1.0);
      improve(best, 0.5);
      if (!(best.value > before + kLeastGain)) {
        break;
      }
    }
    // At the ends of the cell a smaller tube may be needed, not only less noise.
    constexpr int kSamples = 40;
    ScoredPoint whole;
    for (const double shrink : {0.0, -0.3, -0.7, -1.4}) {
      const VectorXd smaller = shrink < 0.0 ? with_size(best.point, shrink) : best.point;
      const double logarithm = largest_scale(smaller, [&](const FilterParameters& parameters) {
        return worth_at(parameters, kSamples, kLargestGrowth);
      });
      // The value is that of the scale alone.
      if (std::isfinite(logarithm) && logarithm > whole.value) {
        whole = {logarithm, scaled(smaller, logarithm)};
      }
      if (!coordinates_.finds()) {
        break;
      }
    }
    return std::isfinite(whole.value) ? std::optional(whole.point) : std::nullopt;
  }

  static constexpr double kLargestGrowth = 0.985;

 private:
  void follow_orbits() {
    std::vector<OrbitPoints> points;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      points.emplace_back(*tone_, nodes_.at(i), kFirstPhase, Surroundings{}, &slopes_.at(i));
    }
    points_ = std::make_shared<const std::vector<OrbitPoints>>(std::move(points));
  }
  /// Of the reach.
  [[nodiscard]] std::vector<ScoredPoint> first_starts() const {
    std::vector<VectorXd> points;
    for (const double source : {-8.0, -4.0, -1.0}) {
      for (const double eta : {-3.6, -2.3, -1.0}) {
        for (const double logit : {0.0, 1.4, 2.6}) {
          for (const double spread : {-5.0, -2.0}) {
            // The scale of W is found by itself.
            constexpr double kProcess = -4.5;
            VectorXd x = VectorXd::Constant(coordinates_.size(), kProcess);
            x.head(5) << eta, eta, logit, source, spread;
            if (coordinates_.moves()) {
              x[x.size() - 1] = -9.0;
            }
            points.push_back(x);
          }
        }
      }
    }
    std::vector<ScoredPoint> starts(points.size());
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) { starts[i] = score(points[i]); });
    return starts;
  }
  /// The three best ones, the best first.
  [[nodiscard]] static std::vector<ScoredPoint> best_of(std::vector<ScoredPoint> starts) {
    std::stable_sort(starts.begin(), starts.end(),
                     [](const ScoredPoint& a, const ScoredPoint& b) { return a.value > b.value; });
    constexpr std::size_t kMost = 3;
    starts.resize(std::min(kMost, starts.size()));
    return starts;
  }
  void improve(ScoredPoint& best, double step) const {
    climb(best, step, evaluations_, [&](const VectorXd& x) { return score(x); });
  }

  const TrackedTone* tone_;
  std::array<NodeCurve, 3> nodes_;
  std::array<Eigen::MatrixXcd, 3> slopes_;
  std::shared_ptr<const std::vector<OrbitPoints>> points_;  ///< of the nodes; none until the search begins
  FilterCoordinates coordinates_;
  double largest_reach_ = 0.0;
  int evaluations_ = 0;  ///< of each round
  int halvings_ = 6;     ///< to find a scale
  search::Deadline deadline_;
};

}  // namespace veritrack::model::detail
