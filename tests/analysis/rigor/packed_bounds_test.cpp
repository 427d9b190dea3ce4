// The oracle is Boost.Interval, whose products and quotients distinguish the signs of all ends.
#include "analysis/rigor/packed_bounds.hpp"

#include <doctest/doctest.h>

#include "analysis/rigor/boost_bounds.hpp"
#include "tests/analysis/rigor/operands.hpp"

using namespace veritrack;
using namespace veritrack::test;
using rigor::Interval;

namespace {

using BoostInterval = rigor::boosted::Bounds;

BoostInterval to_boost(const Interval& x) {
  return {x.lower(), x.upper(), true};
}

/// The same numbers, or both empty; and an empty interval has no bound that is a number.
bool same(const Interval& x, const BoostInterval& expected) {
  const bool is_set = expected.lower() <= expected.upper();
  if (is_set) {
    return x.lower() == expected.lower() && x.upper() == expected.upper();
  }
  return std::isnan(x.lower()) && std::isnan(x.upper());
}

/// Bounded, unbounded, empty, points; often with ends that are zero, infinite, or near overflow and
/// underflow.
Interval some_interval(Operands& operands) {
  constexpr double kSpecial[] = {0.0,      -0.0,      kInfinity, -kInfinity,
                                 kLargest, -kLargest, kSmallest, -kSmallest};
  const auto end = [&] {
    const std::uint64_t choice = operands.random().below(16);
    return choice < 8 ? operands.number() : kSpecial[choice - 8];
  };
  const double a = end();
  const double b = operands.random().below(4) == 0 ? a : end();
  // The wrong way round one time in sixteen: empty.
  return operands.random().below(16) == 0 ? bounds(a, b) : bounds(std::min(a, b), std::max(a, b));
}

__m128d packed_of(const Interval& x) {
  return rigor::packed::pack(x.lower(), x.upper());
}
bool same(__m128d x, __m128d y) {
  return rigor::identical(bounds(rigor::packed::lower(x), rigor::packed::upper(x)),
                          bounds(rigor::packed::lower(y), rigor::packed::upper(y)));
}

}  // namespace

TEST_CASE("the operations that a build may have in their place give the same bounds") {
  Operands operands(43);
  Misses misses;
  const rigor::UpwardRounding mode;
  for (std::int64_t round = effort(100'000); round > 0; --round) {
    const Interval x = some_interval(operands);
    const Interval y = some_interval(operands);
    const __m128d a = packed_of(x);
    const __m128d b = packed_of(y);
    misses.expect(same(rigor::boosted::sum(a, b), rigor::packed::sum(a, b)), "sum", x, y);
    misses.expect(same(rigor::boosted::product(a, b), rigor::packed::product(a, b)), "product", x, y);
    misses.expect(same(rigor::boosted::quotient(a, b), rigor::packed::quotient(a, b)), "quotient", x, y);
    misses.expect(same(rigor::boosted::square(a), rigor::packed::square(a)), "square", x);
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE("operations without branches give the bounds that a distinction of all signs gives") {
  Operands operands(41);
  Misses misses;
  const rigor::UpwardRounding mode;
  for (std::int64_t round = effort(200'000); round > 0; --round) {
    const Interval x = some_interval(operands);
    const Interval y = some_interval(operands);
    const BoostInterval a = to_boost(x);
    const BoostInterval b = to_boost(y);
    misses.expect(same(x + y, a + b), "sum", x, y);
    misses.expect(same(x - y, a - b), "difference", x, y);
    misses.expect(same(-x, -a), "negative", x);
    misses.expect(same(x * y, a * b), "product", x, y, x * y);
    const bool is_nonzero = y.lower() > 0.0 || y.upper() < 0.0;
    misses.expect(is_nonzero ? same(x / y, a / b) : same(x / y, BoostInterval(kNaN, kNaN, true)), "quotient",
                  x, y, x / y);
    const double least = mignitude(x);
    const double most = magnitude(x);
    misses.expect(
        same(square(x), BoostInterval(rigor::mul_down(least, least), rigor::mul_up(most, most), true)),
        "square", x);
    const bool both = !rigor::is_empty(x) && !rigor::is_empty(y);
    misses.expect(same(hull(x, y), both ? BoostInterval(std::min(x.lower(), y.lower()),
                                                        std::max(x.upper(), y.upper()), true)
                                        : BoostInterval(kNaN, kNaN, true)),
                  "hull", x, y);
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE("zero times infinity is zero, and nothing comes of nothing") {
  const rigor::UpwardRounding mode;
  const Interval zero(0.0);
  const Interval everything = Interval::entire();
  const auto identical = [](const Interval& a, const Interval& b) { return rigor::identical(a, b); };
  CHECK(identical(zero * everything, zero));
  CHECK(identical(everything * zero, zero));
  CHECK(identical(bounds(0.0, 1.0) * everything, everything));
  CHECK(identical(bounds(0.0, 1.0) * bounds(2.0, kInfinity), bounds(0.0, kInfinity)));
  CHECK(identical(bounds(-1.0, 0.0) * bounds(2.0, kInfinity), bounds(-kInfinity, 0.0)));
  for (const Interval& x : {zero, everything, bounds(-1.0, 2.0), Interval::empty()}) {
    CHECK(rigor::is_empty(x * Interval::empty()));
    CHECK(rigor::is_empty(Interval::empty() * x));
    CHECK(rigor::is_empty(x + Interval::empty()));
    CHECK(rigor::is_empty(x / Interval::empty()));
    CHECK(rigor::is_empty(Interval::empty() / x));
    CHECK(rigor::is_empty(hull(x, Interval::empty())));
  }
  CHECK(rigor::is_empty(square(Interval::empty())));
}
