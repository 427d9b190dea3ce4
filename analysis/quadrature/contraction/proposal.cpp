#include "analysis/quadrature/contraction/proposal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/quadrature/contraction/shape_search.hpp"

namespace veritrack::quadrature {

namespace {

rigor::Matrix<3> matrix(const BlockCovariance<double>& p) {
  rigor::Matrix<3> m;
  m << p.p11, 0.0, 0.0, 0.0, p.p22, p.p23, 0.0, p.p23, p.p33;
  return m;
}

/// The best point of the search space that is found from `seed`, or from the space's own start.
search::BestPoint best_point(const ProposalRequest& request, const BlockCovariance<double>& steady,
                             const std::optional<Eigen::VectorXd>& seed) {
  const ShapeSearch proposer(request, steady);
  search::SearchSpace space = proposer.space();
  if (seed) {
    space.start = *seed;
  }
  const auto search = [&](const auto& value) {
    return search::maximize([&](const Eigen::VectorXd& x) { return value(proposer.shape(x)); }, space);
  };
  if (request.objective == Objective::start_error) {
    return search(
        [&](const Shape& shape) { return proposer.largest_radius(shape) / shape.metric.frequency; });
  }
  space.evaluations *= 6;  // one sample instead of a bisection each time
  if (is_about_a_start(request.objective)) {
    return search([&](const Shape& shape) { return proposer.worth(shape); });
  }
  const double start = proposer.largest_radius(proposer.shape(space.start));
  if (start > 0.0) {
    space.start[space.start.size() - 1] = std::log(0.5 * start);
  }
  return search([&](const Shape& shape) { return proposer.largest_disturbance(shape); });
}

/// The point with one more variable, the last, at the best of its values.
Eigen::VectorXd with_one_more(const Eigen::VectorXd& point, const ShapeSearch& proposer,
                              Objective objective) {
  constexpr double kFirst = -6.0;
  constexpr double kLast = 45.0;
  constexpr double kStep = 1.0;
  Eigen::VectorXd candidate(point.size() + 1);
  candidate << point, kFirst;
  double best_last = kFirst;  // not a second vector: g++ 12 takes its assignment for a use after free
  double most = kWorthless;
  for (double last = kFirst; last <= kLast; last += kStep) {
    candidate[point.size()] = last;
    const Shape shape = proposer.shape(candidate);
    const double value = is_about_a_start(objective)
                             ? proposer.worth(shape)
                             : proposer.largest_radius(shape) / shape.metric.frequency;
    if (value > most) {
      most = value;
      best_last = last;
    }
  }
  candidate[point.size()] = best_last;
  return candidate;
}

/// The points found from the start of the space and, when there is noise or slew, from the best point without
/// it: a little slew then needs no other set than none. The best first.
std::vector<search::BestPoint> best_points(const ProposalRequest& request,
                                           const BlockCovariance<double>& steady) {
  const search::BestPoint best = best_point(request, steady, std::nullopt);
  if (sets_a_disturbance(request.objective) || !(request.noise > 0.0 || request.slew > 0.0)) {
    return {best};
  }
  ProposalRequest quieter = request;
  (request.slew > 0.0 ? quieter.slew : quieter.noise) = 0.0;
  const search::BestPoint without = best_points(quieter, steady).front();
  const search::BestPoint other = best_point(
      request, steady, with_one_more(without.point, ShapeSearch(request, steady), request.objective));
  return other.value > best.value ? std::vector{other, best} : std::vector{best, other};
}

}  // namespace

std::vector<Shape> propose_shapes(const ProposalRequest& request) {
  const auto steady = steady_covariance(request.design);
  if (!steady) {
    return {};
  }
  const bool about_start = is_about_a_start(request.objective);
  const ShapeSearch proposer(request, *steady);
  std::vector<Shape> shapes;
  for (const search::BestPoint& best : best_points(request, *steady)) {
    if (about_start ? !(best.value > kWorthless) : !(best.value > 0.0)) {
      continue;
    }
    Shape shape = proposer.shape(best.point);
    shape.objective = best.value;
    if (request.objective == Objective::start_error) {
      shape.radius = proposer.largest_radius(shape);
    } else if (about_start) {
      const auto promise = proposer.promise(shape);
      shape.radius = promise ? promise->radius : 0.0;
    }
    shapes.push_back(shape);
  }
  return shapes;
}

std::vector<SufficientShape> propose_sufficient_shapes(const ProposalRequest& request) {
  constexpr double kFirst = -0.8;  // good enough for a try
  constexpr double kRoom = 0.98;   // for rounding, and for what sampling does not see
  constexpr int kEvaluations = 100;
  const auto steady = steady_covariance(request.design);
  if (!steady) {
    return {};
  }
  const ShapeSearch proposer(request, *steady);
  search::SearchSpace space = proposer.space();
  space.evaluations = kEvaluations;
  std::vector<SufficientShape> found;
  for (const double enough : {kFirst, std::numeric_limits<double>::infinity()}) {
    space.enough = enough;
    const search::BestPoint best =
        search::maximize([&](const Eigen::VectorXd& x) { return proposer.worth(proposer.shape(x)); }, space);
    Shape shape = proposer.shape(best.point);
    const auto promise = proposer.promise(shape);
    if (!promise) {
      break;
    }
    shape.radius = promise->radius;
    shape.objective = best.value;
    // The less is claimed, the fewer cells prove it.
    for (const double part : {0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9}) {
      if (proposer.shortfall(shape, *promise, part) < kRoom) {
        found.push_back({shape, part});
        break;
      }
    }
    if (!(best.value >= kFirst)) {
      break;  // the search has gone to its end
    }
    space.start = best.point;
  }
  return found;
}

std::optional<CertifiedSet> propose_set(const ProposalRequest& request, const Shape& shape, double fraction) {
  const auto steady = steady_covariance(request.design);
  if (!steady) {
    return std::nullopt;
  }
  const Objective objective = request.objective;
  CertifiedSet set;
  const BlockMetric<double>& t = shape.metric;
  set.metric << t.amplitude, 0.0, 0.0, 0.0, t.phase, t.coupling, 0.0, 0.0, t.frequency;
  set.radius = (objective == Objective::start_error ? fraction : 1.0) * shape.radius;
  set.noise = objective == Objective::noise  ? fraction * shape.objective
              : objective == Objective::slew ? 0.0
                                             : request.noise;
  set.slew = objective == Objective::slew    ? fraction * shape.objective
             : objective == Objective::noise ? 0.0
                                             : request.slew;
  // A smaller disturbance leaves room; half of it goes to the gains.
  const double widening = sets_a_disturbance(objective) ? 1.0 / std::sqrt(fraction) : 1.0;
  set.noise_gain = widening * shape.noise_gain;
  set.slew_gain = widening * shape.slew_gain;
  const StepConstants<double> constants{0.0, set.noise_gain * set.noise_gain, set.slew_gain * set.slew_gain,
                                        set.noise > 0.0, set.slew > 0.0};
  const SampledSet sampled =
      sample_set({request.design, t, set.radius, set.noise, constants, covariance_margin(objective),
                  is_about_a_start(objective) ? request.start_covariance : std::nullopt},
                 *steady);
  // The share that noise and slew leave for the contraction, with room for rounding.
  constexpr double kRoom = 1.0 + 1e-7;
  const double noise = set.noise_gain * set.noise / set.radius;
  const double slew = set.slew_gain * set.slew / set.radius;
  const double allowed = 1.0 - kRoom * (noise * noise + slew * slew);
  const double wanted = is_about_a_start(objective)     ? 1.0 - fraction * (1.0 - sampled.rate_squared)
                        : sets_a_disturbance(objective) ? allowed
                                                        : 0.5 * (1.0 + sampled.rate_squared);
  if (!(sampled.rate_squared < allowed)) {
    return std::nullopt;
  }
  set.rate = std::sqrt(std::min(allowed, wanted)) * (1.0 - 1e-12);
  set.covariance_lower = matrix(sampled.setting.covariance_lower);
  set.covariance_upper = matrix(sampled.setting.covariance_upper);
  return set;
}

}  // namespace veritrack::quadrature
