#include "trackers/pendulum/impulsive_pendulum.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "tests/support/random.hpp"

namespace veritrack::trackers {
namespace {

using test::Random;

TEST_CASE("without damping the period is that of the arithmetic-geometric mean") {
  for (const double amplitude : {0.1, 1.0, 2.5}) {
    double a = 1.0;
    double b = std::cos(0.5 * amplitude);
    for (int i = 0; i < 8; ++i) {
      const double mean = 0.5 * (a + b);
      b = std::sqrt(a * b);
      a = mean;
    }
    ImpulsivePendulum<double> pendulum({0.0, 0.0, 1.0}, {amplitude, 0.0});
    pendulum.swing(2.0 * std::numbers::pi / a, 4000);
    CHECK(pendulum.state().angle == doctest::Approx(amplitude).epsilon(1e-9));
    CHECK(std::fabs(pendulum.state().rate) <= 1e-9);
  }
}

TEST_CASE("small swings with damping are those of the linear equation") {
  const double b = 0.2;
  const double beta = std::sqrt(1.0 - 0.25 * b * b);
  ImpulsivePendulum<double> pendulum({b, 0.0, 4.32}, {1e-5, 0.0});
  pendulum.step();
  const double t = 4.32;
  const double exact =
      1e-5 * std::exp(-0.5 * b * t) * (std::cos(beta * t) + 0.5 * b / beta * std::sin(beta * t));
  CHECK(std::fabs(pendulum.state().angle - exact) <= 1e-14);
}

TEST_CASE("full turns and mirror images change nothing, and the impulse is (pi/2)(h - g)") {
  Random random(461);
  for (int k = 0; k < 50; ++k) {
    const PendulumState<double> start{random.uniform(-3.0, 3.0), random.uniform(-2.0, 2.0)};
    const double turn = 2.0 * std::numbers::pi;
    auto model = chaotic_pendulum<double>();
    ImpulsivePendulum<double> one(model, start);
    ImpulsivePendulum<double> turned(model, {start.angle + turn, start.rate});
    ImpulsivePendulum<double> calmed(model, start);
    model.drive = -model.drive;
    ImpulsivePendulum<double> mirrored(model, {-start.angle, -start.rate});
    one.step();
    turned.step();
    mirrored.step();
    calmed.step(2.0);
    CHECK(std::fabs(turned.state().angle - one.state().angle - turn) <= 1e-10);
    CHECK(mirrored.state().angle == -one.state().angle);
    CHECK(one.state().angle - calmed.state().angle == doctest::Approx(std::numbers::pi));
    CHECK(one.state().rate == calmed.state().rate);
  }
}

TEST_CASE("when the control takes the impulses away the damped pendulum comes to rest") {
  ImpulsivePendulum<double> pendulum(chaotic_pendulum<double>(), {0.5, 0.3});
  for (int k = 0; k < 60; ++k) {
    pendulum.step(2.0);
  }
  CHECK(std::hypot(pendulum.state().angle, pendulum.state().rate) <= 1e-9);
}

}  // namespace
}  // namespace veritrack::trackers
