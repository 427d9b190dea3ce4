// Remainders of products and functions, against the largest values on fine grids.
#include <doctest/doctest.h>

#include <cmath>

#include "analysis/model/gain/frame_value.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/function_remainder.hpp"

namespace veritrack::model {

TEST_CASE("remainders of functions are as large as what they stand for") {
  const rigor::UpwardRounding upward;
  test::check_remainder([](const auto& x) { return exp(x); }, [](double x) { return std::exp(x); },
                        [](double x) { return std::exp(x); });
  test::check_remainder([](const auto& x) { return log(x); }, [](double x) { return std::log(x); },
                        [](double x) { return 1.0 / x; });
  test::check_remainder([](const auto& x) { return sqrt(x); }, [](double x) { return std::sqrt(x); },
                        [](double x) { return 0.5 / std::sqrt(x); });
  test::check_remainder([](const auto& x) { return FrameValue(1) / x; }, [](double x) { return 1.0 / x; },
                        [](double x) { return -1.0 / (x * x); });
  test::check_remainder([](const auto& x) { return asin(x); }, [](double x) { return std::asin(x); },
                        [](double x) { return 1.0 / std::sqrt(1.0 - x * x); });
  test::check_remainder([](const auto& x) { return acos(x); }, [](double x) { return std::acos(x); },
                        [](double x) { return -1.0 / std::sqrt(1.0 - x * x); });
  test::check_remainder([](const auto& x) { return x * x; }, [](double x) { return x * x; },
                        [](double x) { return 2.0 * x; });
}

}  // namespace veritrack::model
