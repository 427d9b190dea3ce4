#include "analysis/rigor/rounded_functions.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tests/analysis/rigor/operands.hpp"

using namespace veritrack;
using namespace veritrack::test;
using rigor::Interval;
using rigor::Rounded;

namespace {

/// Within a relative 2^-`bits`, at the end of what the bound allows.
struct Erring {
  double exact, computed;
  [[nodiscard]] Rounded rounded() const {
    return {Interval(exact), std::max(rigor::sub_up(computed, exact), rigor::sub_up(exact, computed))};
  }
};

Erring erring(Random& random, double low, double high, int bits) {
  const double exact = random.uniform(low, high);
  return {exact, exact * (1.0 + random.uniform(-1.0, 1.0) * std::ldexp(1.0, -bits))};
}

}  // namespace

TEST_CASE("root and exponential: the computed result is within the bound, which is nearly reached") {
  for (const int bits : {1000, 48, 20, 3}) {
    CAPTURE(bits);
    Random random(7200);
    std::array<double, 2> largest{};
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
      const Erring x = erring(random, 0.01, 3.0, bits);
      const auto [root, power] = upward([&] { return std::array{sqrt(x.rounded()), exp(x.rounded())}; });
      const auto ratio = [](long double exact, double computed, const Rounded& bound) {
        return static_cast<double>(std::fabs(static_cast<long double>(computed) - exact)) / bound.error();
      };
      largest[0] = std::max(largest[0],
                            ratio(std::sqrt(static_cast<long double>(x.exact)), std::sqrt(x.computed), root));
      largest[1] = std::max(largest[1],
                            ratio(std::exp(static_cast<long double>(x.exact)), std::exp(x.computed), power));
    }
    for (const double ratio : largest) {
      CHECK(ratio <= 1.0);
      CHECK(ratio >= (bits > 60 ? 0.2 : 0.7));  // common libraries are better than a unit
    }
  }
}

TEST_CASE("nothing is known of a root of what may be computed as negative, and of phases") {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto root_of = [&](double exact, double error) {
    return upward([&] { return sqrt(Rounded(Interval(exact), error)); }).error();
  };
  CHECK(root_of(1.0, 1.0) < infinity);
  CHECK(root_of(1.0, 1.5) == infinity);
  CHECK(root_of(0.0, 1e-300) == infinity);
  CHECK(root_of(0.0, 0.0) < 1e-100);
  CHECK(root_of(std::numeric_limits<double>::quiet_NaN(), 0.0) == infinity);
  CHECK(root_of(1.0, infinity) == infinity);
  CHECK(upward([] { return atan2(Rounded(1.0), Rounded(1.0)); }).error() == infinity);
  CHECK(upward([] { return Rounded(); }).error() == infinity);
  CHECK(upward([&] { return exp(Rounded(Interval(1.0), infinity)); }).error() == infinity);
  CHECK(upward([] { return exp(Rounded(500.0)); }).error() == infinity);
}

TEST_CASE("the larger of two is one of them where that is certain, and within both errors where not") {
  const auto larger = [](double a, double a_error, double b, double b_error) {
    return upward([&] { return max(Rounded(Interval(a), a_error), Rounded(Interval(b), b_error)); });
  };
  const Rounded zero = larger(-1.0, 0.5, 0.0, 0.0);
  CHECK(zero.error() == 0.0);
  CHECK(rigor::identical(zero.exact(), Interval(0.0)));
  CHECK(larger(0.0, 0.0, -1.0, 0.5).error() == 0.0);
  // -1 may be computed as 0.5: then it is the larger.
  CHECK(larger(-1.0, 1.5, 0.0, 0.0).error() >= 0.5);
  CHECK(larger(2.0, 1e-3, 2.0, 1e-2).error() >= 1e-2);
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(larger(-1.0, infinity, 0.0, 0.0).error() == infinity);
  CHECK(larger(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0, 0.0).error() == infinity);
}

TEST_CASE("sums in place are sums") {
  Rounded sum(1.0);
  upward([&] {
    sum += Rounded(Interval(2.0), 1e-3);
    sum -= Rounded(Interval(0.5), 1e-3);
    return 0;
  });
  CHECK(rigor::contains(sum.exact(), 2.5));
  CHECK(sum.error() >= 2e-3);
  CHECK(sum.error() < 2.001e-3);
}
