#include "certificates/regulator/regulator_simulation.hpp"

#include <array>
#include <cmath>
#include <span>

#include "analysis/rigor/rounding.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/regulator/regulator.hpp"
#include "trackers/regulator/frequency_regulator.hpp"
#include "trackers/signals/test_signals.hpp"

namespace veritrack::certificates {

namespace {

using Model = trackers::PlantModel<double, kMostPlantOrder>;
using Regulator = trackers::FrequencyRegulator<double, kMostPlantOrder>;
using SimulatedPlant = trackers::Plant<double, kMostPlantOrder>;

/// A plant of lower order is one with zeros.
Model plant_model(const PlantTable& plant) {
  Model model;
  model.a.setZero();
  model.b.setZero();
  for (std::size_t i = 0; i < plant.a.size(); ++i) {
    model.a(static_cast<Eigen::Index>(i)) = plant.a[i].nearest;
    model.b(static_cast<Eigen::Index>(i)) = plant.b[i].nearest;
  }
  return model;
}

/// One channel: the plant, and the regulator with a plant of its own.
struct Channel {
  explicit Channel(const Model& model) : plant(model), known(model), regulator(model) {}
  SimulatedPlant plant, known;
  Regulator regulator;
  double input = 0.0;
};

ClosedLoopRun run_loop(const PlantTable& plant, TrackerRun& tracker,
                       const std::vector<trackers::Sample>& samples) {
  const Model model = plant_model(plant);
  const auto count = static_cast<std::size_t>(tracker.channels());
  std::array<Channel, 2> channels{Channel(model), Channel(model)};
  const trackers::Sample& first = samples.front();
  const double amplitude = std::hypot(first.clean_in_phase, first.clean_quadrature);
  // In lock at sample 0, whose sample the tracker does not use.
  tracker.start({amplitude, std::atan2(first.clean_quadrature, first.clean_in_phase) + first.frequency,
                 first.frequency});
  ClosedLoopRun run;
  run.frequency = first.frequency;
  double frequency = first.frequency;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const trackers::Sample& sample = samples[k];
    const std::array clean{sample.clean_in_phase, sample.clean_quadrature};
    const std::array noisy{sample.in_phase, sample.quadrature};
    std::array<double, 2> answer{}, seen{}, disturbance{};
    for (std::size_t i = 0; i < count; ++i) {
      answer[i] = channels[i].plant.step(channels[i].input);
      seen[i] = answer[i] + noisy[i];
      disturbance[i] = seen[i] - channels[i].known.step(channels[i].input);
    }
    if (k > 0) {
      frequency = tracker.step(std::span(disturbance).first(count)).frequency;
    }
    std::array<double, 3> squares{};
    for (std::size_t i = 0; i < count; ++i) {
      Channel& channel = channels[i];
      channel.input = channel.regulator.step(seen[i], [&](double /*v*/) { return frequency; });
      squares[0] += (answer[i] + clean[i]) * (answer[i] + clean[i]);
      squares[1] += channel.input * channel.input;
      squares[2] += clean[i] * clean[i];
    }
    run.output.push_back(std::sqrt(squares[0]));
    run.input.push_back(std::sqrt(squares[1]));
    run.disturbance.push_back(std::sqrt(squares[2]));
  }
  return run;
}

}  // namespace

std::vector<ClosedLoopRun> simulate_closed_loop(const Certificate& certificate) {
  const RegulatorTables& tables = regulator_tables(certificate.design);
  const FrequencyPromise& promise = regulator_particulars(certificate).promise;
  const Certificate& tracker = regulator_particulars(certificate).tracker;
  if (!promise.objection.empty()) {
    return {};
  }
  const rigor::NearestRounding nearest;
  const double low = promise.frequency[0].nearest;
  const double high = promise.frequency[1].nearest;
  trackers::SignalOptions options{.samples = tables.simulate.samples,
                                  .seed = tables.simulate.seed,
                                  .amplitude = promise.amplitude.nearest,
                                  .frequency_low = low,
                                  .frequency_high = high,
                                  .noise_bound = promise.noise.nearest,
                                  .slew_bound = promise.slew.nearest};
  const bool moves = options.slew_bound > 0.0;
  const std::array frequencies{low, 0.5 * (low + high), high};
  constexpr std::array<std::string_view, 3> kMoving{"sweep", "random-walk", "constant"};
  std::vector<ClosedLoopRun> runs;
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    if (!moves) {
      options.frequency_low = options.frequency_high = frequencies[i];
    }
    const TrackerOnSamples on_samples = kind_of(tracker.design).track(tracker.design);
    runs.push_back(run_loop(tables.plant, *on_samples.tracker,
                            trackers::make_signal(moves ? kMoving[i] : "constant", options)));
  }
  return runs;
}

}  // namespace veritrack::certificates
