#include "analysis/model/filter/filter_long_run.hpp"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

namespace veritrack::model::detail {

namespace {

VectorXd scaled(VectorXd x, double logarithm) {
  x.segment(3, x.size() - 3).array() += logarithm;
  return x;
}

}  // namespace

LongRunSearch::LongRunSearch(const TrackedTone& tone, const CurveFit& curve,
                             const FilterCoordinates& coordinates, const Tube& around, double radius,
                             int evaluations)
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

FilterWorth LongRunSearch::worth_there(std::size_t place, const FilterParameters& parameters, double share,
                                       int samples, double enough) const {
  return worth_on_orbit(*tone_, nodes_.at(place), parameters,
                        memory_of(coordinates_.rate_squared, parameters, share), samples, surroundings(place),
                        nullptr, &points_[place], enough);
}

FilterWorth LongRunSearch::worth_at(const FilterParameters& parameters, int samples, double enough) const {
  std::array<FilterWorth, kPlaces.size()> each;
  tbb::parallel_for(std::size_t{0}, each.size(),
                    [&](std::size_t i) { each.at(i) = worth_there(i, parameters, 1e-4, samples, enough); });
  return least_of(each);
}

double LongRunSearch::least_scale(const VectorXd& x, const WorthOf& worth_of) const {
  const auto may_be = [&](double logarithm) {
    return worth_of(coordinates_.at(scaled(x, logarithm))).growth <= kLargestGrowth;
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

ScoredPoint LongRunSearch::score(const VectorXd& x) const {
  if (x[2] < kLeastLogit) {
    return {};
  }
  constexpr int kSamples = 20;
  const auto at_middle = [&](const FilterParameters& parameters) {
    return worth_there(1, parameters, 1e-2, kSamples, kLargestGrowth);
  };
  const double logarithm = least_scale(x, at_middle);
  if (!std::isfinite(logarithm)) {
    return {};
  }
  ScoredPoint scored{0.0, scaled(x, logarithm)};
  scored.value = -std::log(at_middle(coordinates_.at(scored.point)).most_reach);
  return scored;
}

void LongRunSearch::improve(ScoredPoint& best, double step) const {
  climb(best, step, evaluations_, [&](const VectorXd& x) { return score(x); });
}

std::optional<VectorXd> LongRunSearch::run(const VectorXd& of_around, const VectorXd& nearby) const {
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
  ScoredPoint best = best_of(starts);
  improve(best, 0.4);
  if (!std::isfinite(best.value)) {
    return std::nullopt;
  }
  constexpr int kSamples = 40;
  const double logarithm = least_scale(best.point, [&](const FilterParameters& parameters) {
    return worth_at(parameters, kSamples, kLargestGrowth);
  });
  return std::isfinite(logarithm) ? std::optional(scaled(best.point, logarithm)) : std::nullopt;
}

}  // namespace veritrack::model::detail
