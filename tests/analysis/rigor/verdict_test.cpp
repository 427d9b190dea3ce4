#include "analysis/rigor/verdict.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "tests/analysis/rigor/operands.hpp"

using namespace veritrack;
using namespace veritrack::test;
using rigor::Interval;
using rigor::Verdict;

TEST_CASE("verdicts have names, and an unset one claims nothing") {
  CHECK(to_string(Verdict::proved) == "proved");
  CHECK(to_string(Verdict::refuted) == "refuted");
  CHECK(to_string(Verdict::undecided) == "undecided");
  CHECK(Verdict{} == Verdict::undecided);
}

TEST_CASE("comparisons are decided only where every pair of points agrees") {
  const rigor::UpwardRounding mode;
  const Interval low = Interval::from_bounds(0.0, 1.0);
  const Interval touching = Interval::from_bounds(1.0, 2.0);
  const Interval high = Interval::from_bounds(1.5, 2.0);
  const Interval one(1.0);
  CHECK(decide_less(low, high) == Verdict::proved);
  CHECK(decide_less(high, low) == Verdict::refuted);
  CHECK(decide_less(low, touching) == Verdict::undecided);
  CHECK(decide_less(touching, low) == Verdict::refuted);
  CHECK(decide_less(one, one) == Verdict::refuted);
  CHECK(decide_less(low, low) == Verdict::undecided);
  CHECK(decide_less_equal(low, touching) == Verdict::proved);
  CHECK(decide_less_equal(touching, low) == Verdict::undecided);
  CHECK(decide_less_equal(high, low) == Verdict::refuted);
  CHECK(decide_less_equal(one, one) == Verdict::proved);
}

TEST_CASE("a verdict never contradicts a pair of points") {
  Operands operands(40);
  Misses misses;
  std::int64_t decided = 0;
  for (std::int64_t round = effort(200'000); round > 0; --round) {
    const Interval x = operands.interval();
    const Interval y = operands.coin() ? operands.interval() : operands.around(operands.point_of(x));
    const double s = operands.point_of(x);
    const double t = operands.point_of(y);
    const rigor::UpwardRounding mode;
    const Verdict less = decide_less(x, y);
    const Verdict less_equal = decide_less_equal(x, y);
    misses.expect(less != Verdict::proved || s < t, "proved <", x, y, s, t);
    misses.expect(less != Verdict::refuted || s >= t, "refuted <", x, y, s, t);
    misses.expect(less_equal != Verdict::proved || s <= t, "proved <=", x, y, s, t);
    misses.expect(less_equal != Verdict::refuted || s > t, "refuted <=", x, y, s, t);
    decided += less == Verdict::undecided ? 0 : 1;
  }
  VERITRACK_CHECK_NO_MISSES(misses);
  CHECK(decided > effort(200'000) / 4);
}

TEST_CASE("NaN, infinite and empty operands decide nothing") {
  const rigor::UpwardRounding mode;
  for (const Interval& x :
       {Interval(), Interval(kNaN), Interval(kInfinity), Interval::entire(),
        Interval::from_bounds(5.0, kInfinity), Interval::from_bounds(-kInfinity, -5.0),
        Interval(1.0) / Interval::from_bounds(0.0, 1.0), Interval::from_bounds(2.0, 1.0)}) {
    for (const Interval& y : {Interval(0.0), Interval(1.0), Interval(), Interval::entire()}) {
      CHECK(decide_less(x, y) == Verdict::undecided);
      CHECK(decide_less(y, x) == Verdict::undecided);
      CHECK(decide_less_equal(x, y) == Verdict::undecided);
      CHECK(decide_less_equal(y, x) == Verdict::undecided);
    }
  }
}

TEST_CASE("a verdict outside an UpwardRounding scope is refused") {
  CHECK_THROWS_AS((void)decide_less(Interval(1.0), Interval(2.0)), rigor::RoundingModeError);
  CHECK_THROWS_AS((void)decide_less_equal(Interval(1.0), Interval(2.0)), rigor::RoundingModeError);
}

TEST_CASE("conjunctions: refuted by one, proved by all, and nothing proves nothing") {
  using enum Verdict;
  CHECK(rigor::conjunction({proved, proved}) == proved);
  CHECK(rigor::conjunction({proved, undecided}) == undecided);
  CHECK(rigor::conjunction({undecided, refuted}) == refuted);
  CHECK(rigor::conjunction({refuted, proved}) == refuted);
  CHECK(rigor::conjunction({undecided}) == undecided);
  CHECK(rigor::conjunction(std::initializer_list<Verdict>{}) == undecided);
  CHECK(rigor::conjunction(std::vector<Verdict>{proved, proved, proved}) == proved);
  CHECK(rigor::conjunction(std::vector<Verdict>{}) == undecided);
}
