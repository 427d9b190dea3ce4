#include "analysis/rigor/rounded.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/analysis/rigor/operands.hpp"

using namespace veritrack;
using namespace veritrack::test;
using rigor::Interval;
using rigor::Rounded;

namespace {

__extension__ using Quad = __float128;  // 113 bits: products of doubles are exact, the rest nearly

double absolute(Quad x) {
  return static_cast<double>(x < 0 ? -x : x);
}

/// An exact value that the program holds with an error, at the end of what the bound allows.
struct Operand {
  double exact, error, computed;
  [[nodiscard]] Rounded rounded() const { return {Interval(exact), error}; }
};

Operand operand(Random& random, bool erring) {
  const double exact = (random.below(2) == 0 ? 1.0 : -1.0) *
                       std::ldexp(random.uniform(1.0, 2.0), static_cast<int>(random.below(24)) - 12);
  const double computed =
      erring ? exact * (1.0 + std::ldexp(random.uniform(-1.0, 1.0), -8 - static_cast<int>(random.below(46))))
             : exact;
  // Rounded upward, and hence a bound.
  return {exact,
          upward([&] { return std::max(rigor::sub_up(computed, exact), rigor::sub_up(exact, computed)); }),
          computed};
}

struct Ratios {
  double largest = 0.0;
  void add(Quad exact, double computed, const Rounded& bound) {
    largest = std::max(largest, absolute(static_cast<Quad>(computed) - exact) / bound.error());
  }
};

}  // namespace

TEST_CASE("the computed result is within the bound, which is nearly reached, whatever the operands' errors") {
  // Which operands err: without each case, a bound could leave out that term unnoticed.
  for (const auto& [first, second] :
       {std::pair(false, false), std::pair(true, false), std::pair(false, true), std::pair(true, true)}) {
    Random random(7100);
    Ratios sum, difference, product, quotient, power;
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
      const Operand a = operand(random, first);
      const Operand b = operand(random, second);
      const auto [s, d, p, q, w] = upward([&] {
        const Rounded x = a.rounded();
        const Rounded y = b.rounded();
        return std::array<Rounded, 5>{x + y, x - y, x * y, x / y, square(x)};
      });
      sum.add(static_cast<Quad>(a.exact) + b.exact, a.computed + b.computed, s);
      difference.add(static_cast<Quad>(a.exact) - b.exact, a.computed - b.computed, d);
      product.add(static_cast<Quad>(a.exact) * b.exact, a.computed * b.computed, p);
      quotient.add(static_cast<Quad>(a.exact) / b.exact, a.computed / b.computed, q);
      power.add(static_cast<Quad>(a.exact) * a.exact, a.computed * a.computed, w);
      // Fused: one rounding fewer.
      const Rounded fused = upward([&] { return a.rounded() * b.rounded() + a.rounded(); });
      CHECK(absolute(static_cast<Quad>(std::fma(a.computed, b.computed, a.computed)) -
                     (static_cast<Quad>(a.exact) * b.exact + a.exact)) <= fused.error());
    }
    for (const Ratios& ratios : {sum, difference, product, quotient, power}) {
      CHECK(ratios.largest <= 1.0);
      CHECK(ratios.largest >= 0.9);
    }
  }
}

TEST_CASE("sine and cosine of the C library are within the bound") {
  Random random(7101);
  double largest = 0.0;
  for (std::int64_t i = 0; i < effort(20'000); ++i) {
    const double x = random.uniform(-20.0, 20.0);
    const double moved = x + random.uniform(0.0, 1e-15);
    const auto [sine, cosine] = upward([&] { return sin_cos(Rounded(Interval(x), moved - x)); });
    const long double exact = x;
    largest =
        std::max({largest, std::fabs(static_cast<double>(std::sin(exact) - std::sin(moved))) / sine.error(),
                  std::fabs(static_cast<double>(std::cos(exact) - std::cos(moved))) / cosine.error()});
  }
  CHECK(largest <= 1.0);
  CHECK(largest >= 0.5);
}

TEST_CASE("below the normal range a product errs by less than the underflow term, in any admitted unit") {
  const Rounded tiny = upward([] { return Rounded(0x1p-500) * Rounded(0x1.8p-574); });
  CHECK(tiny.error() >= 0x1p-1074);
  // The same computation in a unit of length of 2^60, of quantities that scale like its 8th power.
  CHECK(tiny.error() >= 0x1p-595);
}

TEST_CASE("what is rounded is the result of the computed operands, also where the exact ones are zero") {
  const Rounded zero(Interval(0.0), 1.0);
  CHECK(upward([&] { return zero + zero; }).error() >= 2.0 + 0x1p-52);
}

TEST_CASE("where the error is unbounded, it is infinite, and stays so") {
  const auto [by_zero, too_large, unknown, later] = upward([] {
    const Rounded near_zero(Interval::from_bounds(0.5, 1.0), 0.5);
    const Rounded large(0x1p300);
    const Rounded smaller(0x1p245);  // the error of the product, 2^492, would be small enough
    const Rounded nothing(Interval::empty());
    return std::array<Rounded, 4>{Rounded(1.0) / near_zero, large * smaller, nothing + Rounded(1.0),
                                  Rounded(0.0) * (Rounded(1.0) / near_zero)};
  });
  CHECK(by_zero.error() == kInfinity);
  CHECK(too_large.error() == kInfinity);
  CHECK(unknown.error() == kInfinity);
  CHECK(later.error() == kInfinity);
  CHECK(Rounded(Interval(1.0), kNaN).error() == kInfinity);
  CHECK(Rounded(Interval(1.0), -1.0).error() == kInfinity);
}

TEST_CASE("what is known not to be negative divides") {
  const auto [with, without] = upward([] {
    const Rounded x(Interval::from_bounds(-2.0, 3.0));
    return std::array<Rounded, 2>{Rounded(1.0) / (Rounded(1.0) + not_negative(x)),
                                  Rounded(1.0) / (Rounded(1.0) + x)};
  });
  CHECK(with.error() < 1e-15);
  CHECK(without.error() == kInfinity);
  CHECK(upward([] { return not_negative(Rounded(-1.0)); }).error() == kInfinity);
}

TEST_CASE("two values are the same only when both are known to be") {
  const Rounded two(2.0);
  CHECK(two == Rounded(2.0));
  CHECK_FALSE(two == Rounded(3.0));
  CHECK_FALSE(two == Rounded(Interval::from_bounds(1.0, 3.0)));
  CHECK_FALSE(two == Rounded(Interval(2.0), 1e-20));
  CHECK_FALSE(Rounded(Interval(2.0), 1e-20) == two);
  CHECK_FALSE(Rounded(Interval::empty()) == Rounded(Interval::empty()));
  // What is divided by only when it is not zero: where it may be, nothing is known of the quotient.
  const bool upward_mode = upward([&] {
    const Rounded perhaps(Interval::from_bounds(0.0, 1.0));
    return !(perhaps == Rounded(0.0)) && !std::isfinite((two / perhaps).error());
  });
  CHECK(upward_mode);
}
