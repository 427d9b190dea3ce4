#include "certificates/quadrature/simulated_limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/quadrature/guarantee.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/quadrature_simulation.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"

namespace veritrack::certificates {

namespace {

using State = trackers::RotatingFrameState<double>;

constexpr int kSamples = 300;

/// The closed loop of one design at one frequency, at amplitude 1.
class ClosedLoop {
 public:
  explicit ClosedLoop(const Design& design) {
    const QuadratureEkfTables& tables = quadrature_tables(design);
    const double amplitude = tables.assume.amplitude.nearest;
    design_ = nearest_at_unit_amplitude(tables);
    frequency_ = 0.5 * (tables.assume.frequency[0].nearest + tables.assume.frequency[1].nearest);
    const Eigen::Vector3d scale(1.0 / amplitude, 1.0 / amplitude, 1.0);
    const Eigen::Matrix3d covariance =
        scale.asDiagonal() * find_steady_state(design, frequency_).covariance * scale.asDiagonal();
    start_ << 0.0, 0.0, 0.0, covariance(0, 0), covariance(0, 1), covariance(0, 2), covariance(1, 1),
        covariance(1, 2), covariance(2, 2);
  }

  [[nodiscard]] State start(double frequency_error) const {
    State state = start_;
    state(trackers::kFrequencyError) = frequency_error;
    return state;
  }
  [[nodiscard]] State next(const State& state, double noise_in_phase, double noise_quadrature) const {
    return trackers::rotating_frame_map(state, {noise_in_phase, noise_quadrature, 0.0, frequency_}, design_);
  }
  [[nodiscard]] State after(State state, int samples) const {
    for (int k = 0; k < samples; ++k) {
      state = next(state, 0.0, 0.0);
    }
    return state;
  }

 private:
  trackers::ToneModel<double> design_{};
  double frequency_ = 0.0;
  State start_;
};

/// The end of the values that pass, counted from zero: the first failure among `steps` values up to `limit`,
/// then bisection.
double last_that_passes(double limit, int steps, const std::function<bool(double)>& passes) {
  double good = 0.0;
  double bad = limit;
  for (int i = 1; i <= steps; ++i) {
    const double value = limit * i / steps;
    if (!passes(value)) {
      bad = value;
      break;
    }
    good = value;
  }
  for (int i = 0; i < 6 && good < limit; ++i) {
    const double middle = 0.5 * (good + bad);
    (passes(middle) ? good : bad) = middle;
  }
  return good;
}

bool locks(const ClosedLoop& loop, const State& reference, double frequency_error) {
  constexpr double kLocked = 1e-3;
  const State end = loop.after(loop.start(frequency_error), kSamples);
  return (end - reference).head<3>().cwiseAbs().maxCoeff() < kLocked;
}

/// Noise of constant size that turns by `turn` rad a sample.
bool stays_in_turning_noise(const ClosedLoop& loop, double noise, double turn) {
  State state = loop.start(0.0);
  for (int k = 0; k < kSamples; ++k) {
    state = loop.next(state, noise * std::cos(turn * k), noise * std::sin(turn * k));
    const bool on_its_side = 1.0 + state(trackers::kDeltaInPhase) > 0.0;
    if (!on_its_side) {
      return false;
    }
  }
  return true;
}

/// Noise of constant size in random directions, the same ones every time.
bool stays_in_random_noise(const ClosedLoop& loop, double noise) {
  std::mt19937_64 engine(1);
  State state = loop.start(0.0);
  for (int k = 0; k < kSamples; ++k) {
    const double angle = 2.0 * std::numbers::pi * (static_cast<double>(engine() >> 11) * 0x1p-53);
    state = loop.next(state, noise * std::cos(angle), noise * std::sin(angle));
    const bool on_its_side = 1.0 + state(trackers::kDeltaInPhase) > 0.0;
    if (!on_its_side) {
      return false;
    }
  }
  return true;
}

bool stays_in_noise(const ClosedLoop& loop, double noise) {
  constexpr std::array<double, 8> kTurns{0.0, 0.05, -0.05, 0.2, -0.2, 1.0, -1.0, std::numbers::pi};
  return stays_in_random_noise(loop, noise) && std::all_of(kTurns.begin(), kTurns.end(), [&](double turn) {
           return stays_in_turning_noise(loop, noise, turn);
         });
}

/// The mean factor per sample while a small error dies out.
double decay_rate(const ClosedLoop& loop) {
  constexpr int kFrom = 10;
  constexpr int kTo = 40;
  const auto distance = [&](int samples) {
    const State difference = loop.after(loop.start(1e-3), samples) - loop.after(loop.start(0.0), samples);
    return difference.head<3>().norm();
  };
  return std::pow(distance(kTo) / distance(kFrom), 1.0 / (kTo - kFrom));
}

}  // namespace

SimulatedLimits find_simulated_limits(const Design& design) {
  const rigor::NearestRounding nearest;
  const ClosedLoop loop(design);
  const State reference = loop.after(loop.start(0.0), kSamples);
  SimulatedLimits limits;
  limits.frequency_error = last_that_passes(std::numbers::pi, 60, [&](double error) {
    return locks(loop, reference, error) && locks(loop, reference, -error);
  });
  limits.noise = last_that_passes(1.5, 30, [&](double noise) { return stays_in_noise(loop, noise); });
  limits.rate = decay_rate(loop);
  return limits;
}

}  // namespace veritrack::certificates
