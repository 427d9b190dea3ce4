// The search for a tube of a filter in the long run, inside another one: see filter_proposal.hpp.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "analysis/model/filter/filter_search.hpp"

namespace veritrack::model::detail {

/// The parameters with which the tube is smallest. The bounds of the covariance are those for estimates in
/// the other tube, so that they do not depend on the shape.
class LongRunSearch {
 public:
  LongRunSearch(const TrackedTone& tone, const CurveFit& curve, const FilterCoordinates& coordinates,
                const Tube& around, double radius, int evaluations)
      : tone_(&tone),
        nodes_{curve.at(-1.0), curve.at(0.0), curve.at(1.0)},
        coordinates_(coordinates),
        around_(&around),
        radius_(radius),
        evaluations_(evaluations) {
    for (std::size_t i = 0; i < kPlaces.size(); ++i) {
      points_.emplace_back(tone, nodes_.at(i), kFirstPhase, surroundings(i));
    }
  }

  [[nodiscard]] FilterWorth worth_at(const FilterParameters& parameters, int samples,
                                     double enough = 0.0) const {
    std::array<FilterWorth, kPlaces.size()> each;
    tbb::parallel_for(std::size_t{0}, each.size(),
                      [&](std::size_t i) { each.at(i) = worth_there(i, parameters, 1e-4, samples, enough); });
    FilterWorth worth{0.0, 0.0, std::numeric_limits<double>::infinity(), 0.0};
    for (const FilterWorth& one : each) {
      worth.growth = std::max(worth.growth, one.growth);
      worth.linear = std::max(worth.linear, one.linear);
      worth.least_reach = std::min(worth.least_reach, one.least_reach);
      worth.most_reach = std::max(worth.most_reach, one.most_reach);
    }
    return worth;
  }

  /// From parameters of the other tube, and those that were found at neighbouring frequencies, if any;
  /// nothing when there is no tube.
  [[nodiscard]] std::optional<VectorXd> run(const VectorXd& of_around, const VectorXd& nearby) const {
    std::vector<VectorXd> points;
    for (const double smaller : {-1.0, -3.0}) {
      points.push_back(scaled(of_around, smaller));
      points.back().head(2).array() += smaller;  // narrower bounds
    }
    if (nearby.size() == of_around.size()) {
      points.push_back(nearby);
    }
    std::vector<ScoredPoint> starts(points.size());
    tbb::parallel_for(std::size_t{0}, starts.size(), [&](std::size_t i) {
      starts[i] = score(points[i]);
      improve(starts[i], 1.0);
    });
    ScoredPoint best =
        *std::max_element(starts.begin(), starts.end(),
                          [](const ScoredPoint& a, const ScoredPoint& b) { return a.value < b.value; });
    improve(best, 0.4);
    if (!std::isfinite(best.value)) {
      return std::nullopt;
    }
    constexpr int kSamples = 40;
    const double logarithm = least_scale(best.point, [&](const FilterParameters& parameters) {
      return worth_at(parameters, kSamples, FilterSearch::kLargestGrowth);
    });
    return std::isfinite(logarithm) ? std::optional(scaled(best.point, logarithm)) : std::nullopt;
  }

 private:
  static constexpr std::array<double, 3> kPlaces{-1.0, 0.0, 1.0};
  [[nodiscard]] FilterWorth worth_there(std::size_t place, const FilterParameters& parameters, double share,
                                        int samples, double enough) const {
    return worth_on_orbit(*tone_, nodes_.at(place), parameters,
                          memory_of(coordinates_.rate_squared, parameters, share), samples,
                          surroundings(place), nullptr, &points_[place], enough);
  }
  [[nodiscard]] Surroundings surroundings(std::size_t place) const {
    return {around_, radius_, kPlaces.at(place)};
  }
  [[nodiscard]] static VectorXd scaled(VectorXd x, double logarithm) {
    x.segment(3, x.size() - 3).array() += logarithm;
    return x;
  }
  /// The smallest scale at which the growth is what it may be; infinity when there is none nearby.
  template <typename Worth>
  [[nodiscard]] double least_scale(const VectorXd& x, const Worth& worth_of) const {
    const auto may_be = [&](double logarithm) {
      return worth_of(coordinates_.at(scaled(x, logarithm))).growth <= FilterSearch::kLargestGrowth;
    };
    constexpr double kStep = 0.8;
    constexpr int kMostSteps = 10;
    const bool shrinks = may_be(0.0);
    double high = 0.0;
    int steps = 1;
    for (; steps <= kMostSteps; ++steps) {
      const double tried = shrinks ? -kStep * steps : kStep * steps;
      if (may_be(tried) != shrinks) {
        high = shrinks ? tried + kStep : tried;
        break;
      }
    }
    if (steps > kMostSteps) {
      return shrinks ? -kStep * kMostSteps : std::numeric_limits<double>::infinity();
    }
    double low = high - kStep;
    constexpr int kHalvings = 5;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (may_be(middle) ? high : low) = middle;
    }
    return high;
  }
  [[nodiscard]] ScoredPoint score(const VectorXd& x) const {
    if (x[2] < kLeastLogit) {
      return {};
    }
    constexpr int kSamples = 20;
    const auto at_middle = [&](const FilterParameters& parameters) {
      return worth_there(1, parameters, 1e-2, kSamples, FilterSearch::kLargestGrowth);
    };
    const double logarithm = least_scale(x, at_middle);
    if (!std::isfinite(logarithm)) {
      return {};
    }
    ScoredPoint scored{0.0, scaled(x, logarithm)};
    scored.value = -std::log(at_middle(coordinates_.at(scored.point)).most_reach);
    return scored;
  }
  void improve(ScoredPoint& best, double step) const {
    climb(best, step, evaluations_, [&](const VectorXd& x) { return score(x); });
  }

  const TrackedTone* tone_;
  std::array<NodeCurve, kPlaces.size()> nodes_;
  FilterCoordinates coordinates_;
  const Tube* around_;
  double radius_;
  int evaluations_;                  ///< of each round
  std::vector<OrbitPoints> points_;  ///< of the nodes
};

}  // namespace veritrack::model::detail
