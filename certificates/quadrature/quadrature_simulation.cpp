#include "certificates/quadrature/quadrature_simulation.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/sets/assumptions.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"
#include "trackers/signals/test_signals.hpp"

namespace veritrack::certificates {

namespace {

using trackers::RotatingFrameState;
using TrackerDesign = trackers::ToneModel<double>;

TrackerDesign tracker_design(const Design& design) {
  const QuadratureDesignTable& chosen = quadrature_tables(design).design;
  return {chosen.q1.nearest, chosen.q2.nearest, chosen.r.nearest, chosen.epsilon.nearest};
}

Eigen::Matrix3d covariance_of(const RotatingFrameState<double>& state) {
  Eigen::Matrix3d covariance;
  covariance << state(trackers::kP11), state(trackers::kP12), state(trackers::kP13),  //
      state(trackers::kP12), state(trackers::kP22), state(trackers::kP23),            //
      state(trackers::kP13), state(trackers::kP23), state(trackers::kP33);
  return covariance;
}

/// Iterates the noise-free closed loop until it rests. `hold_error_at_zero` iterates the covariance alone.
SteadyState settle(const TrackerDesign& unit_design, double frequency, bool hold_error_at_zero) {
  constexpr int kSteps = 20000;
  constexpr double kAtRest = 1e-13;  // relative change of the covariance in one step
  constexpr double kLocked =
      1.0;  // rad/sample, relative to the amplitude: beyond it the tracker has lost the signal
  RotatingFrameState<double> state = RotatingFrameState<double>::Zero();
  state(trackers::kP11) = state(trackers::kP22) = unit_design.r;
  state(trackers::kP33) = unit_design.r + unit_design.q2;
  for (int step = 0; step < kSteps; ++step) {
    RotatingFrameState<double> next =
        trackers::rotating_frame_map(state, {0.0, 0.0, 0.0, frequency}, unit_design);
    if (hold_error_at_zero) {
      next.head<3>().setZero();
    }
    const double change = (next - state).cwiseAbs().maxCoeff();
    const double size = next.tail<6>().cwiseAbs().maxCoeff();
    state = next;
    if (!state.allFinite() || state.head<3>().cwiseAbs().maxCoeff() > kLocked) {
      return {};
    }
    if (change <= kAtRest * size) {
      return {covariance_of(state), true};
    }
  }
  return {covariance_of(state), false};
}

Eigen::Matrix3d given_covariance(const CovarianceArray& array) {
  Eigen::Matrix3d covariance;
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column) {
      covariance(row, column) =
          array[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)].nearest;
    }
  }
  return covariance;
}

}  // namespace

SteadyState find_steady_state(const Design& design, double frequency) {
  const rigor::NearestRounding nearest;
  const double amplitude = quadrature_tables(design).assume.amplitude.nearest;
  const TrackerDesign unit_design = trackers::at_unit_amplitude(tracker_design(design), amplitude);
  SteadyState state = settle(unit_design, frequency, false);
  if (!state.settled) {
    state = settle(unit_design, frequency, true);
    state.settled = false;
  }
  const Eigen::Vector3d scale(amplitude, amplitude, 1.0);
  state.covariance = scale.asDiagonal() * state.covariance * scale.asDiagonal();
  return state;
}

Eigen::Matrix3d turned_covariance(const Eigen::Matrix3d& covariance, double angle) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn(0, 0) = turn(1, 1) = std::cos(angle);
  turn(1, 0) = std::sin(angle);
  turn(0, 1) = -turn(1, 0);
  return turn * covariance * turn.transpose();
}

SteadyState run_start_covariance(const Design& design, double frequency) {
  const Assumptions& assume = quadrature_tables(design).assume;
  if (assume.initial_covariance) {
    return {given_covariance(*assume.initial_covariance), true};
  }
  if (assume.covariance_range) {
    return {given_covariance((*assume.covariance_range)[1]), true};
  }
  SteadyState steady = find_steady_state(design, frequency);
  if (assume.covariance_multiples) {
    steady.covariance *= (*assume.covariance_multiples)[1].nearest;
  }
  return steady;
}

Simulation simulate_quadrature(const Design& design) {
  const rigor::NearestRounding nearest;
  const Assumptions& assume = quadrature_tables(design).assume;
  const SimulationSettings& settings = quadrature_tables(design).simulate;
  const std::vector<trackers::Sample> samples = simulated_signal(assume, settings);
  Simulation simulation;
  const trackers::Sample& first = samples.front();
  const SteadyState start = run_start_covariance(design, first.frequency);
  if (!start.settled) {
    simulation.notes.push_back(fmt::format(
        "Iteration found no steady state of the tracker at the frequency of the start, {:.6g} rad/sample: "
        "the run starts from the covariance that the recursion reaches after 20000 samples without error.",
        first.frequency));
  }
  if (!trackers::find_signal(settings.signal).honours_bounds) {
    simulation.notes.push_back(
        fmt::format("The signal `{}` does not satisfy the bounds under *Assumptions*: the audit shows where "
                    "it violates them.",
                    settings.signal));
  }

  const double phase =
      std::atan2(first.clean_quadrature, first.clean_in_phase) + assume.initial_phase_error.nearest;
  const double amplitude = assume.amplitude.nearest + assume.initial_amplitude_error.nearest;
  const TrackerDesign tracker = tracker_design(design);
  trackers::QuadratureEkf<double> ekf(
      tracker,
      {amplitude * std::cos(phase), amplitude * std::sin(phase),
       first.frequency + assume.initial_frequency_error.nearest,
       trackers::FactoredCovariance<double>::from_matrix(turned_covariance(start.covariance, phase))});
  simulation.trajectory.reserve(samples.size());
  for (const trackers::Sample& sample : samples) {
    if (!simulation.trajectory.empty()) {
      ekf.measurement_update(sample.in_phase, sample.quadrature);
    }
    const trackers::QuadratureEstimate<double> filtered = ekf.filtered();
    ekf.time_update();
    simulation.trajectory.push_back({{sample.clean_in_phase, sample.clean_quadrature, sample.frequency},
                                     {sample.in_phase, sample.quadrature},
                                     filtered.state(),
                                     filtered.covariance.matrix(),
                                     ekf.predicted().covariance.matrix()});
  }
  return simulation;
}

}  // namespace veritrack::certificates
