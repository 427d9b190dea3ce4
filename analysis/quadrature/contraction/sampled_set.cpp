#include "analysis/quadrature/contraction/sampled_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace veritrack::quadrature {

namespace {

/// Estimates closer to zero than this, along the prediction or the signal, are not worth a try.
constexpr double kLeastComponent = 0.05;

/// A point on its own axis.
RayCell<double, double> ray_at(double scale, double beta) {
  return {scale, beta, std::cos(beta), std::sin(beta), 0.0, 0.0, {0.0, 0.0}};
}

/// Moves the covariance bounds of the setting out until the images of the boundary stay between them. False
/// when they run away.
bool find_covariance_bounds(StepSetting<double>& setting, const BlockCovariance<double>& steady,
                            const SampleRequest& request) {
  constexpr int kMostSteps = 80;
  constexpr double kStandstill = 1e-4;
  CovarianceBounds bounds(steady);
  std::array<ErrorGeometry<double>, 9> errors;
  for (std::size_t j = 0; j < errors.size(); ++j) {
    const double beta = std::numbers::pi * static_cast<double>(j) / static_cast<double>(errors.size() - 1);
    errors[j] = geometry_of(setting.largest_amplitude * std::cos(beta), setting.largest_chi * std::sin(beta));
  }
  for (int k = 0; k < kMostSteps; ++k) {
    std::array<TurnSample, 9> turns;
    for (std::size_t j = 0; j < turns.size(); ++j) {
      const auto correction = turn_at<double, double>(setting, errors[j]);
      if (!(correction.least_along > kLeastComponent)) {
        return false;
      }
      turns[j] = {1.0 + errors[j].amplitude, correction.turn_tangent};
    }
    const double moved = bounds.iterate(turns, setting.design, request.covariance_margin);
    if (request.start_covariance) {
      bounds.include(*request.start_covariance, 0.5 * request.covariance_margin);
    }
    if (!bounds.usable()) {
      return false;
    }
    setting.covariance_lower = bounds.lower();
    setting.covariance_upper = bounds.upper();
    if (moved < kStandstill) {
      break;
    }
  }
  return true;
}

}  // namespace

SampledSet sample_set(const SampleRequest& request, const BlockCovariance<double>& steady) {
  constexpr int kAngles = 16;
  const BlockMetric<double>& metric = request.metric;
  const double amplitude = request.radius / metric.amplitude;
  const double chi = request.radius * std::hypot(1.0 / metric.phase,
                                                 (1.0 - metric.coupling / metric.phase) / metric.frequency);
  SampledSet result{{request.design, metric, steady, steady, amplitude, chi, request.noise},
                    std::numeric_limits<double>::infinity()};
  if (!(amplitude < 0.9) || !(chi < 2.9) || !find_covariance_bounds(result.setting, steady, request)) {
    return result;
  }
  RayRate worst{0.0, 0.0};
  // The boundary with the corners of the covariance bounds decides; the middle of the set seldom does.
  struct Sample {
    double scale, along, across;
  };
  constexpr std::array<Sample, 6> kSamples{{{1.0, -1.0, -1.0},
                                            {1.0, -1.0, 1.0},
                                            {1.0, 1.0, -1.0},
                                            {1.0, 1.0, 1.0},
                                            {0.02, 0.0, 0.0},
                                            {0.6, -1.0, 1.0}}};
  for (int j = 0; j <= kAngles; ++j) {
    const double beta = std::numbers::pi * j / kAngles;
    RayCell<double, double> ray = ray_at(kSamples[0].scale, beta);
    StepWithCorrection<double, double> step = step_with_correction(result.setting, ray);
    for (const Sample& sample : kSamples) {
      if (sample.scale != ray.scale) {
        ray.scale = sample.scale;
        step = step_with_correction(result.setting, ray);
      }
      ray.along = sample.along;
      ray.across = sample.across;
      ray.reach = step.form.reach;
      const auto form = form_where(step, result.setting, ray);
      if (!(form.least_along > kLeastComponent) || !(form.mean_real > kLeastComponent)) {
        return result;
      }
      // Where the multiplier of the worst sample so far gives no more, the best multiplier does not either.
      if (worst.multiplier > 0.0 &&
          rate_squared_with(form, metric, request.constants, worst.multiplier) <= worst.rate_squared) {
        continue;
      }
      const RayRate rate = propose_rate(form, metric, request.constants, worst.rate_squared);
      if (!(rate.rate_squared < request.useless_rate_squared)) {
        return result;
      }
      if (rate.rate_squared > worst.rate_squared) {
        worst = rate;
      }
    }
  }
  result.rate_squared = worst.rate_squared;
  return result;
}

}  // namespace veritrack::quadrature
