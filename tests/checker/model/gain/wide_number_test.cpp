#include "checker/model/gain/wide_number.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tests/support/random.hpp"

namespace veritrack::checker {
namespace {

constexpr double kRounding = 0x1p-34;

TEST_CASE("a sum of products of wide numbers is as wide as the sums of products of points, and no wider") {
  test::Random random(91);
  for (std::int64_t i = 0; i < test::effort(2000); ++i) {
    CAPTURE(i);
    WideRow x;
    WideRow y;
    double low = 0.0;
    double high = 0.0;
    for (int j = 0; j < 4; ++j) {
      for (WideRow* row : {&x, &y}) {
        row->push_back({random.uniform(-1.0, 1.0), random.below(4) == 0 ? 0.0 : random.uniform(0.0, 0.7)});
      }
      const WideNumber& a = x.back();
      const WideNumber& b = y.back();
      const std::array products{
          (a.middle - a.radius) * (b.middle - b.radius), (a.middle - a.radius) * (b.middle + b.radius),
          (a.middle + a.radius) * (b.middle - b.radius), (a.middle + a.radius) * (b.middle + b.radius)};
      low += *std::min_element(products.begin(), products.end());
      high += *std::max_element(products.begin(), products.end());
    }
    const WideNumber sum = dot(x, y);
    CHECK(sum.middle - sum.radius <= low + 1e-14);
    CHECK(sum.middle + sum.radius >= high - 1e-14);
    // Where both factors may be 0 the lower end is not reached.
    bool is_tight = true;
    for (std::size_t j = 0; j < x.size(); ++j) {
      is_tight = is_tight && (x[j].radius < std::fabs(x[j].middle) || y[j].radius < std::fabs(y[j].middle));
    }
    if (is_tight) {
      CHECK(sum.middle - sum.radius >= low - kRounding);
      CHECK(sum.middle + sum.radius <= high + kRounding);
    }
  }
}

TEST_CASE("of exact numbers the middle of a sum of products is the plain sum, and the radius its rounding") {
  const WideNumber sum = dot({{0.1, 0.0}, {-0.3, 0.0}}, {{0.7, 0.0}, {0.9, 0.0}});
  CHECK(sum.middle == 0.1 * 0.7 + -0.3 * 0.9);
  CHECK(sum.radius > 0.0);
  CHECK(sum.radius < 1e-13);
}

TEST_CASE("a number that is not known leaves a sum that is not known") {
  for (const double odd : {HUGE_VAL, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_FALSE(std::isfinite(largest_size(dot({{1.0, odd}}, {{0.5, 0.1}}))));
    CHECK_FALSE(std::isfinite(largest_size(dot({{odd, 0.0}}, {{0.5, 0.1}}))));
    CHECK_FALSE(std::isfinite(largest_size(dot({{1.0, 0.2}}, {{0.5, odd}}))));
  }
}

}  // namespace
}  // namespace veritrack::checker
