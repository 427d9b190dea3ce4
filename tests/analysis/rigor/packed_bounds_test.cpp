// The oracle is Boost.Interval, whose products and quotients distinguish the signs of all ends.
#include "analysis/rigor/packed_bounds.hpp"

#include <doctest/doctest.h>

#include <boost/numeric/interval/arith.hpp>
#include <boost/numeric/interval/checking.hpp>
#include <boost/numeric/interval/interval.hpp>
#include <boost/numeric/interval/policies.hpp>
#include <boost/numeric/interval/utility.hpp>

#include "tests/analysis/rigor/operands.hpp"

using namespace veritrack;
using namespace veritrack::test;
using rigor::Interval;

namespace {

/// Boost's rounding policy over the scalar operations: the caller holds the mode.
struct HeldUpwardPolicy {
  using unprotected_rounding = HeldUpwardPolicy;
  static double conv_down(double x) { return x; }
  static double conv_up(double x) { return x; }
  static double add_down(double x, double y) { return rigor::add_down(x, y); }
  static double add_up(double x, double y) { return rigor::add_up(x, y); }
  static double sub_down(double x, double y) { return rigor::sub_down(x, y); }
  static double sub_up(double x, double y) { return rigor::sub_up(x, y); }
  static double mul_down(double x, double y) { return rigor::mul_down(x, y); }
  static double mul_up(double x, double y) { return rigor::mul_up(x, y); }
  static double div_down(double x, double y) { return rigor::div_down(x, y); }
  static double div_up(double x, double y) { return rigor::div_up(x, y); }
  static double sqrt_down(double x) { return rigor::sqrt_down(x); }
  static double sqrt_up(double x) { return rigor::sqrt_up(x); }
};
using BoostInterval = boost::numeric::interval<
    double, boost::numeric::interval_lib::policies<HeldUpwardPolicy,
                                                   boost::numeric::interval_lib::checking_base<double>>>;

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

}  // namespace

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
