#include "analysis/model/gain/gain_bounds.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "analysis/model/gain/frame_value.hpp"
#include "analysis/model/gain/gain_attack.hpp"
#include "analysis/model/gain/steady_proposal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/gain_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;
using test::Detector;

const Interval kBand = Interval::from_bounds(-1.0, 1.0);

/// The loop with its bounds.
struct Bounded {
  test::TwoChannelExample loop;
  std::vector<SteadyValue> steady;
  GainBounds gains;

  Bounded(double kp, double ki, Detector detector)
      : loop(test::two_channel_loop(kp, ki, detector)), steady(proposed(loop)), gains(made(loop, steady)) {}

  static std::vector<SteadyValue> proposed(const test::TwoChannelExample& loop) {
    const rigor::UpwardRounding upward;
    return proposed_steady_state(loop.model, loop.tone.start, -1.0, 1.0).value();
  }
  static GainBounds made(const test::TwoChannelExample& loop, const std::vector<SteadyValue>& steady) {
    const rigor::UpwardRounding upward;
    return GainBounds::make(loop_network(loop.model, steady, kBand), 4096, 64).value();
  }
};

TEST_CASE("the steady state and the matrix of a loop are those on paper") {
  const rigor::UpwardRounding upward;
  const Bounded made(0.2, 0.01, Detector::arctangent2);
  CHECK(made.steady[0].turns == 1);
  CHECK(made.steady[0].constant == 0.0);
  CHECK(made.steady[0].per_frequency == 1.0);
  CHECK(made.steady[1].per_frequency == 1.0);
  const std::vector<linear::Row>& a = made.gains.network().a;
  CHECK(a[0][0].lower() <= 0.8);
  CHECK(a[0][0].upper() >= 0.8);
  CHECK(a[0][1] == Interval(1.0));
  CHECK(a[1][0] == Interval(-0.01));
  CHECK(a[1][1] == Interval(1.0));
  CHECK(rigor::magnitude(made.gains.network().bias) == 0.0);
  REQUIRE(made.gains.network().frequency_state.has_value());
  CHECK(made.gains.network().frequency_state->first == 1);
}

TEST_CASE("noise that is tolerated: the gain to the phase, in long double, and the limit of the detector") {
  const rigor::UpwardRounding upward;
  const Bounded made(0.2, 0.01, Detector::arctangent2);
  // e = noise angle - error of the phase: |c A^k b| for the phase, plus the noise of the same sample.
  long double theta = 0.2L;
  long double w = 0.01L;
  long double gain = 1.0L;
  for (int k = 0; k < 100000; ++k) {
    gain += std::fabs(theta);
    const long double next = 0.8L * theta + w;
    w += -0.01L * theta;
    theta = next;
  }
  const auto noise_at = [&](long double angle) { return static_cast<double>(std::sin(angle)); };
  const long double limit = std::numbers::pi_v<long double> / gain;
  if (limit < 1.5L) {
    CHECK(made.gains.bounds({noise_at(limit * 0.999L), 0.0, {}}).has_value());
    CHECK_FALSE(made.gains.bounds({noise_at(limit * 1.001L), 0.0, {}}).has_value());
  }
  CHECK_FALSE(made.gains.bounds({1.0, 0.0, {}}).has_value());
  CHECK_FALSE(made.gains.bounds({NAN, 0.0, {}}).has_value());
  CHECK_FALSE(made.gains.bounds({INFINITY, 0.0, {}}).has_value());
}

TEST_CASE("no bound closes after the deadline") {
  const rigor::UpwardRounding upward;
  const Bounded made(0.2, 0.01, Detector::sine);
  CHECK(made.gains.bounds({0.1, 0.0, {}}));
  CHECK(made.gains.bounds({0.1, 0.0, {}}, search::Deadline(1000.0)));
  CHECK_FALSE(made.gains.bounds({0.1, 0.0, {}}, search::Deadline(0.0)));
}

TEST_CASE("no attack passes a bound, and it comes near where the loop is nearly linear") {
  for (const Detector detector :
       {Detector::arctangent2, Detector::arctangent, Detector::sine, Detector::normalised}) {
    const Bounded made(0.1, 0.004, detector);
    for (const double noise : {0.02, 0.2}) {
      for (const double slew : {0.0, 1e-5}) {
        const rigor::UpwardRounding upward;
        const auto bounds = made.gains.bounds({noise, slew, {}});
        REQUIRE(bounds.has_value());
        for (const double omega : {-0.7, 0.0, 0.3}) {
          const double reached = attack_loop(made.loop.tone, made.steady, omega, noise, slew, 4096);
          CHECK(reached <= bounds->for_ever * (1.0 + 1e-11));  // it is reached, and a run in doubles rounds
          CHECK(reached >= 0.8 * bounds->long_run);
        }
        CHECK(bounds->long_run <= bounds->for_ever);
        CHECK(made.gains.linear_error(noise, slew) <= bounds->long_run * (1.0 + 1e-9));
        const ErrorBudget& budget = bounds->budget;
        CHECK(budget.noise + budget.slew + budget.remainders + budget.steady_state >=
              bounds->long_run * (1 - 1e-9));
      }
    }
  }
}

TEST_CASE("runs from random starts with random noise stay within the bounds of every block") {
  const Bounded made(0.1, 0.004, Detector::sine);
  const std::vector<double> start{0.4, 0.01};
  const double noise = 0.1;
  std::optional<LoopBounds> bounds;
  {
    const rigor::UpwardRounding upward;
    bounds = made.gains.bounds({noise, 0.0, start});
  }
  REQUIRE(bounds.has_value());
  test::Random random(37005);
  for (std::int64_t run = 0; run < test::effort(200); ++run) {
    const double omega = random.uniform(-1.0, 1.0);
    double phase = random.uniform(0.0, 6.0);
    Eigen::Vector2d state(phase + omega + (random.below(2) == 0 ? 0.4 : -0.4),
                          omega + (random.below(2) == 0 ? 0.01 : -0.01));
    for (int k = 0; k < 4096; ++k) {
      CHECK(std::fabs(state(1) - omega) <= bounds->from_block[static_cast<std::size_t>(k / 64)]);
      phase += omega;
      const std::complex<double> sample =
          std::polar(1.0, phase) + std::polar(noise, random.uniform(0.0, 7.0));
      state = made.loop.tone.step.next(state, Eigen::Vector2d(sample.real(), sample.imag()));
    }
  }
  CHECK(bounds->from_block.front() == bounds->for_ever);
  CHECK(bounds->from_block.back() < 0.7 * bounds->for_ever);
}

TEST_CASE("a clamp that does not act costs nothing, and one that acts is a remainder that no run passes") {
  const double kp = 0.1;
  const Bounded made(kp, 0.004, Detector::knee);
  const Bounded linear(kp, 0.004, Detector::arctangent2);
  const auto bounds_at = [](const Bounded& loop, double noise, const std::vector<double>& start) {
    const rigor::UpwardRounding upward;
    return loop.gains.bounds({noise, 0.0, start});
  };
  const auto idle = bounds_at(made, 0.02, {});
  REQUIRE(idle.has_value());
  CHECK(idle->for_ever == doctest::Approx(bounds_at(linear, 0.02, {})->for_ever).epsilon(1e-12));
  const auto with = [&](double noise) { return bounds_at(made, noise, {}); };
  double acting = 0.03;
  while (with(acting * 1.02)) {
    acting *= 1.02;
  }
  // The noise alone passes the limit, and some more is tolerated.
  CHECK(acting > 0.05);
  CHECK(with(acting)->for_ever > 1.01 * bounds_at(linear, acting, {})->for_ever);
  MESSAGE("certified up to noise " << acting);
  for (const double noise : {0.5 * acting, acting}) {
    for (const double omega : {-0.7, 0.0, 0.3}) {
      CHECK(attack_loop(made.loop.tone, made.steady, omega, noise, 0.0, 4096) <=
            with(noise)->for_ever * (1.0 + 1e-11));
    }
  }
  const std::vector<double> start{0.04, 0.0005};
  const double noise = 0.6 * acting;
  const auto bounds = bounds_at(made, noise, start);
  REQUIRE(bounds.has_value());
  test::Random random(37006);
  for (std::int64_t run = 0; run < test::effort(100); ++run) {
    const double omega = random.uniform(-1.0, 1.0);
    double phase = random.uniform(0.0, 6.0);
    Eigen::Vector2d state(phase + omega + (random.below(2) == 0 ? 0.04 : -0.04),
                          omega + (random.below(2) == 0 ? 0.0005 : -0.0005));
    const double side = random.below(2) == 0 ? 1.0 : -1.0;
    for (int k = 0; k < 4096; ++k) {
      CHECK(std::fabs(state(1) - omega) <=
            bounds->from_block[static_cast<std::size_t>(k / 64)] * (1.0 + 1e-11));
      phase += omega;
      // Noise across the signal, mostly to one side.
      const double across = random.below(8) == 0 ? -side : side;
      const std::complex<double> sample = std::polar(1.0, phase) * std::complex<double>(1.0, across * noise);
      state = made.loop.tone.step.next(state, Eigen::Vector2d(sample.real(), sample.imag()));
    }
  }
}

TEST_CASE("a detector of signs is linear while none of them changes, and at rest an eighth of a turn away") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(0.1, 0.004, Detector::four_quarters));
  const StartState eighth = [](double omega) {
    return std::vector<double>{omega - std::numbers::pi / 4.0, omega};
  };
  const std::vector<SteadyValue> steady = proposed_steady_state(loop.model, eighth, -1.0, 1.0).value();
  CHECK(steady[0].constant == doctest::Approx(-std::numbers::pi / 4.0));
  const GainBounds gains = GainBounds::make(loop_network(loop.model, steady, kBand), 4096, 64).value();
  const auto bounds = gains.bounds({0.1, 0.0, {}});
  REQUIRE(bounds.has_value());
  CHECK_FALSE(gains.bounds({0.71, 0.0, {}}).has_value());  // noise alone changes a sign
  for (const double omega : {-0.7, 0.0, 0.3}) {
    const double reached = attack_loop(loop.tone, steady, omega, 0.1, 0.0, 4096);
    CHECK(reached <= bounds->for_ever * (1.0 + 1e-11));
    CHECK(reached >= 0.6 * bounds->long_run);
  }
  CHECK_THROWS_AS((void)loop_network(loop.model, {{1, 0.0, 1.0}, {0, 0.0, 1.0}}, kBand), NoFrame);
}

/// The largest frequency error of product_of_samples at samples (1 + n_k) e^(i k omega), in doubles.
template <typename Noise>
double largest_error_of_products(double gain, double omega, std::size_t samples, const Noise& noise) {
  double w = omega;
  double largest = 0.0;
  std::complex<double> last(1.0, 0.0);
  for (std::size_t k = 1; k <= samples; ++k) {
    const std::complex<double> sample =
        (1.0 + noise(k)) *
        std::polar(1.0, std::remainder(static_cast<double>(k) * omega, 2.0 * std::numbers::pi));
    w += gain * std::imag(sample * std::conj(last) * std::polar(1.0, -w));
    last = sample;
    largest = std::max(largest, std::fabs(w - omega));
  }
  return largest;
}

TEST_CASE("noise that two samples have in common is counted once: no attack on a product of samples passes") {
  constexpr double kGain = 0.02, kNoise = 0.01;
  const test::TwoChannelExample loop(test::product_of_samples(kGain));
  const std::vector<SteadyValue> steady{{1, 0.0, 0.0, 1}, {0, 1.0, 0.0}, {0, 0.0, 1.0}};
  std::optional<LoopBounds> one;
  std::optional<LoopBounds> each;
  {
    const rigor::UpwardRounding upward;
    const auto bounds = [&](bool shares_noise) {
      return GainBounds::make(loop_network(loop.model, steady, kBand, shares_noise), 4096, 64)
          .value()
          .bounds({kNoise, 0.0, {}});
    };
    one = bounds(true);
    each = bounds(false);
  }
  REQUIRE(one.has_value());
  REQUIRE(each.has_value());
  CHECK(one->long_run < 0.05 * each->long_run);
  double reached = 0.0;
  for (const double omega : {-0.9, 0.2, 0.5}) {
    reached = std::max(reached, attack_loop(loop.tone, steady, omega, kNoise, 0.0, 4096));
    // Noise that turns: then the products of noise with noise add up.
    for (int i = 0; i <= 64; ++i) {
      const double turn = std::numbers::pi * i / 32.0;
      reached = std::max(reached, largest_error_of_products(kGain, omega, 2000, [&](std::size_t k) {
                           return std::polar(
                               kNoise, std::remainder(turn * static_cast<double>(k), 2.0 * std::numbers::pi));
                         }));
    }
  }
  test::Random random(5231);
  for (std::int64_t trial = 0; trial < test::effort(100); ++trial) {
    reached = std::max(reached, largest_error_of_products(kGain, 0.3, 500, [&](std::size_t) {
                         return std::polar(kNoise, random.uniform(-4.0, 4.0));
                       }));
  }
  CHECK(reached <= one->for_ever * (1.0 + 1e-11));
  CHECK(reached >= 0.5 * one->long_run);
}

TEST_CASE("a wrong steady state makes bounds longer by what it is wrong, or none") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(0.1, 0.004, Detector::sine));
  std::vector<SteadyValue> steady = proposed_steady_state(loop.model, loop.tone.start, -1.0, 1.0).value();
  steady[1].constant += 1e-3;
  const GainBounds off = GainBounds::make(loop_network(loop.model, steady, kBand), 4096, 64).value();
  const auto bounds = off.bounds({});
  REQUIRE(bounds.has_value());
  CHECK(bounds->for_ever > 1e-3);
  steady[0].turns = 2;
  CHECK_THROWS_AS((void)loop_network(loop.model, steady, kBand), NoFrame);
}

/// theta' = theta + w + kp e, w' = w + ki e with e = -2 y sin(theta + w): one channel. States theta, w.
test::ExampleTracker one_channel_loop(double bandwidth) {
  test::ExampleTracker example;
  trackers::Recursion& r = example.recursion;
  r.constants = 3;
  r.states = 2;
  r.samples = 1;
  r.is_angle = {true, false};
  trackers::StraightLineProgram step(6);
  const int kp = 0, ki = 1, minus_two = 2, theta = 3, w = 4, y = 5;
  const auto product = [&](int a, int b) { return step.append(trackers::Operation::multiply, a, b); };
  const auto sum = [&](int a, int b) { return step.append(trackers::Operation::add, a, b); };
  const int ahead = sum(theta, w);
  const int e = product(product(minus_two, y), step.append(trackers::Operation::sin, ahead));
  step.add_result(sum(ahead, product(kp, e)));
  step.add_result(sum(w, product(ki, e)));
  r.step = step;
  r.frequency = test::frequency_of_state(3, 2, 1);
  example.constants = {2.0 * 0.7071 * bandwidth, bandwidth * bandwidth, -2.0};
  example.start = [](double omega) { return std::vector<double>{0.0, omega}; };
  return example;
}

TEST_CASE("one channel: what turns with the signal is known, and no attack passes a bound") {
  for (const double bandwidth : {0.02, 0.001}) {
    const test::Example loop(one_channel_loop(bandwidth));
    const Interval band = Interval::from_bounds(0.2, 0.5);
    std::optional<GainBounds> gains;
    std::optional<LoopBounds> bounds;
    const double noise = 0.03;
    {
      const rigor::UpwardRounding upward;
      const auto steady = proposed_steady_state(loop.model, loop.tracker.start, 0.2, 0.5);
      REQUIRE(steady.has_value());
      LoopNetwork network = loop_network(loop.model, *steady, band);
      CHECK(network.has_ripples);
      const auto samples = linear::proposed_horizon(network.a, 64, 1e-8, 1U << 20U);
      gains = GainBounds::make(std::move(network), samples.value(), 64);
      REQUIRE(gains.has_value());
      bounds = gains->bounds({noise, 0.0, {}});
      CHECK_FALSE(gains->bounds({noise, 1e-9, {}}).has_value());
      CHECK(gains->bounds({bandwidth > 0.01 ? 0.1 : 0.25, 0.0, {}}).has_value());
      CHECK_FALSE(gains->bounds({0.5, 0.0, {}}).has_value());
    }
    REQUIRE(bounds.has_value());
    const std::vector<SteadyValue> steady{{1, 0.0, 0.0}, {0, 0.0, 1.0}};
    for (const double omega : {0.2, 0.37, 0.5}) {
      const double reached =
          attack_loop(test::tone_of(loop.tracker), steady, omega, noise, 0.0, 4 * gains->samples());
      CHECK(reached <= bounds->for_ever);
      CHECK(reached >= (bandwidth > 0.01 ? 0.1 : 0.5) * bounds->long_run);
    }
    // Without noise only what turns with the signal is left.
    const rigor::UpwardRounding upward;
    const auto quiet = gains->bounds({});
    REQUIRE(quiet.has_value());
    CHECK(quiet->long_run >= gains->network().ripple.back());
  }
}

TEST_CASE("one channel with an amplitude that varies, or a step that depends on the phase, has no network") {
  const rigor::UpwardRounding upward;
  test::Example loop(one_channel_loop(0.02));
  loop.model.amplitude = Interval::from_bounds(0.9, 1.1);
  loop.model.amplitude_varies = true;
  CHECK_THROWS_AS(
      (void)loop_network(loop.model, {{1, 0.0, 0.0}, {0, 0.0, 1.0}}, Interval::from_bounds(0.2, 0.5)),
      NoFrame);
}

}  // namespace
}  // namespace veritrack::model
