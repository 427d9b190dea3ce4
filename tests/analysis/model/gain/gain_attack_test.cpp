// The attack against loops whose worst noise is known on paper: what it reaches is reached by a simulation of
// our own, and is nearly the sum of the impulse response.
#include "analysis/model/gain/gain_attack.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "tests/analysis/model/gain_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

const std::vector<SteadyValue> kAttackedState{{1, 0.0, 1.0}, {0, 0.0, 1.0}};

/// The errors of theta and w of e = noise angle - theta: theta' = theta + w + kp e, w' = w + ki e. Weights
/// of the inputs by their lag in w: sums of absolute values.
struct ImpulseSums {
  double of_angle = 0.0;  ///< of the angle of the noise
  double of_slew = 0.0;

  ImpulseSums(double kp, double ki, std::size_t samples) {
    double theta = kp, w = ki;              // after an angle of 1
    double slew_theta = -1.0, slew = -1.0;  // after a frequency that is 1 more from now on
    for (std::size_t k = 0; k < samples; ++k) {
      of_angle += std::fabs(w);
      of_slew += std::fabs(slew);
      const double e = -(theta);
      const double next_theta = theta + w + kp * e;
      w += ki * e;
      theta = next_theta;
      const double of_e = -slew_theta;
      const double next = slew_theta + slew + kp * of_e;
      slew += ki * of_e;
      slew_theta = next;
    }
  }
};

/// The largest frequency error that any noise of this size reaches in many runs, in plain numbers.
double random_attack(double kp, double ki, double omega, double noise, int samples) {
  test::Random random(801);
  double largest = 0.0;
  for (std::int64_t run = 0; run < test::effort(20); ++run) {
    double theta = omega, w = omega, phase = 0.0;
    double direction = 1.0;
    for (int k = 0; k < samples; ++k) {
      phase += omega;
      direction = random.below(20) == 0 ? -direction : direction;
      const std::complex<double> sample =
          std::polar(1.0, phase) * (1.0 + std::complex<double>(0.0, noise * direction));
      const double e = std::arg(sample * std::polar(1.0, -theta));
      theta += w + kp * e;
      w += ki * e;
      largest = std::max(largest, std::fabs(w - omega));
    }
  }
  return largest;
}

}  // namespace

TEST_CASE("an attack with noise reaches the sum of the impulse response, and no random noise reaches more") {
  for (const auto& [kp, ki] : {std::pair(0.1, 0.004), std::pair(0.3, 0.05), std::pair(0.5, 0.01)}) {
    const test::TwoChannelExample loop(test::two_channel_loop(kp, ki, test::Detector::arctangent2));
    const ImpulseSums sums(kp, ki, 400);
    for (const double noise : {0.001, 0.1, 0.5}) {
      for (const double omega : {-0.4, 0.0, 0.3}) {
        const double reached = attack_loop(loop.tone, kAttackedState, omega, noise, 0.0, 400);
        // The detector is an angle, linear until it wraps: the noise turns it by asin(noise) at most.
        const double most = sums.of_angle * std::asin(noise);
        CHECK(reached <= most * (1.0 + 1e-9));
        CHECK(reached >= 0.99 * most);
        CHECK(random_attack(kp, ki, omega, noise, 400) <= reached);
      }
    }
  }
}

TEST_CASE("an attack with a slew reaches the sum of the response to a moving frequency") {
  const double kp = 0.1, ki = 0.004;
  const test::TwoChannelExample loop(test::two_channel_loop(kp, ki, test::Detector::arctangent2));
  const ImpulseSums sums(kp, ki, 400);
  for (const double slew : {1e-6, 1e-4}) {
    const double reached = attack_loop(loop.tone, kAttackedState, 0.1, 0.0, slew, 400);
    CHECK(reached <= sums.of_slew * slew * (1.0 + 1e-6));
    CHECK(reached >= 0.99 * sums.of_slew * slew);
  }
}

TEST_CASE("without disturbances nothing is reached, and with one sample what one sample does") {
  const double kp = 0.1, ki = 0.004;
  const test::TwoChannelExample loop(test::two_channel_loop(kp, ki, test::Detector::arctangent2));
  CHECK(attack_loop(loop.tone, kAttackedState, 0.3, 0.0, 0.0, 1000) < 1e-12);
  CHECK(attack_loop(loop.tone, kAttackedState, 0.3, 0.2, 0.0, 1) ==
        doctest::Approx(ki * std::asin(0.2)).epsilon(1e-9));
  CHECK(attack_loop(loop.tone, kAttackedState, 0.3, 0.2, 0.0, 0) == 0.0);
}

}  // namespace veritrack::model
