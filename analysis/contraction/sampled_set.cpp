#include "analysis/contraction/sampled_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/contraction/covariance_proposal.hpp"
#include "analysis/contraction/error_contraction.hpp"

namespace veritrack::contraction {

namespace {

/// Estimates closer to zero than this, along the prediction or the signal, are not worth a try.
constexpr double kLeastComponent = 0.05;

/// Moves the covariance bounds of the setting out until the images of the rim stay between them. False when
/// they run away.
bool find_covariance_bounds(StepSetting<double>& setting, const BlockCovariance<double>& steady) {
  constexpr int kMostSteps = 80;
  constexpr double kMargin = 0.02;  // in units of the steady state: room for a proof
  constexpr double kStandstill = 1e-4;
  CovarianceBounds bounds(steady);
  for (int k = 0; k < kMostSteps; ++k) {
    std::array<TurnSample, 9> turns;
    for (std::size_t j = 0; j < turns.size(); ++j) {
      const double beta = std::numbers::pi * static_cast<double>(j) / static_cast<double>(turns.size() - 1);
      const auto form = polar_step_form(setting, {1.0, std::cos(beta), std::sin(beta), 0.0, 0.0});
      if (!(form.least_along > kLeastComponent)) {
        return false;
      }
      turns[j] = {form.rho, form.turn_tangent};
    }
    const double moved = bounds.iterate(turns, setting.design, kMargin);
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

SampledSet sample_set(const trackers::QuadratureEkfDesign<double>& design,
                      const BlockCovariance<double>& steady, const BlockMetric<double>& metric, double radius,
                      double noise) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr int kAngles = 16;
  const double amplitude = radius / metric.amplitude;
  const double chi =
      radius * std::hypot(1.0 / metric.phase, (1.0 - metric.coupling / metric.phase) / metric.frequency);
  SampledSet result{{design, metric, steady, steady, amplitude, chi, noise},
                    kInfinity,
                    kInfinity,
                    std::hypot(metric.coupling, metric.frequency)};
  if (!(amplitude < 0.9) || !(chi < 2.9) || !find_covariance_bounds(result.setting, steady)) {
    return result;
  }
  double rate_squared = 0.0;
  double noise_gain = 0.0;
  // The rim with the corners of what the covariance may do decides; the middle of the set seldom does.
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
      const auto form = polar_step_form(
          result.setting, {sample.scale, std::cos(beta), std::sin(beta), sample.along, sample.across});
      if (!(form.least_along > kLeastComponent) || !(form.mean_real > kLeastComponent)) {
        return result;
      }
      rate_squared = std::max(rate_squared, propose_rate(form, metric).rate_squared);
      noise_gain = std::max(noise_gain, form.noise_gain);
      if (!(rate_squared < 1.0)) {
        return result;
      }
    }
  }
  result.rate = std::sqrt(rate_squared);
  result.noise_gain = noise_gain;
  return result;
}

}  // namespace veritrack::contraction
