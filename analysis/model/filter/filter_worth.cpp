#include "analysis/model/filter/filter_worth.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "analysis/search/maximize.hpp"

namespace veritrack::model::detail {

FilterParameters FilterCoordinates::at(const VectorXd& x) const {
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

FilterWorth worth_on_orbit(const TrackedTone& tone, const NodeCurve& curve,
                           const FilterParameters& parameters, int before, int samples,
                           const Surroundings& around, const Eigen::MatrixXcd* slope,
                           const OrbitPoints* points, double enough) {
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

FilterWorth least_of(std::span<const FilterWorth> each) {
  FilterWorth worth{0.0, 0.0, std::numeric_limits<double>::infinity(), 0.0};
  for (const FilterWorth& one : each) {
    worth.growth = std::max(worth.growth, one.growth);
    worth.linear = std::max(worth.linear, one.linear);
    worth.least_reach = std::min(worth.least_reach, one.least_reach);
    worth.most_reach = std::max(worth.most_reach, one.most_reach);
  }
  return worth;
}

int memory_of(double rate_squared, const FilterParameters& parameters, double share) {
  const double factor = std::min(0.999, std::max(rate_squared / parameters.lambda, rate_squared));
  return std::clamp(static_cast<int>(std::ceil(std::log(share) / std::log(factor))), 12, 4000);
}

const ScoredPoint& best_of(std::span<const ScoredPoint> points) {
  return *std::max_element(points.begin(), points.end(),
                           [](const ScoredPoint& a, const ScoredPoint& b) { return a.value < b.value; });
}

void climb(ScoredPoint& best, double step, int evaluations,
           const std::function<ScoredPoint(const VectorXd&)>& score) {
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

}  // namespace veritrack::model::detail
