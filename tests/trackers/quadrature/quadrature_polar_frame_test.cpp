#include "trackers/quadrature/quadrature_polar_frame.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "analysis/rigor/derivatives.hpp"
#include "analysis/rigor/matrix.hpp"
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

using State = PolarFrameState<double>;
using Input = PolarInput<double>;
using Vector9 = Eigen::Matrix<double, 9, 1>;

Vector9 entries(const State& state) {
  Vector9 x;
  x << state.error.amplitude, state.error.phase, state.error.frequency, state.covariance.p11,
      state.covariance.p12, state.covariance.p13, state.covariance.p22, state.covariance.p23,
      state.covariance.p33;
  return x;
}

State random_state(Random& random) {
  return {{random.uniform(-0.5, 0.5), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)},
          PolarCovariance<double>::from_matrix(random_covariance(random))};
}

Input random_input(Random& random) {
  return {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1),
          random.uniform(-3.0, 3.0)};
}

/// The closed loop as the sources have it: the textbook filter in the plane, at the true phase `phase` and
/// `amplitude`, driven by A e^{i phi(k+1)} + v(k+1); the state goes in and comes out in polar coordinates.
Vector9 textbook_closed_loop(const State& state, const Input& input, const ToneModel<double>& design,
                             long double phase, long double amplitude) {
  using Vector3 = Eigen::Matrix<long double, 3, 1>;
  using Matrix3 = Eigen::Matrix<long double, 3, 3>;
  const Vector3 units(amplitude, amplitude, 1.0L);
  const long double frequency = input.frequency;
  const long double estimated_phase = phase + state.error.phase;
  const Matrix3 into = turn(estimated_phase) * units.asDiagonal();
  test::TextbookEkf<long double> textbook{
      design.q1,
      design.q2,
      design.r,
      design.epsilon,
      into * Vector3(1.0L + state.error.amplitude, 0.0L, frequency + state.error.frequency),
      into * state.covariance.matrix().cast<long double>() * into.transpose()};
  const long double next_phase = phase + frequency;
  const long double predicted_phase = estimated_phase + frequency + state.error.frequency;
  const Vector3 y = (turn(next_phase) * Vector3(1.0L, 0.0L, 0.0L) +
                     turn(predicted_phase) * Vector3(input.noise_along, input.noise_across, 0.0L)) *
                    amplitude;
  textbook.step(y.head<2>());
  const long double filtered_phase = std::atan2(textbook.x(1), textbook.x(0));
  const Matrix3 out = (turn(filtered_phase) * units.asDiagonal()).inverse();
  const Matrix3 p = out * textbook.P * out.transpose();
  State next;
  next.error = {static_cast<double>(std::hypot(textbook.x(0), textbook.x(1)) / amplitude - 1.0L),
                static_cast<double>(
                    std::remainder(filtered_phase - next_phase, 2.0L * std::numbers::pi_v<long double>)),
                static_cast<double>(textbook.x(2) - frequency - static_cast<long double>(input.slew))};
  next.covariance = PolarCovariance<double>::from_matrix(p.cast<double>());
  return entries(next);
}

/// How far apart two states are, the phase errors modulo a turn.
double gap(const Vector9& a, const Vector9& b) {
  Vector9 difference = a - b;
  difference(1) = std::remainder(difference(1), 2.0 * std::numbers::pi);
  return difference.cwiseAbs().maxCoeff();
}

TEST_CASE("the polar map is the closed loop of the textbook filter and the true signal") {
  Random random(31);
  const std::int64_t count = test::effort(20000);
  double worst = 0.0;
  for (std::int64_t k = 0; k < count; ++k) {
    auto design = random_design(random);
    const State state = random_state(random);
    const Input input = random_input(random);
    const double amplitude = random_power(random, -2.0, 2.0);
    const auto unit = design;
    design.q1 *= amplitude * amplitude;
    design.r *= amplitude * amplitude;
    const Vector9 expected = textbook_closed_loop(state, input, design, random.uniform(-3.2, 3.2),
                                                  static_cast<long double>(amplitude));
    if (expected(0) < -0.95) {
      continue;  // the phase of an estimate near zero is ill-conditioned
    }
    const Vector9 next = entries(polar_frame_map(state, input, unit));
    worst = std::max(worst, gap(next, expected) / (1.0 + expected.norm()));
  }
  CHECK(worst <= 1e-11);
}

struct PolarFrame {
  using State = PolarFrameState<double>;
  static State from(const QuadratureEstimate<double>& estimate, double phase, double frequency) {
    return to_polar_frame(estimate, 1.0, phase, frequency);
  }
  /// The predicted phase: the true one plus the errors so far.
  static double noise_angle(const State& state, double next_phase) {
    return next_phase + state.error.phase + state.error.frequency;
  }
  static State next(const State& state, const Input& input, const ToneModel<double>& design) {
    return polar_frame_map(state, input, design);
  }
  static double gap(const State& a, const State& b) { return trackers::gap(entries(a), entries(b)); }
};

TEST_CASE("the polar map is the closed loop of the shipped tracker over a run") {
  CHECK(test::worst_gap_over_runs(PolarFrame{}, 32) <= 1e-9);
}

TEST_CASE("without a leak, no errors stay no errors whatever P is") {
  Random random(33);
  for (int k = 0; k < 1000; ++k) {
    auto design = random_design(random);
    design.epsilon = 0.0;
    State state = random_state(random);
    state.error = {0.0, 0.0, 0.0};
    const State next = polar_frame_map(state, {0.0, 0.0, 0.0, random.uniform(-3.0, 3.0)}, design);
    CHECK(next.error.amplitude == 0.0);
    CHECK(next.error.phase == 0.0);
    CHECK(next.error.frequency == 0.0);
  }
}

TEST_CASE("over intervals the map encloses, over dual numbers it differentiates") {
  using rigor::Interval;
  Random random(34);
  const auto map = [](const auto& x, const auto& design) {
    using Scalar = typename std::decay_t<decltype(x)>::Scalar;
    const PolarFrameState<Scalar> state{{x[0], x[1], x[2]}, {x[3], x[4], x[5], x[6], x[7], x[8]}};
    const PolarInput<Scalar> input{Scalar(0.01), Scalar(-0.02), Scalar(0.001), Scalar(0.5)};
    const PolarFrameState<Scalar> next = polar_frame_map(state, input, design);
    Eigen::Matrix<Scalar, 9, 1> y;
    y << next.error.amplitude, next.error.phase, next.error.frequency, next.covariance.p11,
        next.covariance.p12, next.covariance.p13, next.covariance.p22, next.covariance.p23,
        next.covariance.p33;
    return y;
  };
  const auto with_scalar = [](const ToneModel<double>& d, auto zero) {
    using Scalar = decltype(zero);
    return ToneModel<Scalar>{Scalar(d.q1), Scalar(d.q2), Scalar(d.r), Scalar(d.epsilon)};
  };
  int enclosed = 0;
  for (int k = 0; k < 500; ++k) {
    const auto design = random_design(random);
    const State state = random_state(random);
    if (entries(polar_frame_map(state, {0.01, -0.02, 0.001, 0.5}, design))(0) < -0.9) {
      continue;
    }
    const Vector9 x = entries(state);
    const Vector9 expected = map(x, design);
    // Central differences as the oracle of the derivatives.
    const auto jacobian = rigor::jacobian(
        [&](const auto& variable) {
          using Scalar = typename std::decay_t<decltype(variable)>::Scalar;
          return map(variable, with_scalar(design, Scalar(0.0)));
        },
        x);
    for (int j = 0; j < 9; ++j) {
      const double h = 1e-6 * std::max(1e-3, std::fabs(x(j)));
      Vector9 above = x;
      Vector9 below = x;
      above(j) += h;
      below(j) -= h;
      const Vector9 slope = (map(above, design) - map(below, design)) / (2.0 * h);
      CHECK((slope - jacobian.col(j)).norm() <= 1e-4 * (1.0 + slope.norm() + jacobian.norm()));
    }
    const rigor::UpwardRounding upward;
    Eigen::Matrix<Interval, 9, 1> box;
    for (int i = 0; i < 9; ++i) {
      box[i] = Interval::from_bounds(x(i) - 1e-9, x(i) + 1e-9);
    }
    const auto image = map(box, with_scalar(design, Interval(0.0)));
    for (int i = 0; i < 9; ++i) {
      if (is_finite(image[i])) {
        ++enclosed;
        // The double evaluation has rounding errors of its own.
        CHECK(image[i].lower() <= expected(i) + 1e-12 * (1.0 + std::fabs(expected(i))));
        CHECK(image[i].upper() >= expected(i) - 1e-12 * (1.0 + std::fabs(expected(i))));
      }
    }
  }
  CHECK(enclosed > 4000);
}

}  // namespace
}  // namespace veritrack::trackers
