#include <fmt/format.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "certificates/sets/assumptions.hpp"
#include "certificates/single_channel/single_channel.hpp"
#include "certificates/single_channel/single_channel_design.hpp"
#include "trackers/signals/test_signals.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"
#include "trackers/single_channel/single_channel_rotating_frame.hpp"

namespace veritrack::certificates {

namespace {

using trackers::SingleChannelEkf;
using trackers::SingleChannelEstimate;

}  // namespace

Eigen::Matrix3d run_start_covariance(const SingleChannelEkfTables& tables, double frequency, double phase) {
  if (tables.assume.initial_covariance) {
    Eigen::Matrix3d covariance;
    for (Eigen::Index row = 0; row < 3; ++row) {
      for (Eigen::Index column = 0; column < 3; ++column) {
        covariance(row, column) = (*tables.assume.initial_covariance)[static_cast<std::size_t>(row)]
                                                                     [static_cast<std::size_t>(column)]
                                                                         .nearest;
      }
    }
    return covariance;
  }
  constexpr int kSettling = 4000;
  const auto design = nearest_values(tables.design);
  const double amplitude = tables.assume.amplitude.nearest;
  const double first = phase - kSettling * frequency;
  SingleChannelEkf<double> tracker(trackers::single_channel_design(design),
                                   {amplitude * std::cos(first), amplitude * std::sin(first), frequency,
                                    trackers::diagonal_process_noise(design.r + design.q1, design.q2)});
  for (int k = 1; k <= kSettling; ++k) {
    tracker.step(amplitude * std::cos(first + k * frequency));
  }
  return turned(tracker.filtered().covariance, std::sin(-phase), std::cos(-phase)).matrix();
}

Simulation simulate_single_channel(const SingleChannelEkfTables& tables) {
  const rigor::NearestRounding nearest;
  const Assumptions& assume = tables.assume;
  const SimulationSettings& settings = tables.simulate;
  const std::vector<trackers::Sample> samples = simulated_signal(assume, settings);
  Simulation simulation;
  if (!trackers::find_signal(settings.signal).honours_bounds) {
    simulation.notes.push_back(
        fmt::format("The signal `{}` does not satisfy the bounds under *Assumptions*.", settings.signal));
  }
  const trackers::Sample& first = samples.front();
  const double phase =
      std::atan2(first.clean_quadrature, first.clean_in_phase) + assume.initial_phase_error.nearest;
  const double amplitude = assume.amplitude.nearest + assume.initial_amplitude_error.nearest;
  const auto covariance =
      trackers::FactoredCovariance<double>::from_matrix(run_start_covariance(tables, first.frequency, phase));
  SingleChannelEkf<double> tracker(trackers::single_channel_design(nearest_values(tables.design)),
                                   {amplitude * std::cos(phase), amplitude * std::sin(phase),
                                    first.frequency + assume.initial_frequency_error.nearest,
                                    turned(covariance, std::sin(phase), std::cos(phase))});
  simulation.trajectory.reserve(samples.size());
  for (const trackers::Sample& sample : samples) {
    if (!simulation.trajectory.empty()) {
      tracker.measurement_update(sample.in_phase);
    }
    const SingleChannelEstimate<double> filtered = tracker.filtered();
    tracker.time_update();
    simulation.trajectory.push_back({{sample.clean_in_phase, sample.clean_quadrature, sample.frequency},
                                     {sample.in_phase, sample.quadrature},
                                     filtered.state(),
                                     filtered.covariance.matrix(),
                                     tracker.predicted().covariance.matrix()});
  }
  return simulation;
}

}  // namespace veritrack::certificates
