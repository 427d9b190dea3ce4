// Bounds by gains against sums and simulations in doubles.
#include "checker/model/gain/gain_bounds.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "tests/checker/model/gain/gain_loops.hpp"

namespace veritrack::checker {
namespace {

using test::Loop;

/// The loop of the motor, from the phase of the signal: phase and frequency errors, rad and rad/sample.
struct Errors {
  double phase = 0.0, frequency = 0.0;
  void step(double noise_angle) {
    const double d = std::remainder(noise_angle - phase, 2.0 * 3.14159265358979323846);
    phase += frequency + 0.16 * d;
    frequency += 30000.0 / 12500 / 12500 * d;
  }
};

const std::vector<Ball> kSteady(2);

TEST_CASE("the bound of a loop that is linear is its gain, and an attack reaches it") {
  const GainNetwork network = test::motor_loop().network();
  const GainBounds bounds(network, 16384, 64);
  REQUIRE(bounds.is_certain());
  for (const double noise : {0.02, 0.3, 0.9}) {
    const double angle = std::asin(noise);
    // The response to one angle, and the worst signs.
    std::vector<double> response;
    Errors after;
    after.step(1e-3);
    for (int k = 0; k < 16000; ++k) {
      response.push_back(after.frequency / 1e-3);
      after.step(0.0);
    }
    double gain = 0.0;
    for (const double each : response) {
      gain += std::abs(each);
    }
    Errors attacked;
    for (std::size_t k = response.size(); k-- > 0;) {
      attacked.step(response[k] > 0.0 ? angle : -angle);
    }
    const auto errors = bounds.errors(Ball(noise), zero, kSteady);
    REQUIRE(errors.has_value());
    CHECK(errors->for_ever().near() == doctest::Approx(gain * angle).epsilon(1e-4));
    CHECK(attacked.frequency <= errors->for_ever().upper_double());
    CHECK(attacked.frequency >= 0.999 * errors->for_ever().near());
    CHECK(errors->in_long_run().near() == doctest::Approx(gain * angle).epsilon(1e-4));
  }
  CHECK(test::tolerated_noise(bounds, 2) > 0.99);
  CHECK_FALSE(bounds.errors(Ball(1.0), zero, kSteady).has_value());
  CHECK_FALSE(bounds.errors(Ball::everything(), zero, kSteady).has_value());
  CHECK_FALSE(bounds.errors(Ball(0.1), Ball::everything(), kSteady).has_value());
  CHECK_FALSE(bounds.errors(Ball(0.1), zero, {Ball::everything(), zero}).has_value());
  CHECK_FALSE(bounds.errors(Ball(0.1), zero, {zero}).has_value());
}

TEST_CASE("starts and a slew are followed, block by block") {
  const GainNetwork network = test::motor_loop().network();
  const GainBounds bounds(network, 8192, 256);
  REQUIRE(bounds.is_certain());
  const double slew = 1e-6;
  const auto errors = bounds.errors(Ball(0.02), Ball(slew), {Ball(0.1), Ball(10.0)});
  REQUIRE(errors.has_value());
  std::mt19937 random(3);
  const auto sign = [&] { return (random() & 1U) != 0U ? 1.0 : -1.0; };
  double last = errors->for_ever().near();
  for (int trial = 0; trial < 10; ++trial) {
    Errors x{0.1 * sign(), 10.0 * sign() / 12500};
    double noise = std::asin(0.02) * sign();
    double moves = slew * sign();
    for (int k = 0; k < 9000; ++k) {
      const Ball bound = errors->from(Ball(k));
      if (!(std::abs(x.frequency) <= bound.upper_double())) {
        REQUIRE(std::abs(x.frequency) <= bound.upper_double());
      }
      if (trial == 0) {
        CHECK(bound.near() <= last * (1.0 + 1e-9));
        last = bound.near();
      }
      if (random() % 50 == 0) {
        noise = std::asin(0.02) * sign();
        moves = slew * sign();
      }
      x.step(noise);
      // The state stays, and the frequency of the signal and with it the steady state moves.
      x.frequency -= moves;
    }
  }
  CHECK(errors->from(Ball(8192.0)).near() < 0.9 * errors->for_ever().near());
  CHECK(errors->in_long_run().near() <= errors->from(Ball(1e9)).near());
  // A step of W in the frequency at each sample: the slowest response. An exact sum of it.
  const auto moving = bounds.errors(zero, Ball(slew), kSteady);
  double sum = 0.0;
  Errors after{0.0, slew};
  for (int k = 0; k < 9000; ++k) {
    sum += std::abs(after.frequency);
    after.step(0.0);
  }
  REQUIRE(moving.has_value());
  CHECK(moving->for_ever().near() == doctest::Approx(sum).epsilon(1e-3));
}

TEST_CASE("the known limits of noise") {
  const auto tolerated = [](const Loop& loop) {
    const GainNetwork network = loop.network();
    return test::tolerated_noise(GainBounds(network, 2048, 32), network.states());
  };
  CHECK(tolerated(test::third_order_loop()) == doctest::Approx(0.967).epsilon(2e-3));
  CHECK(tolerated(test::output_loop()) == doctest::Approx(0.610).epsilon(2e-3));
  CHECK(tolerated(test::gnss_loop()) == doctest::Approx(0.598).epsilon(3e-3));
  Loop backwards = test::third_order_loop();
  backwards.lowest = -0.21;
  backwards.highest = -0.19;
  CHECK(tolerated(backwards) == doctest::Approx(0.967).epsilon(2e-3));
}

TEST_CASE("a loop with a sine is never beyond its bound") {
  const Loop loop = test::output_loop();
  const GainNetwork network = loop.network();
  const GainBounds bounds(network, 2048, 32);
  const double noise = 0.5;
  const auto errors = bounds.errors(Ball(noise), zero, std::vector<Ball>(3));
  REQUIRE(errors.has_value());
  std::mt19937 random(5);
  double most = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    const auto length = 1U + random() % 60U;
    double phase = 0.0;
    double frequency = 0.0;
    double push = noise;
    for (unsigned k = 0; k < 3000; ++k) {
      push = k % length == 0 ? -push : push;
      const double d = push - std::sin(phase);
      frequency += 0.001 * d;
      const double out = frequency + 0.05 * d;
      phase += out;
      most = std::max(most, std::abs(out));
    }
  }
  CHECK(most <= errors->for_ever().upper_double());
  CHECK(most >= 0.5 * errors->for_ever().near());
}

TEST_CASE("a start far off in a loop with a sine is followed, block by block") {
  const GainNetwork network = test::output_loop().network();
  for (const auto& [horizon, blocks] :
       std::vector<std::pair<std::size_t, std::size_t>>{{2048, 256}, {128, 16}}) {
    const GainBounds bounds(network, horizon, blocks);
    REQUIRE(bounds.is_certain());
    const auto errors = bounds.errors(zero, zero, {Ball(1.0), zero, zero});
    REQUIRE(errors.has_value());
    double phase = -1.0;
    double frequency = 0.0;
    double out = 0.0;
    for (int k = 0; k < 3000; ++k) {
      const double bound = errors->from(Ball(k)).upper_double();
      if (!(std::abs(out) <= bound)) {
        REQUIRE(std::abs(out) <= bound);
      }
      const double d = -std::sin(phase);
      frequency += 0.001 * d;
      out = frequency + 0.05 * d;
      phase += out;
    }
  }
}

TEST_CASE("a short horizon gives larger bounds, which are true as well") {
  const GainNetwork network = test::motor_loop().network();
  std::vector<double> response;
  Errors after;
  after.step(1e-3);
  for (int k = 0; k < 16000; ++k) {
    response.push_back(after.frequency / 1e-3);
    after.step(0.0);
  }
  Errors attacked;
  for (std::size_t k = response.size(); k-- > 0;) {
    attacked.step(response[k] > 0.0 ? std::asin(0.1) : -std::asin(0.1));
  }
  for (const std::size_t horizon : {1024U, 2048U, 4096U}) {
    const GainBounds bounds(network, horizon, 32);
    REQUIRE(bounds.is_certain());
    const auto noisy = bounds.errors(Ball(0.1), zero, kSteady);
    REQUIRE(noisy.has_value());
    CHECK(attacked.frequency <= noisy->for_ever().upper_double());
    const auto started = bounds.errors(zero, zero, {Ball(0.1), Ball(10.0)});
    REQUIRE(started.has_value());
    Errors x{-0.1, 10.0 / 12500};
    for (int k = 0; k < 9000; ++k) {
      const double bound = started->from(Ball(k)).upper_double();
      if (!(std::abs(x.frequency) <= bound)) {
        REQUIRE(std::abs(x.frequency) <= bound);
      }
      x.step(0.0);
    }
  }
}

TEST_CASE("of a loop that multiplies two samples, noise that both have in common cancels") {
  const std::vector<Ball> still(3);
  Loop loop = test::product_loop();
  const auto long_run = [&](bool has_one_noise) {
    loop.has_one_noise = has_one_noise;
    const GainNetwork network = loop.network();
    const GainBounds bounds(network, 4096, 64);
    REQUIRE(bounds.is_certain());
    const auto errors = bounds.errors(Ball(0.01), zero, still);
    REQUIRE(errors.has_value());
    return errors->in_long_run().upper_double();
  };
  // To first order the noise of a sample comes in with the gain 0.02, and from the next one on with 0.02
  // times the pole 0.98 less 1: twice 0.02 in all. The products of noise with noise add up to its square.
  const double linear = 2.0 * 0.02 * 0.01;
  CHECK(long_run(true) >= linear);
  CHECK(long_run(true) >= 0.01 * 0.01);
  CHECK(long_run(true) <= linear + 5.0 * 0.01 * 0.01);
  CHECK(long_run(false) >= 2.0 * 0.01);
}

TEST_CASE("too short a horizon and a loop that is not stable are refused") {
  const GainNetwork network = test::motor_loop().network();
  CHECK_FALSE(GainBounds(network, 16, 4).is_certain());
  CHECK_FALSE(GainBounds(network, 4096, 3).is_certain());
  CHECK_FALSE(GainBounds(network, 4096, 0).is_certain());
  Loop unstable = test::motor_loop();
  unstable.parameters = {{"dt", "1/12500"}, {"kp", "2.1*12500"}, {"ki", "30000"}};
  const GainNetwork growing = unstable.network();
  for (const std::size_t horizon : {64U, 4096U, 65536U}) {
    const GainBounds bounds(growing, horizon, 64);
    CHECK_FALSE(bounds.is_certain());
    CHECK_FALSE(bounds.errors(zero, zero, kSteady).has_value());
  }
}

TEST_CASE("a wrong steady state has a residual, and a bias that is not small") {
  Loop wrong = test::motor_loop();
  wrong.steady[1].per_frequency = Ball(12400.0);
  const GainNetwork network = wrong.network();
  const GainBounds bounds(network, 4096, 64);
  CHECK_FALSE(certainly_at_most(abs(network.bias), Ball(1e-3)));
  const auto errors = bounds.errors(zero, zero, kSteady);
  CHECK((!errors || errors->for_ever().upper_double() > 1e-3));
}

}  // namespace
}  // namespace veritrack::checker
