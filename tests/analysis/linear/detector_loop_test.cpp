#include "analysis/linear/detector_loop.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace veritrack::linear {
namespace {

using rigor::Interval;
using rigor::Verdict;

/// theta' = theta + k (phase - theta): stable for k below 2, bandwidth pi k / (2 - k).
DetectorLoop first_order(double k) {
  return {{{Interval(1.0 - k)}}, {Interval(k)}, {Interval(1.0)}};
}

/// theta' = theta + w + kp e, w' = w + ki e, e = phase - theta.
DetectorLoop second_order(double kp, double ki) {
  return {{{Interval(1.0 - kp), Interval(1.0)}, {Interval(-ki), Interval(1.0)}},
          {Interval(kp), Interval(ki)},
          {Interval(1.0), Interval(0.0)}};
}

}  // namespace

TEST_CASE("the noise bandwidth is that of the closed form, and of the plain sum") {
  const rigor::UpwardRounding upward;
  for (const double k : {0.001, 0.1, 1.0, 1.9}) {
    const auto bandwidth = noise_bandwidth(first_order(k));
    REQUIRE(bandwidth);
    CHECK(rigor::midpoint(*bandwidth) == doctest::Approx(std::numbers::pi * k / (2.0 - k)).epsilon(1e-9));
  }
  test::Random random(37022);
  for (std::int64_t trial = 0; trial < test::effort(50); ++trial) {
    const double kp = random.uniform(0.05, 0.6);
    const double ki = random.uniform(0.001, 0.3) * kp;
    const auto bandwidth = noise_bandwidth(second_order(kp, ki));
    REQUIRE(bandwidth);
    double theta = kp, w = ki, sum = 0.0;
    for (int k = 0; k < 40000; ++k) {
      sum += theta * theta;
      const double next = (1.0 - kp) * theta + w;
      w -= ki * theta;
      theta = next;
    }
    CHECK(rigor::midpoint(*bandwidth) == doctest::Approx(std::numbers::pi * sum).epsilon(1e-8));
    CHECK(rigor::width(*bandwidth) < 1e-6 * rigor::midpoint(*bandwidth));
  }
  CHECK_FALSE(noise_bandwidth(first_order(2.1)));
  CHECK_FALSE(noise_bandwidth(first_order(NAN)));
}

TEST_CASE("the gain at which a loop becomes unstable is that of the closed form") {
  const rigor::UpwardRounding upward;
  CHECK(is_stable_up_to(first_order(0.1), Interval(19.9)) == Verdict::proved);
  CHECK(is_stable_up_to(first_order(0.1), Interval(20.1)) == Verdict::refuted);
  // Jury: f (2 kp - ki) < 4.
  const double kp = 0.3, ki = 0.02;
  const double most = 4.0 / (2.0 * kp - ki);
  CHECK(is_stable_up_to(second_order(kp, ki), Interval(0.999 * most)) == Verdict::proved);
  CHECK(is_stable_up_to(second_order(kp, ki), Interval(1.001 * most)) == Verdict::refuted);
  CHECK(is_stable_up_to(first_order(NAN), Interval(1.5)) == Verdict::undecided);
}

}  // namespace veritrack::linear
