// What rounding does to the levels and the covariance of a certified set, in the checker.
#include "checker/quadrature/certified_set.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "checker/quadrature/set_inequality.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using checker::Ball;

checker::Setting some_setting() {
  checker::Setting s;
  s.metric = {Ball(2.0), Ball(3.0), Ball(-1.0), Ball(4.0)};
  s.radius = Ball(1.0);
  s.rate = Ball(0.9);
  s.noise_gain = Ball(2.0);
  s.slew_gain = Ball(1.5);
  return s;
}

/// Certified for the design of Figure 3.5 without its leak.
checker::Setting certified_setting() {
  checker::Setting s;
  s.q1 = s.q2 = Ball(0.0023);
  s.r = Ball(0.05);
  s.metric = {Ball(0x1.79e9e30ace801p+2), Ball(0x1.94a22f42e4696p+2), Ball(-0x1.711f0bb8c3935p+3),
              Ball(0x1.d281e2e2e6438p+3)};
  s.radius = Ball(0x1.e7d82b2a2085p-4);
  s.lower = {Ball(0x1.2a0baf66ccacp-7), Ball(0x1.8a2616229de24p-6), Ball(0x1.d8f8dafc35a5p-8),
             Ball(0x1.e1ac4d4055eebp-8)};
  s.upper = {Ball(0x1.4def2c47448dp-7), Ball(0x1.a94ef80de99c1p-6), Ball(0x1.045f5aea85111p-7),
             Ball(0x1.00b6132b642cp-7)};
  s.noise = Ball(0x1.0624dd2f1a9fcp-10);
  s.largest_amplitude = Ball(0.021);
  s.largest_chi = Ball(0.032);
  return s;
}

}  // namespace

TEST_CASE("bounds and settling are those of the recursion with rounding") {
  test::Random random(7130);
  for (int k = 0; k < 200; ++k) {
    CAPTURE(k);
    const double rate = random.uniform(0.3, 0.99);
    const double rounding = random.uniform(0.0, 1e-3);
    checker::Setting s = some_setting();
    s.rate = Ball(rate);
    s.error_rounding = Ball(rounding);
    checker::Design design;
    design.noise = Ball(0.02);
    design.slew = Ball(0.01);
    const double pushed = std::pow(2.0 * 0.02, 2) + std::pow(1.5 * 0.01, 2);
    const auto step = [&](double level) {
      return std::sqrt(rate * rate * level * level + pushed) + rounding;
    };
    CHECK(std::fabs(checker::next_level(s, Ball(0.7), design.noise, design.slew).near() - step(0.7)) < 1e-12);
    const double ultimate = checker::ultimate_level(s, design).near();
    CHECK(std::fabs(step(ultimate) - ultimate) < 1e-12);
    // The first number of samples that it accepts is one after which the recursion has settled.
    const double wanted = random.uniform(1.05, 2.0) * ultimate;
    const double start = wanted * random.uniform(1.0, 5.0);
    double level = start;
    for (int samples = 0; samples < 3000; ++samples, level = step(level)) {
      if (checker::settled(s, design, Ball(start), Ball(wanted / 4.0), Ball(samples))) {
        CHECK(level <= wanted * (1.0 + 1e-9));
        break;
      }
      REQUIRE(samples < 2999);
    }
    CHECK_FALSE(checker::settled(s, design, Ball(start), Ball(0.99 * ultimate / 4.0), Ball(1e6)));
  }
}

TEST_CASE("without noise and slew rounding is left") {
  checker::Setting s = some_setting();
  s.error_rounding = Ball(1e-12);
  checker::Design design;
  CHECK(std::fabs(checker::ultimate_level(s, design).near() - 1e-11) < 1e-14);
}

TEST_CASE("the covariance bounds must have room for rounding") {
  checker::Setting s = certified_setting();
  s.covariance_rounding = Ball(1e-12);
  CHECK(checker::keeps_covariance(s));
  s.covariance_rounding = Ball(0.02);
  CHECK_FALSE(checker::keeps_covariance(s));
  s.covariance_rounding = Ball::everything();
  CHECK_FALSE(checker::keeps_covariance(s));
}
