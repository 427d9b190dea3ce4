#include "papers/claims/pendulum_horseshoe.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"
#include "trackers/pendulum/impulsive_pendulum.hpp"

using namespace veritrack;
using rigor::Interval;

namespace {

/// The state centre + a u + c s, after an interval and its impulse, as simulated.
trackers::PendulumState<double> simulated_image(double a, double c) {
  trackers::ImpulsivePendulum<double> pendulum(
      trackers::chaotic_pendulum<double>(),
      {4.4375 + a * 0.8971 + c * 0.7345, -1.4351 + a * 0.4419 - c * 0.6786});
  pendulum.step();
  return pendulum.state();
}

/// Coordinates about the centre, or about its mirror image moved by two turns.
std::pair<double, double> coordinates(const trackers::PendulumState<double>& at, bool is_mirrored) {
  const double angle = is_mirrored ? at.angle + 4.4375 - 4.0 * std::numbers::pi : at.angle - 4.4375;
  const double rate = is_mirrored ? at.rate - 1.4351 : at.rate + 1.4351;
  const double determinant = 0.8971 * -0.6786 - 0.4419 * 0.7345;
  return {(angle * -0.6786 - rate * 0.7345) / determinant, (0.8971 * rate - 0.4419 * angle) / determinant};
}

}  // namespace

TEST_CASE("the verified image of a box of states holds the simulated one of each of them") {
  test::Random random(4'321);
  for (std::int64_t i = 0; i < test::effort(40); ++i) {
    const double a = random.uniform(-0.3, 0.3);
    const double c = random.uniform(-0.4, 0.4);
    const double size = std::pow(10.0, random.uniform(-6.0, -2.5));
    theorems::PendulumBox image;
    {
      const rigor::UpwardRounding upward;
      image =
          theorems::image_of_states(Interval::from_bounds(a, a + size), Interval::from_bounds(c, c + size));
    }
    REQUIRE(rigor::is_finite(image.angle));
    constexpr double kRungeKutta = 1e-9;
    for (int k = 0; k < 5; ++k) {
      const auto at = simulated_image(a + random.uniform(0.0, size), c + random.uniform(0.0, size));
      CHECK(at.angle > image.angle.lower() - kRungeKutta);
      CHECK(at.angle < image.angle.upper() + kRungeKutta);
      CHECK(at.rate > image.rate.lower() - kRungeKutta);
      CHECK(at.rate < image.rate.upper() + kRungeKutta);
    }
    // And it is not much larger: a neighbourhood grows some fortyfold.
    CHECK(image.angle.upper() - image.angle.lower() < 200.0 * size + 1e-9);
  }
}

TEST_CASE("the images cross, as verified and as simulated") {
  {
    const rigor::UpwardRounding upward;
    long boxes = 0;
    CHECK(theorems::has_horseshoe(&boxes) == rigor::Verdict::proved);
    CHECK(boxes > 20);
    // An edge that is not beyond the target, another target, an image that leaves through the top.
    using rigor::Verdict;
    CHECK(theorems::crosses({0.0, 0.04}, false) == Verdict::undecided);
    CHECK(theorems::crosses({-0.04, 0.005}, false) == Verdict::undecided);
    CHECK(theorems::crosses({-0.04, 0.04}, true) == Verdict::undecided);
    CHECK(theorems::crosses({0.1, 0.22, "0.05"}, true) == Verdict::undecided);
  }
  for (const bool is_mirrored : {false, true}) {
    const double left = is_mirrored ? 0.1 : -0.04;
    const double right = is_mirrored ? 0.22 : 0.04;
    for (int j = -3; j <= 3; ++j) {
      const double c = 0.1 * j;
      CHECK(coordinates(simulated_image(left, c), is_mirrored).first < -0.25);
      CHECK(coordinates(simulated_image(right, c), is_mirrored).first > 0.25);
      for (int i = 0; i <= 60; ++i) {
        const auto [a, height] =
            coordinates(simulated_image(left + (right - left) * i / 60.0, c), is_mirrored);
        CHECK((std::fabs(a) > 0.25 || std::fabs(height) < 0.3));
      }
    }
  }
}
