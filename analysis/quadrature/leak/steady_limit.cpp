#include "analysis/quadrature/leak/steady_limit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/quadrature/leak/steady_samples.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/search/maximize.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Matrix;
constexpr int kCoarseAngles = 12;
constexpr int kFineAngles = 48;
/// The five variables of SteadySamples::metric, the logarithm of the size of level 1 (of no effect where the
/// radius is prescribed), and one that decides about the share of the covariance bounds that a step may fill.
struct Shape {
  Shape(const Eigen::VectorXd& x, double target)
      : of_metric(x.head<5>()), scale(std::exp(x[5])), goal(target - kRange / (1.0 + std::exp(-x[6]))) {}
  static constexpr double kRange = 0.1;
  Eigen::VectorXd of_metric;
  double scale, goal;
};

SteadySamples samples_of(const SteadyRequest& request, double SteadyRequest::*which, double size) {
  SteadyRequest asked = request;
  asked.*which = size;
  return {asked, SteadyJudgement::sharp};
}

/// The metric of level 1.
Matrix<3> metric_of_level_one(const SteadySamples& samples, const Shape& shape, double radius) {
  const Matrix<3> metric = samples.metric(shape.of_metric);
  return metric / (radius > 0.0 ? radius / metric.inverse().row(2).norm() : shape.scale);
}

/// A search for shapes for some steady states.
class LimitSearch {
 public:
  LimitSearch(const SteadyRequest& request, double SteadyRequest::*which, double target)
      : request_(request), which_(which), target_(target) {}

  /// The share of level 1 that a step fills, or more than all of it when there is no sense in it.
  [[nodiscard]] double rate(const Eigen::VectorXd& x, double size) const {
    constexpr double kNoSense = 5.0;
    const SteadySamples samples = samples_of(request_, which_, size);
    const Shape shape(x, target_);
    const double radius = which_ == &SteadyRequest::radius ? size : request_.radius;
    auto settings = samples.settings(metric_of_level_one(samples, shape, radius));
    const double noise = which_ == &SteadyRequest::noise ? size : request_.noise;
    if (!samples.find_band(settings, noise, shape.goal, kCoarseAngles)) {
      return kNoSense;
    }
    return std::min(kNoSense - 1.0, samples.rate(settings, 1.0, noise, kCoarseAngles));
  }

  /// Moves the shape to where the rate is small.
  void improve(Eigen::VectorXd& x, double size, double step) const {
    const double good_enough = target_ - 0.045;
    search::SearchSpace space;
    space.start = x;
    space.step.resize(7);
    space.step << 0.4, 0.4, -0.4, 0.3, 0.3, 0.3, -0.5;
    space.step *= step;
    space.lower = Eigen::VectorXd::Constant(7, -6.0);
    space.upper = Eigen::VectorXd::Constant(7, 6.0);
    space.evaluations = 2 * request_.evaluations;
    x = search::maximize(
            [&](const Eigen::VectorXd& trial) { return -std::max(rate(trial, size), good_enough); }, space)
            .point;
  }

  /// Raises the size as far as the rate stays good enough.
  void raise(const Eigen::VectorXd& x, double& size) const {
    constexpr int kSteps = 8;
    for (double factor = 1.6; factor > 1.005; factor = std::sqrt(factor)) {
      for (int i = 0; i < kSteps && rate(x, factor * size) < target_ + kTolerance; ++i) {
        size *= factor;
      }
    }
  }

  /// Rounds of both, until not much is gained.
  void climb(Eigen::VectorXd& x, double& size, int rounds) const {
    constexpr double kEnough = 1.01;
    constexpr int kLeast = 3;
    for (int round = 0; round < rounds; ++round) {
      const double before = size;
      improve(x, size, round == 0 ? 1.0 : 0.4);
      raise(x, size);
      if (round >= kLeast && size < kEnough * before) {
        break;
      }
    }
  }

  /// The shape, when samples see it map level 1 into less than `most`.
  [[nodiscard]] std::optional<SteadyLimit> limit_of(const Eigen::VectorXd& x, double size,
                                                    double most) const {
    if (!(rate(x, size) < most)) {
      return std::nullopt;
    }
    const Shape shape(x, target_);
    const SteadySamples samples(request_, SteadyJudgement::sharp);
    const double radius = which_ == &SteadyRequest::radius ? size : request_.radius;
    return SteadyLimit{metric_of_level_one(samples, shape, radius), shape.goal, size, x};
  }

  static constexpr double kTolerance = 0.003;

 private:
  SteadyRequest request_;
  double SteadyRequest::*which_;
  double target_;
};

}  // namespace

std::optional<SteadyLimit> propose_steady_limit(const SteadyRequest& request, double SteadyRequest::*size,
                                                double target, const std::vector<SteadyLimit>& harder) {
  const rigor::NearestRounding nearest;
  // Where to begin, as a share of the amplitude, rad/sample per sample or rad/sample, and how to go on from
  // one frequency. A small set has no room for the noise.
  constexpr double kLeast = 1e-4;
  const double first =
      size == &SteadyRequest::radius ? std::max(10.0 * kLeast, 15.0 * request.noise) : kLeast;
  constexpr double kShare = 0.5;
  constexpr int kRounds = 8;
  SteadyRequest last = request;
  last.steady = {request.steady.back()};
  if (!request.slopes.empty()) {
    last.slopes = {request.slopes.back()};
  }
  Eigen::VectorXd x = Eigen::VectorXd::Zero(7);
  x[5] = -0.7;
  double most = first;
  LimitSearch(last, size, target).climb(x, most, kRounds);
  const LimitSearch all(request, size, target);
  if (request.steady.size() > 1) {
    most = std::max(first, kShare * most);
    all.climb(x, most, kRounds);
  }
  std::optional<SteadyLimit> best = all.limit_of(x, most, 1.0);
  for (const SteadyLimit& known : harder) {
    x = known.point;
    most = known.size;
    all.climb(x, most, kRounds);
    std::optional<SteadyLimit> found = all.limit_of(x, most, 1.0);
    if (found && (!best || found->size > best->size)) {
      best = std::move(found);
    }
  }
  return best;
}

std::optional<SteadyLimit> propose_steady_size(const SteadyRequest& request, double SteadyRequest::*size,
                                               double target, const Eigen::VectorXd& point) {
  const rigor::NearestRounding nearest;
  constexpr int kRounds = 3;
  const LimitSearch search(request, size, target);
  Eigen::VectorXd x = point;
  for (int round = 0; round < kRounds; ++round) {
    search.improve(x, request.*size, round == 0 ? 0.5 : 0.3);
    if (auto found = search.limit_of(x, request.*size, target)) {
      return found;
    }
  }
  return std::nullopt;
}

std::optional<SteadySet> set_of_limit(const SteadyRequest& request, const SteadyLimit& limit) {
  const rigor::NearestRounding nearest;
  constexpr double kRoom = 0.985;
  const SteadySamples samples(request, SteadyJudgement::sharp);
  auto settings = samples.settings(limit.metric);
  if (!samples.find_band(settings, request.noise, limit.goal, kFineAngles) ||
      !(samples.rate(settings, 1.0, request.noise, kFineAngles) < kRoom)) {
    return std::nullopt;
  }
  SteadySet set;
  set.metric = limit.metric;
  set.below = settings.front().band.below.matrix();
  set.above = settings.front().band.above.matrix();
  set.noise = request.noise;
  set.slew = request.slew;
  set.levels = {1.0};
  return set;
}

}  // namespace veritrack::quadrature
