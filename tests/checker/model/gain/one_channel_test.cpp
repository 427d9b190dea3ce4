// Bounds of loops of one channel against simulations in doubles.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/checker/model/gain/gain_loops.hpp"
#include "tests/checker/model/gain/type_2_simulation.hpp"

namespace veritrack::checker {
namespace {

using test::attacked_error;
using test::Type2Simulation;

const std::vector<Ball> kNoDeviation(2);

/// The largest errors of random noise of a constant size with signs that last, from such a start, block by
/// block.
bool stays_below(const GainErrors& errors, double wn, double noise, const std::array<double, 2>& start,
                 double amplitude = 1.0) {
  std::mt19937 random(5);
  const auto sign = [&] { return (random() & 1U) != 0U ? 1.0 : -1.0; };
  const unsigned length = static_cast<unsigned>(30.0 / wn);
  for (int trial = 0; trial < 24; ++trial) {
    const double omega = trial % 3 == 0 ? 0.2 : trial % 3 == 1 ? 0.5 : 0.2 + 0.01 * (trial + 1);
    Type2Simulation loop(wn, omega, 0.3 * trial, amplitude);
    loop.start(start[0] * sign(), start[1] * sign());
    const auto lasts =
        1U + static_cast<unsigned>(random()) % (trial % 2 == 0 ? 6U : static_cast<unsigned>(4.0 / wn));
    double push = noise;
    for (unsigned k = 0; k < length; ++k) {
      if (!(std::abs(loop.frequency_error()) <= errors.from(Ball(static_cast<double>(k))).upper_double())) {
        MESSAGE(k << ": " << loop.frequency_error());
        return false;
      }
      push = k % lasts == 0 ? noise * sign() : push;
      loop.step(trial % 4 == 0 ? push : std::copysign(push, push * loop.factor()));
    }
  }
  return true;
}

TEST_CASE("a loop of type 2 of one channel stays below its bounds, and an attack comes near them") {
  struct Case {
    const char* wn;
    std::size_t horizon;
    double tolerated, start_of_phase, start_of_frequency, small, within;
  };
  for (const Case& each : {Case{"0.02", 2048, 0.159, 0.1, 0.002, 0.02, 2.6},
                           Case{"0.001", 32768, 0.278, 0.3, 0.0002, 0.02, 2.0}}) {
    CAPTURE(each.wn);
    const double wn = std::stod(each.wn);
    const GainNetwork network = test::type_2_loop(each.wn).network();
    const GainBounds bounds(network, each.horizon, 64);
    REQUIRE(bounds.is_certain());
    CHECK(test::tolerated_noise(bounds, 2) == doctest::Approx(each.tolerated).epsilon(0.02));
    for (const double noise : {0.0, each.small, 0.1}) {
      const auto errors = bounds.errors(Ball(noise), zero, kNoDeviation);
      REQUIRE(errors.has_value());
      double attack = 0.0;
      for (const double omega : {0.2, 0.33, 0.5}) {
        attack = std::max(attack, attacked_error(Type2Simulation(wn, omega, 0.4), noise, each.horizon / 2));
      }
      CHECK(attack <= errors->for_ever().upper_double());
      // Ripples of ripples are added up from their sizes: the more, the faster the loop. |sin| counts as 1.
      if (noise > 0.0) {
        CHECK(errors->in_long_run().upper_double() < each.within * attack);
      }
      CHECK(stays_below(*errors, wn, noise, {0.0, 0.0}));
    }
    const auto started =
        bounds.errors(Ball(each.small), zero, {Ball(each.start_of_phase), Ball(each.start_of_frequency)});
    REQUIRE(started.has_value());
    CHECK(stays_below(*started, wn, each.small, {each.start_of_phase, each.start_of_frequency}));
    CHECK(started->from(Ball(static_cast<double>(each.horizon))).near() < started->for_ever().near());
    CHECK_FALSE(bounds.errors(zero, Ball(1e-9), kNoDeviation).has_value());  // a slew, with ripples
    CHECK_FALSE(bounds.errors(zero, Ball::everything(), kNoDeviation).has_value());
  }
}

TEST_CASE("of one channel, a constant amplitude may be any in a range, and must not vary") {
  test::Loop loop = test::type_2_loop("0.005");
  loop.least_amplitude = 0.9;
  loop.largest_amplitude = 1.1;
  const GainNetwork network = loop.network();
  const GainBounds bounds(network, 8192, 64);
  REQUIRE(bounds.is_certain());
  const auto errors = bounds.errors(Ball(0.05), zero, kNoDeviation);
  REQUIRE(errors.has_value());
  for (const double amplitude : {0.9, 1.0, 1.1}) {
    CHECK(stays_below(*errors, 0.005, 0.05, {0.0, 0.0}, amplitude));
    CHECK(attacked_error(Type2Simulation(0.005, 0.2, 0.0, amplitude), 0.05, 4096) <=
          errors->for_ever().upper_double());
  }
  loop.amplitude_varies = true;
  CHECK_FALSE(loop.is_covered());
}

/// A loop of one channel with this for e.
bool covers_one_channel(const std::string& lines) {
  test::Loop loop = test::type_2_loop("0.02");
  loop.step = lines + "\nw' = w + c_ki*e\ntheta' = theta + w + d_kp*e\n";
  return loop.is_covered();
}

TEST_CASE("what the rules of one channel do not cover says nothing") {
  const std::string detector = "s = -2*y*sin(theta + w)\n";
  CHECK(covers_one_channel(detector + "e = s"));
  CHECK(covers_one_channel(detector + "e = s + 0.1*y^2*sin(2*theta)"));
  CHECK(covers_one_channel(detector + "e = s + 0.01*y"));
  CHECK(covers_one_channel(detector + "e = s/(1 + w^2)"));
  CHECK(covers_one_channel(detector + "e = s + 0.1*sin(theta)/(2 + cos(theta))"));
  CHECK_FALSE(covers_one_channel(detector + "e = s/(2 + y)"));  // noise in a division
  CHECK_FALSE(covers_one_channel(detector + "e = s/(2 + y*cos(theta))"));
  CHECK_FALSE(covers_one_channel(detector + "e = atan2(y, 0.5*y) + s"));
  CHECK_FALSE(covers_one_channel(detector + "e = atan2(s, theta) + s"));
  CHECK_FALSE(covers_one_channel(detector + "e = s + sin(theta + s)"));  // noise in a ripple's angle
  CHECK_FALSE(covers_one_channel(detector + "e = s + sin(theta + 0.1*sin(theta))"));  // and another ripple
  CHECK(covers_one_channel(detector + "e = s + 0.1*sin(s)"));
  CHECK_FALSE(covers_one_channel(detector + "e = s + theta"));
}

TEST_CASE("a wrong steady state of one channel has a residual") {
  const auto has_small_errors = [](std::size_t state, long turns, double constant) {
    test::Loop loop = test::type_2_loop("0.001");
    loop.steady[state].turns += turns;
    loop.steady[state].constant = Ball(constant);
    if (!loop.is_covered()) {
      return false;
    }
    const GainNetwork network = loop.network();
    const auto errors = GainBounds(network, 16384, 32).errors(zero, zero, kNoDeviation);
    return errors && !certainly_less(Ball(1e-4), errors->for_ever());
  };
  CHECK(has_small_errors(0, 0, 0.0));
  CHECK_FALSE(has_small_errors(0, 0, 0.5));
  CHECK_FALSE(has_small_errors(1, 0, 0.01));
  CHECK_FALSE(has_small_errors(0, 1, 0.0));
  CHECK_FALSE(has_small_errors(0, -1, 0.0));
  CHECK_FALSE(has_small_errors(0, -2, 0.0));  // backwards, which has the same samples
}

}  // namespace
}  // namespace veritrack::checker
