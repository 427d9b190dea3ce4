#include "analysis/kkl_observer/kernel_norm.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace veritrack::kkl_observer {
namespace {

using rigor::Interval;

/// The integral of |sum c exp(-lambda t)| by the midpoint rule.
double integral(const std::array<double, 4>& lambda, const std::array<double, 4>& c) {
  constexpr int kSteps = 200000;
  const double end = 40.0 / lambda[0];
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const double t = end * (k + 0.5) / kSteps;
    double kernel = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      kernel += c[i] * std::exp(-lambda[i] * t);
    }
    sum += std::fabs(kernel) * end / kSteps;
  }
  return sum;
}

TEST_CASE("the norm is bounded from above, and not by much") {
  test::Random random(31);
  for (std::int64_t trial = 0; trial < test::effort(20); ++trial) {
    CAPTURE(trial);
    std::array<double, 4> lambda{};
    std::array<double, 4> c{};
    KernelNorm<>::Coefficients rates;
    KernelNorm<>::Coefficients coefficients;
    double rate = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      rate += random.uniform(0.3, 2.0);
      lambda[i] = rate;
      c[i] = random.uniform(-2.0, 2.0);
      rates[i] = Interval(rate);
      coefficients[i] = Interval(c[i]);
    }
    const double expected = integral(lambda, c);
    const rigor::UpwardRounding upward;
    const Interval bound = KernelNorm<>(rates, 120).upper_bound(coefficients);
    CHECK(bound.upper() >= expected * (1.0 - 1e-6));
    CHECK(bound.upper() <= expected * 1.1 + 1e-3);
  }
}

TEST_CASE("one filter alone: 1 / lambda; and nothing finite from an unknown coefficient") {
  const rigor::UpwardRounding upward;
  const KernelNorm<> norm({Interval(0.5), Interval(1.0), Interval(2.0), Interval(4.0)}, 60);
  const Interval zero(0.0);
  CHECK(norm.upper_bound({Interval(1.0), zero, zero, zero}).upper() == doctest::Approx(2.0).epsilon(1e-6));
  CHECK_FALSE(rigor::is_finite(norm.upper_bound({Interval::entire(), zero, zero, zero})));
  CHECK_FALSE(rigor::is_finite(norm.upper_bound({Interval(), zero, zero, zero})));
}

}  // namespace
}  // namespace veritrack::kkl_observer
