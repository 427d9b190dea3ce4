#include "analysis/model/steady_state/jet.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {
namespace {

/// Coefficients 0 to 3 against differences of the function along 0.3 + t slope.
template <typename Function>
void check_against_differences(const Function& function, double at, double slope) {
  const Jet<3> jet = function(Jet<3>(at, slope));
  const double h = 1e-3;
  const auto value = [&](int k) { return function(Jet<0>(at + k * h * slope)).at(0); };
  CHECK(jet.at(0) == doctest::Approx(value(0)).epsilon(1e-14));
  CHECK(jet.at(1) == doctest::Approx((value(1) - value(-1)) / (2.0 * h)).epsilon(1e-5));
  CHECK(jet.at(2) ==
        doctest::Approx((value(1) - 2.0 * value(0) + value(-1)) / (2.0 * h * h)).epsilon(1e-4).scale(1.0));
  CHECK(jet.at(3) ==
        doctest::Approx((value(2) - 2.0 * value(1) + 2.0 * value(-1) - value(-2)) / (12.0 * h * h * h))
            .epsilon(1e-3)
            .scale(1.0));
}

TEST_CASE("jets of the functions a tracker may use agree with differences") {
  const rigor::NearestRounding nearest;
  for (const double slope : {1.0, -0.6}) {
    check_against_differences([](const auto& x) { return sin(x) * exp(x); }, 0.3, slope);
    check_against_differences([](const auto& x) { return cos(x) / sqrt(x); }, 0.3, slope);
    check_against_differences([](const auto& x) { return tan(x) - log(x); }, 0.3, slope);
    check_against_differences([](const auto& x) { return asin(x) + square(x) * acos(x); }, 0.3, slope);
    check_against_differences([](const auto& x) { return atan(x) * x; }, 0.3, slope);
    check_against_differences([](const auto& x) { return atan2(sin(x), x - cos(x)); }, 0.3, slope);
    check_against_differences([](const auto& x) { return -stays_within(x, x, x) / (x + x * x); }, 0.3, slope);
  }
}

}  // namespace
}  // namespace veritrack::model
