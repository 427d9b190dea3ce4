#include "analysis/quadrature/contraction/sampled_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace veritrack::quadrature {

namespace {

/// Estimates closer to zero than this, along the prediction or the signal, are not worth a try.
constexpr double kLeastComponent = 0.05;

/// The form at a point on its own axis, the correction at these shares of its reach.
PolarStepForm<double, double> form_at(const StepSetting<double>& setting, double scale, double beta,
                                      double along, double across) {
  RayCell<double, double> ray{scale, beta, std::cos(beta), std::sin(beta), along, across, {0.0, 0.0}};
  const PolarStepForm<double, double> still = polar_step_form(setting, ray);
  if (along == 0.0 && across == 0.0) {
    return still;
  }
  ray.reach = still.reach;
  return polar_step_form(setting, ray);
}

/// Moves the covariance bounds of the setting out until the images of the boundary stay between them. False
/// when they run away.
bool find_covariance_bounds(StepSetting<double>& setting, const BlockCovariance<double>& steady,
                            const SampleRequest& request) {
  constexpr int kMostSteps = 80;
  constexpr double kStandstill = 1e-4;
  CovarianceBounds bounds(steady);
  for (int k = 0; k < kMostSteps; ++k) {
    std::array<TurnSample, 9> turns;
    for (std::size_t j = 0; j < turns.size(); ++j) {
      const double beta = std::numbers::pi * static_cast<double>(j) / static_cast<double>(turns.size() - 1);
      const double a = setting.largest_amplitude * std::cos(beta);
      const auto correction = correction_at(setting, a, setting.largest_chi * std::sin(beta));
      if (!(correction.least_along > kLeastComponent)) {
        return false;
      }
      turns[j] = {1.0 + a, correction.turn_tangent};
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
    for (const Sample& sample : kSamples) {
      const auto form = form_at(result.setting, sample.scale, beta, sample.along, sample.across);
      if (!(form.least_along > kLeastComponent) || !(form.mean_real > kLeastComponent)) {
        return result;
      }
      // Where the multiplier of the worst sample so far gives no more, the best multiplier does not either.
      if (worst.multiplier > 0.0 &&
          rate_squared_with(form, metric, request.constants, worst.multiplier) <= worst.rate_squared) {
        continue;
      }
      const RayRate rate = propose_rate(form, metric, request.constants);
      if (!(rate.rate_squared < 1.0)) {
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
