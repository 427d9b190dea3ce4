#include "trackers/quadrature/quadrature_rotating_frame.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "tests/support/random.hpp"
#include "tests/trackers/frame_run.hpp"
#include "tests/trackers/random_tracker.hpp"
#include "tests/trackers/textbook_ekf.hpp"

namespace veritrack::trackers {
namespace {

using test::Random;
using test::random_covariance;
using test::random_design;
using test::random_power;
using test::turn;

using RotatingState = RotatingFrameState<double>;
using RotatingInput = RotatingFrameInput<double>;

RotatingState random_rotating_state(Random& random) {
  const Eigen::Matrix3d p = random_covariance(random);
  RotatingState state;
  state << random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-1.0, 1.0), p(0, 0), p(0, 1),
      p(0, 2), p(1, 1), p(1, 2), p(2, 2);
  return state;
}

RotatingInput random_rotating_input(Random& random) {
  return {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), random.uniform(-0.1, 0.1),
          random.uniform(-3.0, 3.0)};
}

Eigen::Matrix3d covariance_of(const RotatingState& state) {
  Eigen::Matrix3d p;
  p << state(kP11), state(kP12), state(kP13), state(kP12), state(kP22), state(kP23), state(kP13), state(kP23),
      state(kP33);
  return p;
}

/// The closed loop as the sources have it: the textbook filter, driven by A e^{i phi(k+1)} + v(k+1), seen
/// from the frame of the true phase. `amplitude` scales signal, state and noise; the state goes in and comes
/// out relative to amplitude 1.
RotatingState textbook_closed_loop(const RotatingState& state, const RotatingInput& input,
                                   const ToneModel<double>& design, long double phase,
                                   long double amplitude) {
  using Vector3 = Eigen::Matrix<long double, 3, 1>;
  using Matrix3 = Eigen::Matrix<long double, 3, 3>;
  const Vector3 units(amplitude, amplitude, 1.0L);
  const Matrix3 into = turn(phase) * units.asDiagonal();
  const long double frequency = input.frequency;
  test::TextbookEkf<long double> textbook{design.q1,
                                          design.q2,
                                          design.r,
                                          design.epsilon,
                                          into * Vector3(1.0L + state(kDeltaInPhase), state(kDeltaQuadrature),
                                                         frequency + state(kFrequencyError)),
                                          into * covariance_of(state).cast<long double>() * into.transpose()};
  const long double next_phase = phase + frequency;
  const Vector3 y =
      turn(next_phase) * Vector3(1.0L + input.noise_in_phase, input.noise_quadrature, 0.0L) * amplitude;
  textbook.step(y.head<2>());
  const Matrix3 out = (turn(next_phase) * units.asDiagonal()).inverse();
  const Vector3 x = out * textbook.x;
  const Eigen::Matrix3d p = (out * textbook.P * out.transpose()).cast<double>();
  RotatingState next;
  next << static_cast<double>(x(0) - 1.0L), static_cast<double>(x(1)),
      static_cast<double>(x(2) - frequency - static_cast<long double>(input.slew)), p(0, 0), p(0, 1), p(0, 2),
      p(1, 1), p(1, 2), p(2, 2);
  return next;
}

double rotating_gap(const RotatingState& a, const RotatingState& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

TEST_CASE("G is the closed loop of the textbook filter and the true signal") {
  Random random(11);
  const std::int64_t count = test::effort(20000);
  double worst = 0.0;
  for (std::int64_t k = 0; k < count; ++k) {
    const auto design = random_design(random);
    const RotatingState state = random_rotating_state(random);
    const RotatingInput input = random_rotating_input(random);
    const long double phase = random.uniform(-3.2, 3.2);
    const RotatingState expected = textbook_closed_loop(state, input, design, phase, 1.0L);
    worst = std::max(
        worst, rotating_gap(rotating_frame_map(state, input, design), expected) / (1.0 + expected.norm()));
  }
  CHECK(worst <= 1e-11);
}

struct RotatingFrame {
  using State = RotatingFrameState<double>;
  static RotatingState from(const QuadratureEstimate<double>& estimate, double phase, double frequency) {
    return to_rotating_frame(estimate, 1.0, phase, frequency);
  }
  static double noise_angle(const RotatingState& /*state*/, double next_phase) { return next_phase; }
  static RotatingState next(const RotatingState& state, const RotatingInput& input,
                            const ToneModel<double>& design) {
    return rotating_frame_map(state, input, design);
  }
  static double gap(const RotatingState& a, const RotatingState& b) { return rotating_gap(a, b); }
};

TEST_CASE("G is the closed loop of the shipped tracker and the true signal, over a run") {
  CHECK(test::worst_gap_over_runs(RotatingFrame{}, 12) <= 1e-10);
}

TEST_CASE("a filter at amplitude A is the filter (q1/A^2, r/A^2, v/A) at amplitude 1") {
  Random random(13);
  for (int k = 0; k < 5000; ++k) {
    const auto design = random_design(random);
    const RotatingState state = random_rotating_state(random);
    const RotatingInput input = random_rotating_input(random);
    const double amplitude = random_power(random, -2.0, 2.0);
    ToneModel<double> scaled = design;  // what the user runs at this amplitude
    scaled.q1 *= amplitude * amplitude;
    scaled.r *= amplitude * amplitude;
    const RotatingState expected =
        textbook_closed_loop(state, input, scaled, 0.4L, static_cast<long double>(amplitude));
    const RotatingState next = rotating_frame_map(state, input, at_unit_amplitude(scaled, amplitude));
    CHECK(rotating_gap(next, expected) <= 1e-11 * (1.0 + expected.norm()));
  }
}

TEST_CASE("to_rotating_frame of an estimate at amplitude A") {
  Random random(14);
  for (int k = 0; k < 2000; ++k) {
    const auto estimate = test::random_estimate(random);
    const double amplitude = random_power(random, -1.0, 1.0);
    const double phase = random.uniform(-3.2, 3.2);
    const RotatingState state = to_rotating_frame(estimate, amplitude, phase, 0.5);
    Eigen::Vector3d units(1.0 / amplitude, 1.0 / amplitude, 1.0);
    const Eigen::Matrix3d out = units.asDiagonal() * turn(-static_cast<long double>(phase)).cast<double>();
    const Eigen::Vector3d x = out * estimate.state() - Eigen::Vector3d(1.0, 0.0, 0.5);
    const Eigen::Matrix3d p = out * estimate.covariance.matrix() * out.transpose();
    CHECK((state.head<3>() - x).norm() <= 1e-13 * (1.0 + x.norm()));
    CHECK((covariance_of(state) - p).norm() <= 1e-13 * p.norm());
  }
}

TEST_CASE("without leak G does not depend on the frequency; with leak it does") {
  Random random(15);
  for (int k = 0; k < 1000; ++k) {
    auto design = random_design(random);
    const RotatingState state = random_rotating_state(random);
    RotatingInput input = random_rotating_input(random);
    RotatingInput other = input;
    other.frequency = random.uniform(-3.0, 3.0);
    design.epsilon = 0.0;
    CHECK(rotating_frame_map(state, input, design) == rotating_frame_map(state, other, design));
    design.epsilon = 0.01;
    const RotatingState moved =
        rotating_frame_map(state, input, design) - rotating_frame_map(state, other, design);
    CHECK(moved(kFrequencyError) ==
          doctest::Approx(0.01 * (other.frequency - input.frequency)).epsilon(1e-9));
  }
}

TEST_CASE("without leak and noise a frequency error of 2 pi k stays as it is") {
  Random random(16);
  for (int turns = -2; turns <= 2; ++turns) {
    auto design = random_design(random);
    design.epsilon = 0.0;
    RotatingState state = random_rotating_state(random);
    state(kDeltaInPhase) = 0.0;
    state(kDeltaQuadrature) = 0.0;
    state(kFrequencyError) = 2.0 * std::numbers::pi * turns;
    for (int k = 0; k < 50; ++k) {
      state = rotating_frame_map(state, {0.0, 0.0, 0.0, 1.0}, design);
    }
    CHECK(std::fabs(state(kFrequencyError) - 2.0 * std::numbers::pi * turns) <= 1e-12);
    CHECK(state.head<2>().norm() <= 1e-12);
  }
}

TEST_CASE("without leak the fixed point splits into a scalar and a 2x2 Riccati equation") {
  const ToneModel<double> design{0.0023, 0.0023, 0.05, 0.0};
  RotatingState state = RotatingState::Zero();
  state(kP11) = state(kP22) = state(kP33) = 1.0;
  for (int k = 0; k < 2000; ++k) {
    state = rotating_frame_map(state, {0.0, 0.0, 0.0, 1.0}, design);
  }
  CHECK(state.head<3>().norm() <= 1e-15);
  CHECK(std::fabs(state(kP12)) + std::fabs(state(kP13)) <= 1e-15);
  // Amplitude: p = (p + q1) r / (p + q1 + r), a quadratic.
  const double q1 = design.q1;
  CHECK(state(kP11) ==
        doctest::Approx((-q1 + std::sqrt(q1 * q1 + 4.0 * q1 * design.r)) / 2.0).epsilon(1e-13));
  // Phase and frequency: the filter form of P = F P F' + Q, F = [[1, 1], [0, 1]], by its own iteration.
  Eigen::Matrix2d p = Eigen::Matrix2d::Identity();
  Eigen::Matrix2d f;
  f << 1.0, 1.0, 0.0, 1.0;
  for (int k = 0; k < 2000; ++k) {
    const Eigen::Matrix2d predicted =
        f * p * f.transpose() + Eigen::Vector2d(design.q1, design.q2).asDiagonal().toDenseMatrix();
    const Eigen::Vector2d gain = predicted.col(0) / (predicted(0, 0) + design.r);
    p = predicted - gain * predicted.row(0);
  }
  CHECK(state(kP22) == doctest::Approx(p(0, 0)).epsilon(1e-12));
  CHECK(state(kP23) == doctest::Approx(p(0, 1)).epsilon(1e-12));
  CHECK(state(kP33) == doctest::Approx(p(1, 1)).epsilon(1e-12));
}

}  // namespace
}  // namespace veritrack::trackers
