#include "papers/experiments/zarchan_runs.hpp"

#include <cmath>

#include "papers/experiments/repeated_runs.hpp"
#include "trackers/signals/random.hpp"
#include "trackers/zarchan/zarchan_ekf.hpp"

namespace veritrack::experiments {

namespace {

constexpr double kFirstAmplitude = 3.0;  // AH of the first filter, and A = 1
constexpr double kVelocityVariance = 4.0;
constexpr double kFrequencyVariance = 4.0;
constexpr double kSquareVariance = 16.0;

std::array<double, 3> truth_at(const ZarchanExperiment& experiment, double time) {
  const double w = experiment.frequency;
  switch (experiment.filter) {
    case ZarchanFilter::phase:
      return {w * time, w, 1.0};
    case ZarchanFilter::known_amplitude:
      return {w * time, w, 0.0};
    case ZarchanFilter::oscillator:
      return {std::sin(w * time), w * std::cos(w * time), w};
    case ZarchanFilter::squared_frequency:
      break;
  }
  return {std::sin(w * time), w * std::cos(w * time), w * w};
}

template <typename Filter>
ZarchanRun run_filter(const ZarchanExperiment& experiment, Filter filter, std::uint64_t seed) {
  trackers::RandomStream random(seed);
  const long samples = std::lround(kZarchanSeconds / experiment.interval);
  ZarchanRun run;
  run.reserve(static_cast<std::size_t>(samples));
  for (long k = 1; k <= samples; ++k) {
    const double time = experiment.interval * static_cast<double>(k);
    filter.step(std::sin(experiment.frequency * time) + experiment.noise_deviation * random.normal());
    ZarchanSample sample;
    sample.truth = truth_at(experiment, time);
    const auto& estimate = filter.filtered();
    for (Eigen::Index i = 0; i < estimate.state.size(); ++i) {
      const auto index = static_cast<std::size_t>(i);
      sample.state.at(index) = estimate.state(i);
      sample.deviation.at(index) = std::sqrt(estimate.covariance(i, i));
    }
    run.push_back(sample);
  }
  return run;
}

ZarchanRun run_of(const ZarchanExperiment& experiment, std::uint64_t seed) {
  const double variance = experiment.noise_deviation * experiment.noise_deviation;
  const trackers::ZarchanDesign<double> design{experiment.interval, variance, experiment.process_noise,
                                               experiment.process_noise};
  const double first = experiment.first_estimate;
  const double frequency_variance = (experiment.frequency - first) * (experiment.frequency - first);
  const auto diagonal = [](double a, double b, double c) {
    return Eigen::Matrix3d(Eigen::Vector3d(a, b, c).asDiagonal());
  };
  switch (experiment.filter) {
    case ZarchanFilter::phase:
      return run_filter(
          experiment,
          trackers::SinePhaseEkf<double>(
              design, {Eigen::Vector3d(0.0, first, kFirstAmplitude),
                       diagonal(0.0, frequency_variance, (kFirstAmplitude - 1.0) * (kFirstAmplitude - 1.0))}),
          seed);
    case ZarchanFilter::known_amplitude:
      return run_filter(experiment,
                        trackers::SineKnownAmplitudeEkf<double>(
                            design, 1.0,
                            {Eigen::Vector2d(0.0, first),
                             Eigen::Matrix2d(Eigen::Vector2d(0.0, frequency_variance).asDiagonal())}),
                        seed);
    case ZarchanFilter::oscillator:
      return run_filter(experiment,
                        trackers::OscillatorEkf<double>(
                            design, {Eigen::Vector3d(0.0, 0.0, first),
                                     diagonal(variance, kVelocityVariance, kFrequencyVariance)}),
                        seed);
    case ZarchanFilter::squared_frequency:
      break;
  }
  return run_filter(
      experiment,
      trackers::SquaredFrequencyEkf<double>(design, {Eigen::Vector3d(0.0, 0.0, first * first),
                                                     diagonal(variance, kVelocityVariance, kSquareVariance)}),
      seed);
}

}  // namespace

std::vector<ZarchanRun> zarchan_runs(const ZarchanExperiment& experiment, int runs, int before) {
  return repeat(runs, [&](std::uint64_t seed) {
    return run_of(experiment, seed + static_cast<std::uint64_t>(before));
  });
}

bool stays_within(const ZarchanRun& run, double interval, std::size_t state, double tolerance, double from,
                  double sign) {
  for (std::size_t k = 0; k < run.size(); ++k) {
    const double time = interval * static_cast<double>(k + 1);
    const double error = std::fabs(run[k].state.at(state) - sign * run[k].truth.at(state));
    if (time > from && !(error <= tolerance)) {
      return false;
    }
  }
  return !run.empty();
}

bool within_deviation(const ZarchanRun& run, std::size_t state) {
  const ZarchanSample& last = run.back();
  return std::fabs(last.state.at(state) - last.truth.at(state)) <= last.deviation.at(state);
}

}  // namespace veritrack::experiments
