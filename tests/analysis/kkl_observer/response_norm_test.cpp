#include "analysis/kkl_observer/response_norm.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace veritrack::kkl_observer {
namespace {

using rigor::Interval;

TEST_CASE("the largest response to sinusoids is bounded from above, and not by much") {
  test::Random random(321);
  for (std::int64_t trial = 0; trial < test::effort(50); ++trial) {
    CAPTURE(trial);
    ResponseNorm<5>::Coefficients rates;
    ResponseNorm<5>::Coefficients coefficients;
    double rate = 0.0;
    for (std::size_t i = 0; i < 5; ++i) {
      rates[i] = Interval(rate += random.uniform(0.3, 2.0));
      coefficients[i] = Interval(random.uniform(-2.0, 2.0));
    }
    const double lowest = std::pow(10.0, random.uniform(-1.0, 2.0));
    double expected = 0.0;
    for (int k = 0; k < 20'000; ++k) {
      const double frequency = lowest * std::exp(10.0 * k / 20'000.0);
      std::complex<double> sum = 0.0;
      for (std::size_t i = 0; i < 5; ++i) {
        sum += coefficients[i].lower() / std::complex<double>(rates[i].lower(), frequency);
      }
      expected = std::max(expected, std::abs(sum));
    }
    const rigor::UpwardRounding upward;
    const Interval bound = ResponseNorm<5>(rates, Interval(lowest)).upper_bound(coefficients);
    CHECK(bound.upper() >= expected * (1.0 - 1e-9));
    CHECK(bound.upper() <= expected * 1.05);
  }
}

TEST_CASE("one filter alone, at the lowest frequency; and nothing finite from an unknown coefficient") {
  const rigor::UpwardRounding upward;
  const ResponseNorm<4> norm({Interval(0.5), Interval(1.0), Interval(2.0), Interval(4.0)}, Interval(2.0));
  const Interval zero(0.0);
  CHECK(norm.upper_bound({zero, zero, Interval(1.0), zero}).upper() ==
        doctest::Approx(1.0 / std::sqrt(8.0)).epsilon(2e-3));
  CHECK_FALSE(rigor::is_finite(norm.upper_bound({Interval::entire(), zero, zero, zero})));
  CHECK_FALSE(rigor::is_finite(norm.upper_bound({Interval(), zero, zero, zero})));
}

}  // namespace
}  // namespace veritrack::kkl_observer
