#include "papers/experiments/sonar_pass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "papers/experiments/repeated_runs.hpp"
#include "trackers/dft_block/block_dft.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::experiments {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kHalfABin = 0.5;

/// The geometry; times in s, centred on the closest approach.
class Pass {
 public:
  explicit Pass(double doppler) : sound_(kSonarCentre * kSpeed / doppler) {}

  /// When what is received at `time` was sent: tau + range(tau) / c = time, by Newton's method.
  [[nodiscard]] double sent(double time) const {
    double tau = time;
    for (int i = 0; i < 20; ++i) {
      const double range = range_at(tau);
      tau -= (tau + range / sound_ - time) / (1.0 + kSpeed * kSpeed * tau / (range * sound_));
    }
    return tau;
  }
  /// The received phase over 2 pi, since the start.
  [[nodiscard]] double turns(double time) const { return kSonarCentre * (sent(time) + 0.5 * kSonarBlocks); }
  [[nodiscard]] double amplitude(double time) const { return 1.0 / range_at(sent(time)); }
  /// When the first block begins.
  [[nodiscard]] double start() const { return 1.0 / sound_ - 0.5 * kSonarBlocks; }
  [[nodiscard]] double sample(double time) const {
    const double turns_now = turns(time);
    return amplitude(time) * std::cos(kTurn * (turns_now - std::floor(turns_now)));
  }

 private:
  // 10 dB down at both ends: range^2 = 10, v tau = 3.
  static constexpr double kSpeed = 3.0 / (0.5 * kSonarBlocks);
  static double range_at(double tau) { return std::sqrt(1.0 + kSpeed * kSpeed * tau * tau); }

  double sound_;  // c, in units of the closest range per s
};

double time_of(const Pass& pass, int block, int sample) {
  return pass.start() + block + static_cast<double>(sample) / kSonarSamples;
}

double decibels(double amplitude) {
  return 20.0 * std::log10(amplitude);
}

}  // namespace

std::vector<SonarBlock> sonar_pass(double doppler) {
  const Pass pass(doppler);
  return repeat(kSonarBlocks, [&](std::uint64_t number) {
    const int block = static_cast<int>(number) - 1;
    trackers::BlockDft<double> transform(kSonarSamples, kSonarCentre, kSonarHalfWidth);
    for (int i = 0; i < kSonarSamples; ++i) {
      (void)transform.push(pass.sample(time_of(pass, block, i)));
    }
    SonarBlock result;
    std::copy(transform.bins().begin(), transform.bins().end(), result.bins.begin());
    const double begin = time_of(pass, block, 0);
    result.amplitude = pass.amplitude(begin + 0.5);
    result.phase = kTurn * pass.turns(begin);
    result.offset = pass.turns(begin + 1.0) - pass.turns(begin) - kSonarCentre;
    return result;
  });
}

std::vector<double> sonar_samples(double doppler, int block, int samples, double noise_variance,
                                  std::uint64_t seed) {
  const rigor::NearestRounding nearest;
  const Pass pass(doppler);
  trackers::RandomStream random(seed);
  const double deviation = std::sqrt(noise_variance);
  std::vector<double> result;
  result.reserve(static_cast<std::size_t>(samples));
  for (int i = 0; i < samples; ++i) {
    result.push_back(pass.sample(time_of(pass, block, i)) + deviation * random.normal());
  }
  return result;
}

SonarRun sonar_run(const std::vector<SonarBlock>& pass, double noise_variance, const SonarDesign& design,
                   SonarStart start, std::uint64_t seed) {
  const rigor::NearestRounding nearest;
  trackers::RandomStream random(seed);
  const double deviation = std::sqrt(noise_variance / (2.0 * kSonarSamples));
  const trackers::DftBlockDesign<double> filter_design{
      design.q1, design.q2, design.q3, design.r / (2.0 * kSonarSamples), 0.0, 0.0};
  const Eigen::Matrix3d covariance = Eigen::Vector3d(design.q1, design.q2, design.q3).asDiagonal();
  constexpr double kPerAmplitude = 2.0 * kTurn;  // 4 pi
  SonarRun run;
  run.offset.reserve(pass.size());
  run.power.reserve(pass.size());
  const SonarBlock& first = pass.front();
  trackers::DftBlockEkf<double> filter(
      filter_design, {std::sqrt(first.amplitude / kPerAmplitude), first.phase, first.offset, covariance});
  for (const SonarBlock& block : pass) {
    std::array<trackers::DftBin<double>, kSonarBins> bins = block.bins;
    for (trackers::DftBin<double>& bin : bins) {
      bin.real += deviation * random.normal();
      bin.imaginary += deviation * random.normal();
    }
    const std::span<const trackers::DftBin<double>> measured(bins);
    if (&block != &first) {
      filter.step(measured);
    } else {
      if (start == SonarStart::initialisation) {
        const auto found = trackers::dft_block_start<double>(measured);
        filter = trackers::DftBlockEkf<double>(filter_design,
                                               {found.root_amplitude, found.phase, found.offset, covariance});
        run.start_error = found.offset - first.offset;
      }
      filter.measurement_update(measured);
    }
    const auto& estimate = filter.filtered();
    run.offset.push_back(estimate.offset);
    run.power.push_back(decibels(kPerAmplitude * estimate.root_amplitude * estimate.root_amplitude));
  }
  return run;
}

SonarScores sonar_scores(const std::vector<SonarBlock>& pass, double noise_variance,
                         const SonarDesign& design, SonarStart start, int runs) {
  struct Score {
    double offset = 0.0, power = 0.0;
    bool good_start = false, tracks = false;
  };
  const auto scores = repeat(runs, [&](std::uint64_t seed) {
    const SonarRun run = sonar_run(pass, noise_variance, design, start, seed);
    Score score;
    for (std::size_t k = 0; k < pass.size(); ++k) {
      const double offset_error = run.offset[k] - pass[k].offset;
      const double power_error = run.power[k] - decibels(pass[k].amplitude);
      score.offset += offset_error * offset_error;
      score.power += power_error * power_error;
    }
    score.good_start = std::fabs(run.start_error) <= kHalfABin;
    score.tracks = std::fabs(run.offset.back() - pass.back().offset) <= kHalfABin;
    return score;
  });
  SonarScores result;
  for (const Score& score : scores) {
    result.offset.push_back(score.offset);
    result.power.push_back(score.power);
    result.good_start.push_back(score.good_start);
    result.tracks.push_back(score.tracks);
  }
  return result;
}

}  // namespace veritrack::experiments
