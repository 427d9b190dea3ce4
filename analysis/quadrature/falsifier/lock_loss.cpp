#include "analysis/quadrature/falsifier/lock_loss.hpp"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <numbers>

#include "analysis/quadrature/contraction/covariance_proposal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::quadrature {

namespace {

using FrameState = trackers::RotatingFrameState<double>;
constexpr double kHalfTurn = std::numbers::pi;

/// 1/sigma^2.
double precision_at(double decibels) {
  return 2.0 * std::pow(10.0, 0.1 * decibels);
}

/// One tracker in noise.
struct NoisyRun {
  const trackers::ToneModel<double>& design;
  FrameState steady;
  double deviation, walk;

  /// How often it loses lock within so many samples.
  [[nodiscard]] std::int64_t losses(std::int64_t samples, std::uint64_t seed) const {
    trackers::RandomStream noise(seed);
    FrameState state = steady;
    double phase = 0.0;  // of the estimate beside the true one, turns included
    std::int64_t lost = 0;
    for (std::int64_t k = 0; k < samples; ++k) {
      const double in_phase = deviation * noise.normal();
      const double quadrature = deviation * noise.normal();
      const double step = walk > 0.0 ? walk * noise.normal() : 0.0;
      state = trackers::rotating_frame_map(state, {in_phase, quadrature, step, 0.0}, design);
      const double angle =
          std::atan2(state(trackers::kDeltaQuadrature), 1.0 + state(trackers::kDeltaInPhase));
      phase += std::remainder(angle - phase, 2.0 * kHalfTurn);
      if (!(std::fabs(state(trackers::kFrequencyError)) <= 0.5 * kHalfTurn &&
            std::fabs(phase) <= 2.0 * kHalfTurn)) {
        ++lost;
        state = steady;
        phase = 0.0;
      }
    }
    return lost;
  }
};

constexpr int kRuns = 16;
constexpr std::int64_t kSamplesOfRun = 25'000;
constexpr int kBatches = 5;
/// Enough for a rate within some percent.
constexpr std::int64_t kEnough = 400;

LossRate rate_at(const trackers::ToneModel<double>& design, const FrameState& steady, double walk, int level,
                 double decibels) {
  const NoisyRun run{design, steady, std::sqrt(1.0 / precision_at(decibels)), walk};
  LossRate found{decibels};
  for (int batch = 0; batch < kBatches && found.losses < kEnough; ++batch) {
    std::array<std::int64_t, kRuns> losses{};
    tbb::parallel_for(std::size_t{0}, losses.size(), [&](std::size_t k) {
      const rigor::NearestRounding nearest;
      const auto stream = static_cast<std::uint64_t>((level * kBatches + batch) * kRuns) + k;
      losses[k] = run.losses(kSamplesOfRun, 20261123 + stream);
    });
    for (const std::int64_t count : losses) {
      found.losses += count;
    }
    found.samples += kRuns * kSamplesOfRun;
  }
  return found;
}

/// Where the law is taken to be one.
constexpr double kRare = 5e-4;

/// Weighted least squares; nothing with fewer than two points.
std::optional<LossLaw> law_of(const std::vector<LossRate>& rates) {
  constexpr std::int64_t kFewest = 20;
  double weight = 0.0, sum_x = 0.0, sum_y = 0.0, sum_xx = 0.0, sum_xy = 0.0;
  for (const LossRate& rate : rates) {
    if (rate.rate() <= kRare && rate.losses >= kFewest) {
      // Beside the counts a tenth for what is not a law in it.
      const double w = 1.0 / (1.0 / static_cast<double>(rate.losses) + 0.01);
      const double x = precision_at(rate.decibels);
      const double y = std::log(rate.rate());
      weight += w;
      sum_x += w * x;
      sum_y += w * y;
      sum_xx += w * x * x;
      sum_xy += w * x * y;
    }
  }
  const double spread = weight * sum_xx - sum_x * sum_x;
  if (!(spread > 1e-9 * sum_x * sum_x)) {
    return std::nullopt;
  }
  const double slope = (weight * sum_xy - sum_x * sum_y) / spread;
  if (!(slope < 0.0)) {
    return std::nullopt;
  }
  return LossLaw{(sum_y - slope * sum_x) / weight, slope};
}

}  // namespace

double LossLaw::rate_at(double decibels) const {
  return std::exp(intercept + slope * precision_at(decibels));
}

double LossLaw::decibels_of(double rate) const {
  return 10.0 * std::log10(0.5 * (std::log(rate) - intercept) / slope);
}

LockLoss simulate_lock_loss(const trackers::ToneModel<double>& design, double frequency_walk) {
  const rigor::NearestRounding nearest;
  LockLoss result;
  const std::optional<BlockCovariance<double>> p = steady_covariance(design);
  if (!p) {
    return result;
  }
  FrameState steady;
  steady << 0.0, 0.0, 0.0, p->p11, 0.0, 0.0, p->p22, p->p23, p->p33;
  constexpr int kFirst = -4;  // dB
  constexpr int kLast = 40;
  constexpr std::int64_t kHardlyEver = 20;
  double decibels = kFirst;
  for (int level = 0; decibels <= kLast; ++level) {
    const LossRate found = rate_at(design, steady, frequency_walk, level, decibels);
    result.rates.push_back(found);
    if (found.losses < kHardlyEver) {
      break;
    }
    decibels += found.rate() <= 2.0 * kRare ? 0.5 : 1.0;
  }
  result.law = law_of(result.rates);
  return result;
}

}  // namespace veritrack::quadrature
