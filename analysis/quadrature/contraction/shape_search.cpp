#include "analysis/quadrature/contraction/shape_search.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace veritrack::quadrature {

namespace {

constexpr double kLargestRateSquared = 0.985;  // a slower set is useless
constexpr double kClaimedPart = 0.8;           // of the contraction: the rest is left for the verification

/// The largest |T e| of the start.
double start_level(const BlockMetric<double>& t, const rigor::Vector<3>& start) {
  const double across = std::max(std::fabs(t.phase * start[1] + t.coupling * start[2]),
                                 std::fabs(t.phase * start[1] - t.coupling * start[2]));
  return std::hypot(t.amplitude * start[0], across, t.frequency * start[2]);
}

/// |T K| of the unbiased steady state: the least effect of noise.
double least_noise_gain(const BlockMetric<double>& t, const BlockUpdate<double>& steady) {
  return std::max(t.amplitude * steady.gain_amplitude,
                  std::hypot(t.phase * steady.gain_phase + t.coupling * steady.gain_frequency,
                             t.frequency * steady.gain_frequency));
}

}  // namespace

ShapeSearch::ShapeSearch(const ProposalRequest& request, const BlockCovariance<double>& steady)
    : request_(request), steady_(steady), update_(riccati_update(steady, 1.0, request.design)) {
  about_radius_ = sets_a_disturbance(request.objective);
  if (about_radius_) {
    request_.noise = request_.slew = 0.0;
  }
  noisy_ = request_.noise > 0.0 || request.objective == Objective::noise;
  slewing_ = request_.slew > 0.0 || request.objective == Objective::slew;
  if (!is_about_a_start(request.objective)) {
    request_.start_covariance.reset();
  }
}

search::SearchSpace ShapeSearch::space() const {
  struct Variable {
    double start, step, lower, upper;
  };
  std::vector<Variable> variables{{0.0, 0.5, -5.0, 5.0}, {0.0, 0.5, -5.0, 5.0}, {-0.5, 0.3, -8.0, 8.0}};
  for (const bool there : {noisy_, slewing_}) {
    if (there) {
      // A large set has room for large gains.
      variables.push_back({request_.objective == Objective::start_error ? 5.0 : 2.0, 0.5, -6.0, 45.0});
    }
  }
  if (about_radius_) {
    variables.push_back({0.0, 0.5, -12.0, 6.0});
  }
  const auto size = static_cast<Eigen::Index>(variables.size());
  search::SearchSpace space{Eigen::VectorXd(size), Eigen::VectorXd(size), Eigen::VectorXd(size),
                            Eigen::VectorXd(size), request_.evaluations};
  for (Eigen::Index i = 0; i < size; ++i) {
    const Variable& variable = variables[static_cast<std::size_t>(i)];
    space.start[i] = variable.start;
    space.step[i] = variable.step;
    space.lower[i] = variable.lower;
    space.upper[i] = variable.upper;
  }
  return space;
}

Shape ShapeSearch::shape(const Eigen::VectorXd& x) const {
  const double phase = 1.0 / std::sqrt(steady_.p22);
  const double frequency = 1.0 / std::sqrt(steady_.p33);
  Shape shape;
  shape.metric = {std::exp(x[0]) / std::sqrt(steady_.p11), phase, x[2] * frequency,
                  std::exp(x[1]) * frequency};
  Eigen::Index next = 3;
  const auto above_the_least = [&](double least) { return least * std::sqrt(1.0 + std::exp(x[next++])); };
  if (noisy_) {
    shape.noise_gain = above_the_least(least_noise_gain(shape.metric, update_));
  }
  if (slewing_) {
    shape.slew_gain = above_the_least(std::hypot(shape.metric.coupling, shape.metric.frequency));
  }
  shape.radius = about_radius_ ? std::exp(x[next]) : 0.0;
  return shape;
}

SampledSet ShapeSearch::sample(const Shape& shape, double radius, double noise) const {
  return sample_set(
      {request_.design,
       shape.metric,
       radius,
       noise,
       {0.0, shape.noise_gain * shape.noise_gain, shape.slew_gain * shape.slew_gain, noisy_, slewing_},
       covariance_margin(request_.objective),
       request_.start_covariance,
       kLargestRateSquared},
      steady_);
}

double ShapeSearch::pushed(const Shape& shape) const {
  const double noise = shape.noise_gain * request_.noise;
  const double slew = shape.slew_gain * request_.slew;
  return noise * noise + slew * slew;
}

double ShapeSearch::largest_radius(const Shape& shape) const {
  constexpr double kSmallest = 0.001;  // rad/sample
  constexpr double kLargest = 4.0;
  constexpr double kStep = 1.8;
  const double pushed_out = pushed(shape);
  const auto holds = [&](double radius) {
    if (!(pushed_out < radius * radius)) {
      return false;  // whatever the rate
    }
    const double rate_squared = sample(shape, radius, request_.noise).rate_squared;
    return rate_squared < kLargestRateSquared &&
           rate_squared * radius * radius + pushed_out < radius * radius;
  };
  double good = 0.0;
  double bad = kSmallest * shape.metric.frequency;
  while (bad < kLargest * shape.metric.frequency) {
    const bool held = holds(bad);
    if (!held && good > 0.0) {
      break;
    }
    good = held ? bad : good;
    bad *= kStep;
  }
  if (good == 0.0) {
    return 0.0;
  }
  for (int i = 0; i < 8; ++i) {
    const double middle = 0.5 * (good + bad);
    (holds(middle) ? good : bad) = middle;
  }
  return good;
}

double ShapeSearch::largest_disturbance(const Shape& shape) const {
  constexpr double kPart = 0.7;
  const auto tolerated = [&](double noise) {
    const double rate_squared = sample(shape, shape.radius, noise).rate_squared;
    const double gain = noisy_ ? shape.noise_gain : shape.slew_gain;
    return rate_squared < kLargestRateSquared ? shape.radius * std::sqrt(1.0 - rate_squared) / gain
                                              : kWorthless;
  };
  const double first = tolerated(0.0);
  return noisy_ && first > 0.0 ? std::min(first, tolerated(kPart * first)) : first;
}

std::optional<ShapeSearch::Promise> ShapeSearch::promise(const Shape& shape) const {
  constexpr double kRoom = 1.001;
  constexpr int kMostGrowths = 4;
  Promise promise;
  promise.start_level = start_level(shape.metric, request_.start);
  promise.radius = kRoom * promise.start_level;
  for (int i = 0; i < kMostGrowths; ++i) {
    promise.rate_squared = sample(shape, promise.radius, request_.noise).rate_squared;
    if (!(promise.rate_squared < kLargestRateSquared)) {
      return std::nullopt;
    }
    promise.ultimate = std::sqrt(pushed(shape) / (kClaimedPart * (1.0 - promise.rate_squared)));
    if (promise.ultimate <= promise.radius) {
      return promise;
    }
    promise.radius = 1.05 * promise.ultimate;
  }
  return std::nullopt;
}

double ShapeSearch::shortfall(const Shape& shape, const Promise& promise, double part) const {
  const double rate_squared = 1.0 - part * (1.0 - promise.rate_squared);
  const double ultimate = std::sqrt(pushed(shape) / (1.0 - rate_squared));
  const double start = promise.start_level;
  double worst = 0.0;
  if (request_.required.frequency_error) {
    const double bound = std::max(start, ultimate) / shape.metric.frequency;
    worst = bound / *request_.required.frequency_error;
  }
  if (request_.required.samples) {
    const double settled = request_.settled_error * shape.metric.frequency;
    const double above = settled * settled - ultimate * ultimate;
    const double excess = start * start - ultimate * ultimate;
    constexpr double kNever = 1e3;  // worse the further away
    const double samples = !(above > 0.0)   ? kNever * *request_.required.samples * (ultimate / settled)
                           : excess > above ? std::log(above / excess) / std::log(rate_squared) + 1.0
                                            : 0.0;
    worst = std::max(worst, samples / *request_.required.samples);
  }
  return worst;
}

double ShapeSearch::worth(const Shape& shape) const {
  const std::optional<Promise> found = promise(shape);
  if (!found) {
    return kWorthless;
  }
  switch (request_.objective) {
    case Objective::ultimate_error:
      return -found->ultimate / shape.metric.frequency;
    case Objective::settling: {
      // rate^(2k) (l^2 - u^2) + u^2 = (settled |t33|)^2.
      const double settled = request_.settled_error * shape.metric.frequency;
      const double above = settled * settled - found->ultimate * found->ultimate;
      const double start = found->start_level * found->start_level - found->ultimate * found->ultimate;
      if (!(above > 0.0)) {
        constexpr double kNever = 1e9;  // samples; worse the further away
        return -kNever * (found->ultimate / settled);
      }
      return start > above ? -std::log(above / start) / std::log(found->rate_squared) : 0.0;
    }
    case Objective::requirement:
      return -shortfall(shape, *found, kClaimedPart);
    default:
      return -std::max(found->start_level, found->ultimate) / shape.metric.frequency;
  }
}

}  // namespace veritrack::quadrature
