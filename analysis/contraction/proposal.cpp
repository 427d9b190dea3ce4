#include "analysis/contraction/proposal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/contraction/covariance_proposal.hpp"
#include "analysis/contraction/sampled_set.hpp"
#include "analysis/search/maximize.hpp"

namespace veritrack::contraction {

namespace {

constexpr double kLargestRate = 0.995;  // a slower set is of no use

class Proposer {
 public:
  Proposer(const ProposalRequest& request, const BlockCovariance<double>& steady)
      : request_(request), steady_(steady) {
    request_.noise = request.objective == Objective::noise ? 0.0 : request.noise;
    request_.slew = request.objective == Objective::slew ? 0.0 : request.slew;
  }

  /// T from three numbers: the weights of amplitude and frequency against phase, as logarithms, and the
  /// coupling, all in units of the steady state's standard deviations.
  [[nodiscard]] BlockMetric<double> metric(const Eigen::VectorXd& x) const {
    const double phase = 1.0 / std::sqrt(steady_.p22);
    const double frequency = 1.0 / std::sqrt(steady_.p33);
    return {std::exp(x[0]) / std::sqrt(steady_.p11), phase, x[2] * frequency, std::exp(x[1]) * frequency};
  }

  [[nodiscard]] SampledSet sample(const BlockMetric<double>& t, double radius) const {
    return sample(t, radius, request_.noise);
  }
  [[nodiscard]] SampledSet sample(const BlockMetric<double>& t, double radius, double noise) const {
    return sample_set(request_.design, steady_, t, radius, noise);
  }

  /// What one step leaves for noise and slew beyond those that are given, in the metric; -1 when nothing.
  [[nodiscard]] double slack(const SampledSet& s, double radius) const {
    if (!(s.rate < kLargestRate)) {
      return -1.0;
    }
    return (1.0 - s.rate) * radius - s.noise_gain * request_.noise - s.slew_gain * request_.slew;
  }

  /// The largest radius with some slack, 0 if there is none: growth by steps, then bisection.
  [[nodiscard]] double largest_radius(const BlockMetric<double>& t) const {
    constexpr double kSmallest = 0.001;  // rad/sample
    constexpr double kLargest = 4.0;
    constexpr double kStep = 1.8;
    const auto holds = [&](double radius) { return slack(sample(t, radius), radius) > 0.0; };
    double good = 0.0;
    double bad = kSmallest * t.frequency;
    while (bad < kLargest * t.frequency) {
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

  /// The noise or slew that the set bears. Noise turns the estimate and so widens the covariance bounds and
  /// its own gain: the first value is tried, in part, before the second is believed.
  [[nodiscard]] double largest_disturbance(const BlockMetric<double>& t, double radius) const {
    constexpr double kPart = 0.7;
    const SampledSet quiet = sample(t, radius);
    const double left = slack(quiet, radius);
    if (!(left > 0.0)) {
      return left;
    }
    if (request_.objective == Objective::slew) {
      return left / quiet.slew_gain;
    }
    const double first = left / quiet.noise_gain;
    const SampledSet noisy = sample(t, radius, kPart * first);
    const double left_then = slack(noisy, radius);
    return left_then > 0.0 ? std::min(first, left_then / noisy.noise_gain) : 0.5 * left_then;
  }

 private:
  ProposalRequest request_;
  BlockCovariance<double> steady_;
};

search::SearchSpace space_of(int dimensions, int evaluations) {
  search::SearchSpace space;
  space.start = Eigen::Vector4d(0.0, 0.0, -0.5, 0.0).head(dimensions);
  space.step = Eigen::Vector4d(0.5, 0.5, 0.3, 0.5).head(dimensions);
  space.lower = Eigen::Vector4d(-5.0, -5.0, -8.0, -12.0).head(dimensions);
  space.upper = Eigen::Vector4d(5.0, 5.0, 8.0, 6.0).head(dimensions);
  space.evaluations = evaluations;
  return space;
}

rigor::Matrix<3> matrix(const BlockCovariance<double>& p) {
  rigor::Matrix<3> m;
  m << p.p11, 0.0, 0.0, 0.0, p.p22, p.p23, 0.0, p.p23, p.p33;
  return m;
}

}  // namespace

std::optional<Shape> propose_shape(const ProposalRequest& request) {
  const auto steady = steady_covariance(request.design);
  if (!steady) {
    return std::nullopt;
  }
  const Proposer proposer(request, *steady);
  const bool of_start = request.objective == Objective::start_error;
  search::BestPoint best;
  double radius = 0.0;
  if (of_start) {
    best = search::maximize(
        [&](const Eigen::VectorXd& x) {
          const auto t = proposer.metric(x);
          return proposer.largest_radius(t) / t.frequency;
        },
        space_of(3, request.evaluations));
    radius = proposer.largest_radius(proposer.metric(best.point));
  } else {
    // The radius joins the search, as a logarithm; one sample instead of a bisection each time.
    search::SearchSpace space = space_of(4, 4 * request.evaluations);
    const double start = proposer.largest_radius(proposer.metric(space.start));
    if (start > 0.0) {
      space.start[3] = std::log(0.5 * start);
    }
    best = search::maximize(
        [&](const Eigen::VectorXd& x) {
          return proposer.largest_disturbance(proposer.metric(x), std::exp(x[3]));
        },
        space);
    radius = std::exp(best.point[3]);
  }
  if (!(best.value > 0.0)) {
    return std::nullopt;
  }
  const auto t = proposer.metric(best.point);
  return Shape{t.amplitude, t.phase, t.coupling, t.frequency, radius, best.value};
}

std::optional<CertifiedSet> propose_set(const ProposalRequest& request, const Shape& shape, double fraction) {
  const auto steady = steady_covariance(request.design);
  if (!steady) {
    return std::nullopt;
  }
  CertifiedSet set;
  set.metric << shape.amplitude, 0.0, 0.0, 0.0, shape.phase, shape.coupling, 0.0, 0.0, shape.frequency;
  set.radius = shape.radius;
  set.noise = request.noise;
  set.slew = request.slew;
  (request.objective == Objective::start_error ? set.radius
   : request.objective == Objective::noise     ? set.noise
                                               : set.slew) =
      fraction * (request.objective == Objective::start_error ? shape.radius : shape.objective);
  const SampledSet s =
      sample_set(request.design, *steady, {shape.amplitude, shape.phase, shape.coupling, shape.frequency},
                 set.radius, set.noise);
  // What noise and slew need of the contraction, with room for the noise gain to grow in the verification.
  constexpr double kNoiseRoom = 1.25;
  constexpr double kSlewRoom = 1.001;
  const double needed = kNoiseRoom * s.noise_gain * set.noise + kSlewRoom * s.slew_gain * set.slew;
  const double allowed = 1.0 - needed / set.radius;
  if (!(s.rate < allowed)) {
    return std::nullopt;
  }
  set.rate = std::min(allowed, 0.5 * (1.0 + s.rate));
  set.noise_gain = 2.0 * s.noise_gain;
  set.covariance_lower = matrix(s.setting.covariance_lower);
  set.covariance_upper = matrix(s.setting.covariance_upper);
  return set;
}

}  // namespace veritrack::contraction
