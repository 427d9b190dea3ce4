#include "certificates/tuning/trial_run.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/sets/simulation.hpp"
#include "trackers/signals/phasor.hpp"

namespace veritrack::certificates {

namespace {

double middle_of_band(const Assumptions& assume) {
  return 0.5 * (assume.frequency[0].nearest + assume.frequency[1].nearest);
}

/// The estimate with this sample; `sample` is the tone with noise.
double estimate(TrackerRun& tracker, double in_phase, double quadrature) {
  const std::array<double, 2> sample{in_phase, quadrature};
  return tracker.step(std::span(sample).first(static_cast<std::size_t>(tracker.channels()))).frequency;
}

/// The mean square of a run over its later samples; NaN when an estimate is not a number.
double mean_square(const Design& design, const Assumptions& assume, const TrialLength& length, int seed) {
  SimulationSettings settings;
  settings.samples = length.samples;
  settings.seed = static_cast<std::uint64_t>(seed);
  settings.signal = assume.slew.nearest > 0.0 ? "sweep" : "constant";
  const std::vector<trackers::Sample> samples = simulated_signal(assume, settings);
  const TrackerOnSamples run = kind_of(design).track(design);
  const trackers::Sample& first = samples.front();
  // As far off as assumed, each run in another direction: a filter that never removes this error is useless.
  const auto off = [&](int bit, const Number& error) {
    return (seed & bit) == 0 ? error.nearest : -error.nearest;
  };
  run.tracker->start(
      {assume.amplitude.nearest + off(1, assume.initial_amplitude_error),
       std::atan2(first.clean_quadrature, first.clean_in_phase) + off(2, assume.initial_phase_error),
       first.frequency + off(4, assume.initial_frequency_error)});
  const std::size_t settled = samples.size() / 4;
  double sum = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double error =
        estimate(*run.tracker, samples[k].in_phase, samples[k].quadrature) - samples[k].frequency;
    sum += k < settled ? 0.0 : error * error;
  }
  return sum / static_cast<double>(samples.size() - settled);
}

}  // namespace

std::optional<int> response_samples(const Design& design, const Assumptions& assume) {
  const rigor::NearestRounding nearest;
  constexpr int kMost = 20'000;
  constexpr int kBefore = 50;
  const double low = middle_of_band(assume);
  const double step = 1e-3 * std::min(low, 3.14159 - low);
  if (!(step > 0.0)) {
    return std::nullopt;
  }
  const double amplitude = assume.amplitude.nearest;
  const TrackerOnSamples run = kind_of(design).track(design);
  run.tracker->start({amplitude, 0.0, low});
  double phase = 0.0;
  double before = low;
  std::vector<double> estimates;
  estimates.reserve(kMost);
  for (int k = 0; k < kBefore + kMost; ++k) {
    const auto [cosine, sine] = trackers::unit_phasor(phase);
    const double found = estimate(*run.tracker, amplitude * cosine, amplitude * sine);
    if (!std::isfinite(found)) {
      return std::nullopt;
    }
    if (k < kBefore) {
      before = found;
    } else {
      estimates.push_back(found);
    }
    phase = trackers::wrapped(phase + (k < kBefore ? low : low + step));
  }
  const double moved = estimates.back() - before;
  int last_outside = -1;
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    if (!(std::fabs(estimates[k] - estimates.back()) <= 0.1 * std::fabs(moved))) {
      last_outside = static_cast<int>(k);
    }
  }
  constexpr int kNotSettled = kMost / 2;
  return last_outside < kNotSettled && std::fabs(moved) > 0.5 * step ? std::optional(last_outside + 1)
                                                                     : std::nullopt;
}

std::optional<SimulatedRms> simulated_rms(const Design& design, const Assumptions& assume,
                                          const TrialLength& length) {
  const rigor::NearestRounding nearest;
  std::vector<double> squares(static_cast<std::size_t>(length.runs));
  tbb::parallel_for(0, length.runs, [&](int run) {
    const rigor::NearestRounding nearest_in_task;
    squares[static_cast<std::size_t>(run)] = mean_square(design, assume, length, run + 1);
  });
  const double runs = length.runs;
  const double mean = std::accumulate(squares.begin(), squares.end(), 0.0) / runs;
  if (!std::isfinite(mean)) {
    return std::nullopt;
  }
  double scatter = 0.0;
  for (const double each : squares) {
    scatter += (each - mean) * (each - mean);
  }
  const double of_mean = std::sqrt(scatter / (runs * std::max(1.0, runs - 1.0)));
  const double rms = std::sqrt(mean);
  return SimulatedRms{rms, rms > 0.0 ? of_mean / (2.0 * rms) : 0.0};
}

}  // namespace veritrack::certificates
