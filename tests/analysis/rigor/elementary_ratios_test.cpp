#include "analysis/rigor/elementary_ratios.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/random.hpp"

namespace veritrack::rigor {
namespace {

using rigor::Interval;

long double sine_over(long double x) {
  return x == 0.0L ? 1.0L : std::sin(x) / x;
}
long double arctangent_over(long double t) {
  return t == 0.0L ? 1.0L : std::atan(t) / t;
}
long double cosine_over(long double x) {
  return 0.5L * sine_over(0.5L * x) * sine_over(0.5L * x);
}

TEST_CASE("the ratios over intervals hold those of long double, and are narrow over points") {
  test::Random random(61);
  for (std::int64_t k = 0; k < test::effort(20000); ++k) {
    const double scale = std::pow(10.0, random.uniform(-9.0, 0.0));
    const double a = 2.9 * scale * random.uniform(-1.0, 1.0);
    const double b = k % 2 == 0 ? a : 2.9 * scale * random.uniform(-1.0, 1.0);
    const double low = std::min(a, b);
    const double high = std::max(a, b);
    const double inside = low + (high - low) * random.uniform();
    const long double s = sine_over(inside);
    const long double t = arctangent_over(inside);
    const long double c = cosine_over(inside);
    const rigor::UpwardRounding upward;
    const Interval x = Interval::from_bounds(low, high);
    const Interval sine = sine_ratio(x);
    const Interval tangent = arctangent_ratio(x);
    const Interval cosine = cosine_ratio(x);
    constexpr long double kRounding = 1e-18L;
    CHECK(static_cast<long double>(sine.lower()) <= s + kRounding);
    CHECK(static_cast<long double>(sine.upper()) >= s - kRounding);
    CHECK(static_cast<long double>(tangent.lower()) <= t + kRounding);
    CHECK(static_cast<long double>(tangent.upper()) >= t - kRounding);
    CHECK(static_cast<long double>(cosine.lower()) <= c + kRounding);
    CHECK(static_cast<long double>(cosine.upper()) >= c - kRounding);
    if (low == high) {
      CHECK(width(sine) <= 1e-3);
      CHECK(width(tangent) <= 1e-4);
    }
  }
}

TEST_CASE("the slopes of the ratios hold those of long double, and are narrow over points") {
  // -s'(x)/x = int u^2 sin(xu)/(xu) du and -t'(x)/x = int 2 u^2/(1 + x^2 u^2)^2 du over [0, 1], by Simpson's
  // rule.
  const auto integral = [](const auto& f) {
    constexpr int kParts = 200;
    long double sum = 0.0L;
    for (int i = 0; i <= kParts; ++i) {
      const long double weight = i == 0 || i == kParts ? 1.0L : i % 2 == 0 ? 2.0L : 4.0L;
      sum += weight * f(static_cast<long double>(i) / kParts);
    }
    return sum / (3.0L * kParts);
  };
  test::Random random(63);
  for (int k = 0; k < 2000; ++k) {
    const double scale = std::pow(10.0, random.uniform(-6.0, 0.0));
    const double a = 2.9 * scale * random.uniform(-1.0, 1.0);
    const double b = k % 2 == 0 ? a : 2.9 * scale * random.uniform(-1.0, 1.0);
    const double low = std::min(a, b);
    const double high = std::max(a, b);
    const long double x = low + (high - low) * random.uniform();
    const long double s = integral([&](long double u) { return u * u * sine_over(x * u); });
    const long double t = integral(
        [&](long double u) { return 2.0L * u * u / ((1.0L + x * x * u * u) * (1.0L + x * x * u * u)); });
    const rigor::UpwardRounding upward;
    const Interval sine = sine_ratio_slope(Interval::from_bounds(low, high));
    const Interval tangent = arctangent_ratio_slope(Interval::from_bounds(low, high));
    constexpr long double kQuadrature = 1e-7L;
    CHECK(static_cast<long double>(sine.lower()) <= s + kQuadrature);
    CHECK(static_cast<long double>(sine.upper()) >= s - kQuadrature);
    CHECK(static_cast<long double>(tangent.lower()) <= t + kQuadrature);
    CHECK(static_cast<long double>(tangent.upper()) >= t - kQuadrature);
    if (low == high) {
      CHECK(width(sine) <= 1e-3);
      CHECK(width(tangent) <= 1e-4);
    }
  }
}

TEST_CASE("the ratios over doubles") {
  test::Random random(62);
  for (int k = 0; k < 10000; ++k) {
    const double x = std::pow(10.0, random.uniform(-9.0, 0.4)) * (random.below(2) == 0 ? 1.0 : -1.0);
    CHECK(std::fabs(static_cast<double>(sine_over(x)) - sine_ratio(x)) <= 1e-15);
    CHECK(std::fabs(static_cast<double>(arctangent_over(x)) - arctangent_ratio(x)) <= 1e-15);
    CHECK(std::fabs(static_cast<double>(cosine_over(x)) - cosine_ratio(x)) <= 1e-15);
  }
}

TEST_CASE("beyond their range, and of nothing, the ratios say nothing") {
  const rigor::UpwardRounding upward;
  CHECK(is_empty(sine_ratio(Interval(3.1))));
  CHECK(is_empty(sine_ratio(Interval::entire())));
  CHECK(is_empty(sine_ratio(Interval::empty())));
  CHECK(is_empty(sine_ratio_slope(Interval(3.1))));
  CHECK(is_empty(sine_ratio_slope(Interval::empty())));
  CHECK(is_empty(arctangent_ratio_slope(Interval::entire())));
  CHECK(is_empty(arctangent_ratio(Interval::empty())));
  CHECK(is_empty(arctangent_ratio(Interval::entire())));
}

}  // namespace
}  // namespace veritrack::rigor
