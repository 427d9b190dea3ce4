#include "papers/limits/tracking_error.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <stdexcept>

#include "analysis/rigor/rounding.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"
#include "trackers/signals/phasor.hpp"
#include "trackers/signals/random.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"

namespace veritrack::limits {

namespace {

/// Amplitude, phase and frequency.
struct Tone {
  double amplitude = kMeanAmplitude;
  double phase = kMeanPhase;
  double frequency = kMeanFrequency;
};

Tone drawn_tone(const TrackingModel& model, trackers::RandomStream& random) {
  Tone tone;
  tone.amplitude += model.amplitude_deviation * random.normal();
  tone.phase += model.phase_deviation * random.normal();
  tone.frequency += model.frequency_deviation * random.normal();
  return tone;
}

trackers::QuadratureEstimate<double> start_estimate(const TrackingModel& model, const Tone& tone) {
  const auto [cosine, sine] = trackers::unit_phasor(trackers::wrapped(tone.phase));
  const double radial = model.amplitude_deviation * model.amplitude_deviation;
  const double tangential = std::pow(tone.amplitude * model.phase_deviation, 2);
  const trackers::FactoredCovariance<double> covariance{
      radial, 0.0, tangential, 0.0, 0.0, model.frequency_deviation * model.frequency_deviation};
  return turned(trackers::QuadratureEstimate<double>{tone.amplitude, 0.0, tone.frequency, covariance}, sine,
                cosine);
}

/// The sums over a batch of runs.
struct Batch {
  std::vector<double> square;  // sums of squared errors, by sample
  int lost = 0;
};

/// One run of `tracker`; `feed` passes it a measurement.
template <typename Tracker, typename Feed>
void run(const TrackingExperiment& experiment, Tracker tracker, Tone truth, trackers::RandomStream& random,
         const Feed& feed, Batch& batch) {
  const double walk = std::sqrt(experiment.model.walk_variance);
  const double noise = std::sqrt(experiment.model.noise_variance);
  double at_the_end = 0.0;
  for (int k = 1; k <= experiment.samples; ++k) {
    truth.phase = trackers::wrapped(truth.phase + truth.frequency);
    truth.frequency += walk * random.normal();
    const auto [cosine, sine] = trackers::unit_phasor(truth.phase);
    const double in_phase = truth.amplitude * cosine + noise * random.normal();
    const double quadrature = truth.amplitude * sine + noise * random.normal();
    feed(tracker, in_phase, quadrature);
    const double error = tracker.filtered().frequency - truth.frequency;
    batch.square[static_cast<std::size_t>(k - 1)] += error * error;
    at_the_end += k > experiment.samples - kLockWindow ? error * error / kLockWindow : 0.0;
  }
  const bool locked = at_the_end <= kLockThreshold * kLockThreshold;
  batch.lost += locked ? 0 : 1;
}

void run_seed(const TrackingExperiment& experiment, int seed, Batch& batch) {
  const TrackingModel& model = experiment.model;
  trackers::RandomStream random(static_cast<std::uint64_t>(seed));
  const Tone drawn = drawn_tone(model, random);
  const Tone mean;
  const Tone& truth = model.drawn == DrawnAtStart::truth ? drawn : mean;
  const auto start = start_estimate(model, model.drawn == DrawnAtStart::truth ? mean : drawn);
  if (model.channels == Channels::quadrature) {
    const trackers::QuadratureEkf<double> tracker(
        {experiment.tracker_q1, experiment.tracker_q2, model.noise_variance, 0.0}, start);
    run(
        experiment, tracker, truth, random,
        [](auto& filter, double in_phase, double quadrature) { filter.step(in_phase, quadrature); }, batch);
  } else {
    const trackers::SingleChannelEkf<double> tracker(
        {trackers::diagonal_process_noise(experiment.tracker_q1, experiment.tracker_q2), model.noise_variance,
         0.0},
        start);
    run(
        experiment, tracker, truth, random,
        [](auto& filter, double in_phase, double /*quadrature*/) { filter.step(in_phase); }, batch);
  }
}

void require_valid(const TrackingExperiment& experiment) {
  if (experiment.samples < kLockWindow || experiment.first_sample < 1 ||
      experiment.first_sample > experiment.samples || experiment.runs < 1) {
    throw std::invalid_argument("an experiment needs runs, and a window within its samples");
  }
}

}  // namespace

TrackingErrors simulate_tracking(const TrackingExperiment& experiment) {
  require_valid(experiment);
  const rigor::NearestRounding nearest;
  constexpr int kBatches = 20;
  const auto samples = static_cast<std::size_t>(experiment.samples);
  const int count = std::min(kBatches, experiment.runs);
  std::vector<Batch> batches(static_cast<std::size_t>(count), Batch{std::vector<double>(samples, 0.0), 0});
  tbb::parallel_for(0, count, [&](int i) {
    const rigor::NearestRounding nearest_in_task;
    for (int seed = i + 1; seed <= experiment.runs; seed += count) {
      run_seed(experiment, seed, batches[static_cast<std::size_t>(i)]);
    }
  });

  TrackingErrors errors;
  errors.mean_square.assign(samples, 0.0);
  const auto first = static_cast<std::ptrdiff_t>(experiment.first_sample - 1);
  const double window = static_cast<double>(experiment.samples - experiment.first_sample + 1);
  std::vector<double> batch_means;
  batch_means.reserve(batches.size());
  for (std::size_t i = 0; i < batches.size(); ++i) {
    for (std::size_t k = 0; k < samples; ++k) {
      errors.mean_square[k] += batches[i].square[k] / experiment.runs;
    }
    const int runs = (experiment.runs - static_cast<int>(i) + count - 1) / count;
    batch_means.push_back(std::accumulate(batches[i].square.begin() + first, batches[i].square.end(), 0.0) /
                          (runs * window));
    errors.lost += static_cast<double>(batches[i].lost) / experiment.runs;
  }
  errors.window_mean =
      std::accumulate(errors.mean_square.begin() + first, errors.mean_square.end(), 0.0) / window;
  double scatter = 0.0;
  for (const double mean : batch_means) {
    scatter += (mean - errors.window_mean) * (mean - errors.window_mean);
  }
  errors.standard_error = std::sqrt(scatter / (count * (count - 1.0)));  // NaN of one batch: 0 by 0
  return errors;
}

}  // namespace veritrack::limits
