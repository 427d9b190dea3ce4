#include "trackers/single_channel/single_channel_rotating_frame.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <numbers>

#include "tests/support/random.hpp"
#include "tests/trackers/random_tracker.hpp"
#include "tests/trackers/textbook_single_channel_ekf.hpp"

namespace veritrack::trackers {
namespace {

using test::Random;
using State = RotatingFrameState<double>;
using Matrix3 = Eigen::Matrix<long double, 3, 3>;
using Vector3 = Eigen::Matrix<long double, 3, 1>;

Matrix3 turn(long double angle) {
  Matrix3 u = Matrix3::Identity();
  u(0, 0) = u(1, 1) = std::cos(angle);
  u(1, 0) = std::sin(angle);
  u(0, 1) = -u(1, 0);
  return u;
}

State random_state(Random& random) {
  const Eigen::Matrix3d p = test::random_covariance(random);
  State state;
  state << random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-1.0, 1.0), p(0, 0), p(0, 1),
      p(0, 2), p(1, 1), p(1, 2), p(2, 2);
  return state;
}

TEST_CASE("the map over the phase is the textbook filter seen from the frame of the true phase") {
  Random random(71);
  const std::int64_t count = test::effort(20000);
  double worst = 0.0;
  for (std::int64_t k = 0; k < count; ++k) {
    const auto design = test::random_design(random);
    const State state = random_state(random);
    const double frequency = random.uniform(-3.0, 3.0);
    const double next_phase = random.uniform(-3.0, 3.0);
    const SingleChannelInput<double> input{next_phase, random.uniform(-0.2, 0.2), random.uniform(-0.1, 0.1),
                                           frequency};
    const Matrix3 into = turn(static_cast<long double>(next_phase) - static_cast<long double>(frequency));
    Matrix3 p;
    p << state(kP11), state(kP12), state(kP13), state(kP12), state(kP22), state(kP23), state(kP13),
        state(kP23), state(kP33);
    test::TextbookSingleChannelEkf<long double> textbook{
        single_channel_design(design).process_noise.matrix().cast<long double>(), design.r, design.epsilon,
        into * Vector3(1.0L + state(kDeltaInPhase), state(kDeltaQuadrature), 0.0L) +
            Vector3(0.0L, 0.0L, static_cast<long double>(frequency) + state(kFrequencyError)),
        into * p * into.transpose()};
    textbook.step(std::cos(static_cast<long double>(next_phase)) + static_cast<long double>(input.noise));
    const Matrix3 out = turn(-static_cast<long double>(next_phase));
    const Vector3 x = out * textbook.x;
    const Matrix3 q = out * textbook.P * out.transpose();
    State expected;
    expected << static_cast<double>(x(0) - 1.0L), static_cast<double>(x(1)),
        static_cast<double>(x(2) - frequency - static_cast<long double>(input.slew)),
        static_cast<double>(q(0, 0)), static_cast<double>(q(0, 1)), static_cast<double>(q(0, 2)),
        static_cast<double>(q(1, 1)), static_cast<double>(q(1, 2)), static_cast<double>(q(2, 2));
    const double gain = 1.0 + 1.0 / std::sqrt(static_cast<double>(textbook.S));
    worst = std::max(worst, (single_channel_map(state, input, design) - expected).norm() / gain);
  }
  CAPTURE(worst);
  CHECK(worst <= 1e-12);
}

TEST_CASE("the map is pi-periodic in the phase") {
  Random random(72);
  for (int k = 0; k < 2000; ++k) {
    const auto design = test::random_design(random);
    const State state = random_state(random);
    const double phase = random.uniform(-3.0, 3.0);
    const double frequency = random.uniform(0.0, 3.0);
    const auto image = [&](double next_phase) {
      return single_channel_map(state, {next_phase, 0.0, 0.0, frequency}, design);
    };
    const State here = image(phase);
    CHECK((image(phase + std::numbers::pi) - here).norm() <= 1e-11 * (1.0 + here.norm()));
  }
}

TEST_CASE("without leak, noise and slew the truth is left alone at every phase and frequency") {
  Random random(73);
  for (int k = 0; k < 2000; ++k) {
    auto design = test::random_design(random);
    design.epsilon = 0.0;
    State state = random_state(random);
    state.head<3>().setZero();
    const State next =
        single_channel_map(state, {random.uniform(-3.0, 3.0), 0.0, 0.0, random.uniform()}, design);
    CHECK(next.head<3>().cwiseAbs().maxCoeff() <= 1e-15);
  }
}

}  // namespace
}  // namespace veritrack::trackers
