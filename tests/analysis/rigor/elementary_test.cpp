#include "analysis/rigor/elementary.hpp"

#include <doctest/doctest.h>

#include <thread>
#include <vector>

#include "analysis/rigor/sine_cosine_constants.hpp"
#include "tests/analysis/rigor/mpfr_oracle.hpp"
#include "tests/analysis/rigor/operands.hpp"

using namespace veritrack;
using namespace veritrack::test;
using rigor::Interval;

namespace {

constexpr std::int64_t kElementaryCases = 200'000;

/// n with n pi/2 <= x < (n + 1) pi/2, for |x| up to 1e15 or so, from 300 bits of pi.
std::int64_t quarters_below(double x) {
  static Oracle half_pi(300);
  static Oracle point(300);
  static Oracle turns(300);
  half_pi.evaluate(mpfr_const_pi);
  point = 0.5;
  half_pi.evaluate(mpfr_mul, half_pi.value(), point.value());
  point = x;
  turns.evaluate(mpfr_div, point.value(), half_pi.value());
  return mpfr_get_sj(turns.value(), MPFR_RNDD);
}

/// Does a number with this residue modulo 4 lie in (first, last]?
bool holds_residue(std::int64_t first, std::int64_t last, std::int64_t residue) {
  for (std::int64_t n = first + 1; n <= last && n <= first + 4; ++n) {
    if (((n % 4) + 4) % 4 == residue) {
      return true;
    }
  }
  return false;
}

/// The tightest interval around the range of sin (maximum = 1) or cos (maximum = 0) over x.
Interval tightest_range(int (*function)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t), int maximum, const Interval& x) {
  static Oracle end;
  static Oracle value;
  double lower = 1.0;
  double upper = -1.0;
  for (const double point : {x.lower(), x.upper()}) {
    end = point;
    value.evaluate(function, end.value());
    lower = std::min(lower, value.rounded_down());
    upper = std::max(upper, value.rounded_up());
  }
  const std::int64_t first = quarters_below(x.lower());
  const std::int64_t last = quarters_below(x.upper());
  return bounds(holds_residue(first, last, (maximum + 2) % 4) ? -1.0 : lower,
                holds_residue(first, last, maximum) ? 1.0 : upper);
}

}  // namespace

TEST_CASE("pi is the tightest interval around the circle constant") {
  Oracle circle_constant;
  circle_constant.evaluate(mpfr_const_pi);
  CHECK(rigor::pi().lower() == circle_constant.rounded_down());
  CHECK(rigor::pi().upper() == circle_constant.rounded_up());
  CHECK(identical(rigor::pi(), upward([] { return rigor::pi(); })));
}

TEST_CASE("the constants behind sin and cos are the tightest bounds on what they stand for") {
  const auto is_tightest = [](const rigor::detail::Bounds& bounds_of_constant, const Oracle& constant) {
    return bounds_of_constant.low == constant.rounded_down() &&
           bounds_of_constant.high == constant.rounded_up();
  };
  Oracle circle_constant(400);
  Oracle factor(400);
  Oracle constant(400);
  circle_constant.evaluate(mpfr_const_pi);
  factor = 2.0;
  constant.evaluate(mpfr_div, factor.value(), circle_constant.value());
  CHECK(is_tightest(rigor::detail::kTwoOverPi, constant));

  constant.evaluate(mpfr_div, circle_constant.value(), factor.value());
  for (const double part : {rigor::detail::kHalfPi1, rigor::detail::kHalfPi2}) {
    CHECK(std::ldexp(part, 32 - std::ilogb(part)) ==
          std::floor(std::ldexp(part, 32 - std::ilogb(part))));  // 33 bits
    factor = part;
    constant.evaluate(mpfr_sub, constant.value(), factor.value());  // exact to far beyond double
  }
  CHECK(is_tightest(rigor::detail::kHalfPi3, constant));

  for (unsigned int term = 0; term < rigor::detail::kTerms; ++term) {
    CAPTURE(term);
    factor = 1.0;
    constant.evaluate(
        [&](mpfr_ptr result, mpfr_rnd_t mode) { return mpfr_fac_ui(result, 2 * term + 3, mode); });
    constant.evaluate(mpfr_div, factor.value(), constant.value());
    CHECK(is_tightest(rigor::detail::kSineCoefficients[term], constant));
    constant.evaluate(
        [&](mpfr_ptr result, mpfr_rnd_t mode) { return mpfr_fac_ui(result, 2 * term + 2, mode); });
    constant.evaluate(mpfr_div, factor.value(), constant.value());
    CHECK(is_tightest(rigor::detail::kCosineCoefficients[term], constant));
  }
}

TEST_CASE("sin, cos and sin_cos hold every value") {
  Operands operands(20);
  Oracle s;
  Oracle sine;
  Oracle cosine;
  Misses misses;
  for (std::int64_t round = effort(kElementaryCases); round > 0; --round) {
    const Interval x = operands.around(operands.angle());
    const double point = operands.point_of(x);
    s = point;
    sine.evaluate(mpfr_sin, s.value());
    cosine.evaluate(mpfr_cos, s.value());
    const auto both = upward([&] { return sin_cos(x); });
    misses.expect(sine.lies_in(both.first), "sin", x, point, both.first);
    misses.expect(cosine.lies_in(both.second), "cos", x, point, both.second);
    misses.expect(is_subset(both.first, bounds(-1.0, 1.0)) && is_subset(both.second, bounds(-1.0, 1.0)),
                  "[-1, 1]", x);
    if (round % 8 == 0) {
      const rigor::UpwardRounding mode;
      misses.expect(identical(sin(x), both.first) && identical(cos(x), both.second), "sin_cos is sin and cos",
                    x);
      const Interval end(point);
      misses.expect(identical(sin(-end), -sin(end)) && identical(cos(-end), cos(end)), "symmetry", end);
    }
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE("sin and cos of points are within five units in the last place") {
  Operands operands(21);
  Oracle s;
  Oracle value;
  Misses misses;
  for (std::int64_t round = effort(kElementaryCases); round > 0; --round) {
    const double point =
        operands.coin() ? operands.random().uniform(-1000.0, 1000.0) : operands.random().uniform(-4.0, 4.0);
    const auto both = upward([&] { return sin_cos(Interval(point)); });
    s = point;
    value.evaluate(mpfr_sin, s.value());
    const bool sine_is_tight = is_within(both.first, value.rounded_down(), value.rounded_up(), 5);
    misses.expect(sine_is_tight || std::fabs(value.nearest()) < 1e-3, "sin", point, both.first);
    value.evaluate(mpfr_cos, s.value());
    const bool cosine_is_tight = is_within(both.second, value.rounded_down(), value.rounded_up(), 5);
    misses.expect(cosine_is_tight || std::fabs(value.nearest()) < 1e-3, "cos", point, both.second);
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE("sin and cos keep their relative accuracy next to their zeros, up to 2^20") {
  Operands operands(22);
  Oracle s;
  Oracle value;
  Misses misses;
  for (std::int64_t round = effort(kElementaryCases / 10); round > 0; --round) {
    const double point = operands.near_quarter_turn();
    const bool in_range = std::fabs(point) > 1e-290 && std::fabs(point) <= 0x1p+20;
    if (!in_range) {
      continue;
    }
    s = point;
    const auto both = upward([&] { return sin_cos(Interval(point)); });
    value.evaluate(mpfr_sin, s.value());
    const bool sine_is_tight = both.first.upper() - both.first.lower() <= 1e-9 * std::fabs(value.nearest());
    value.evaluate(mpfr_cos, s.value());
    const bool cosine_is_tight =
        both.second.upper() - both.second.lower() <= 1e-9 * std::fabs(value.nearest());
    misses.expect(sine_is_tight && cosine_is_tight, "relative width", point, both.first, both.second);
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE(
    "ranges of sin and cos over intervals are tight to second order in a narrow radius, and to rounding "
    "beyond") {
  Operands operands(23);
  Misses misses;
  for (std::int64_t round = effort(kElementaryCases / 4); round > 0; --round) {
    const double start =
        operands.coin() ? operands.random().uniform(-1000.0, 1000.0) : operands.near_quarter_turn();
    const double length =
        std::ldexp(operands.random().uniform(0.5, 1.0), 3 - static_cast<int>(operands.random().below(40)));
    const Interval x = bounds(start, start + length);
    if (std::fabs(start) > 0x1p+20) {
      continue;
    }
    const auto both = upward([&] { return sin_cos(x); });
    const double reach = 0.5 * (x.upper() - x.lower());
    const double slack = 4e-15 + (reach < 0.01 ? reach * reach : 0.0);
    const Interval sine = tightest_range(mpfr_sin, 1, x);
    const Interval cosine = tightest_range(mpfr_cos, 0, x);
    misses.expect(is_subset(sine, both.first) && is_subset(cosine, both.second), "range", x, both.first,
                  both.second);
    misses.expect(is_subset(both.first, bounds(sine.lower() - slack, sine.upper() + slack)), "sin", x,
                  both.first, sine);
    misses.expect(is_subset(both.second, bounds(cosine.lower() - slack, cosine.upper() + slack)), "cos", x,
                  both.second, cosine);
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE("tan holds every value, and is empty where there is a pole") {
  Operands operands(24);
  Oracle s;
  Oracle value;
  Misses misses;
  std::int64_t defined = 0;
  for (std::int64_t round = effort(kElementaryCases); round > 0; --round) {
    const Interval x = operands.around(operands.angle());
    const double point = operands.point_of(x);
    const Interval result = upward([&] { return tan(x); });
    if (!rigor::is_finite(x) || std::max(std::fabs(x.lower()), std::fabs(x.upper())) > 1e15) {
      misses.expect(rigor::is_empty(result) || x.upper() - x.lower() < 4.0,
                    "tan of an interval with many poles", x);
    } else {
      const std::int64_t first = quarters_below(x.lower());
      const std::int64_t last = quarters_below(x.upper());
      const bool has_pole = holds_residue(first, last, 1) || holds_residue(first, last, 3);
      misses.expect(has_pole == rigor::is_empty(result), "poles of tan", x, result);
    }
    if (!rigor::is_empty(result)) {
      s = point;
      value.evaluate(mpfr_tan, s.value());
      misses.expect(value.lies_in(result), "tan", x, point, result);
      ++defined;
    }
  }
  VERITRACK_CHECK_NO_MISSES(misses);
  CHECK(defined > effort(kElementaryCases) / 4);
}

TEST_CASE("atan, exp and log hold every value, and are the tightest at points") {
  struct Function {
    const char* name;
    Interval (*function)(const Interval&);
    int (*oracle)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
  };
  const Function functions[] = {
      {"atan", rigor::atan, mpfr_atan}, {"exp", rigor::exp, mpfr_exp}, {"log", rigor::log, mpfr_log}};
  Operands operands(25);
  Oracle s;
  Oracle value;
  Misses misses;
  for (std::int64_t round = effort(kElementaryCases); round > 0; --round) {
    for (const Function& function : functions) {
      const bool is_log = function.oracle == mpfr_log;
      const double centre = function.oracle == mpfr_exp && operands.random().below(4) != 0
                                ? operands.random().uniform(-750.0, 720.0)
                                : operands.number();
      const Interval any =
          operands.around(is_log && operands.random().below(8) != 0 ? std::fabs(centre) : centre);
      const Interval x = is_log && operands.random().below(8) != 0 ? abs(any) : any;
      const Interval result = upward([&] { return function.function(x); });
      if (is_log && x.lower() <= 0.0) {
        misses.expect(rigor::is_empty(result), "log outside its domain", x, result);
        continue;
      }
      const double point = operands.point_of(x);
      s = point;
      value.evaluate(function.oracle, s.value());
      misses.expect(value.lies_in(result), function.name, x, point, result);
      if (x.lower() == x.upper()) {
        misses.expect(result.lower() == value.rounded_down() && result.upper() == value.rounded_up(),
                      "tightness", x, result);
      }
    }
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE("asin and acos hold every angle, tightly, and are empty outside [-1, 1]") {
  Operands operands(27);
  Oracle s;
  Oracle value;
  Misses misses;
  for (std::int64_t round = effort(kElementaryCases); round > 0; --round) {
    // Half of them near the ends, where the slope is not bounded.
    const double near_end = 1.0 - std::exp(operands.random().uniform(-40.0, 0.0));
    const double centre = operands.random().below(2) == 0   ? operands.random().uniform(-1.1, 1.1)
                          : operands.random().below(2) == 0 ? near_end
                                                            : -near_end;
    const double width = operands.random().below(2) == 0 ? 0.0 : operands.random().uniform(0.0, 0.3);
    const Interval x = bounds(centre, centre + width);
    const Interval sine = upward([&] { return rigor::asin(x); });
    const Interval cosine = upward([&] { return rigor::acos(x); });
    if (x.lower() < -1.0 || x.upper() > 1.0) {
      misses.expect(rigor::is_empty(sine) && rigor::is_empty(cosine), "outside", x, sine);
      continue;
    }
    const double point = operands.point_of(x);
    s = point;
    value.evaluate(mpfr_asin, s.value());
    misses.expect(value.lies_in(sine), "asin", x, point, sine);
    value.evaluate(mpfr_acos, s.value());
    misses.expect(value.lies_in(cosine), "acos", x, point, cosine);
    misses.expect(
        width > 0.0 || (sine.upper() - sine.lower() < 1e-15 && cosine.upper() - cosine.lower() < 2e-15),
        "tightness", x, sine, cosine);
  }
  VERITRACK_CHECK_NO_MISSES(misses);
  const rigor::UpwardRounding scope;
  CHECK(is_subset(rigor::pi(), rigor::acos(Interval(-1.0))));
  CHECK(contains(rigor::acos(Interval(1.0)), 0.0));
  CHECK(rigor::is_empty(rigor::asin(Interval::empty())));
  CHECK(rigor::is_empty(rigor::acos(Interval::entire())));
}

TEST_CASE("atan2 holds every angle, and is empty at the origin and across the cut") {
  Operands operands(26);
  Oracle s;
  Oracle t;
  Oracle value;
  Misses misses;
  const auto coordinate = [&] {
    return operands.random().below(4) == 0 ? operands.number() : operands.random().uniform(-3.0, 3.0);
  };
  for (std::int64_t round = effort(kElementaryCases); round > 0; --round) {
    const Interval y = operands.around(coordinate());
    const Interval x = operands.around(coordinate());
    const Interval result = upward([&] { return atan2(y, x); });
    const bool holds_origin = rigor::contains(y, 0.0) && rigor::contains(x, 0.0);
    const bool touches_cut_from_below = x.lower() < 0.0 && y.lower() < 0.0 && y.upper() >= 0.0;
    if (holds_origin || touches_cut_from_below) {
      misses.expect(rigor::is_empty(result), "atan2 where it jumps", y, x, result);
      continue;
    }
    const double point_of_x = operands.point_of(x);
    const double point_of_y = operands.point_of(y);
    s = point_of_y == 0.0 ? 0.0 : point_of_y;  // -0.0 is the number zero
    t = point_of_x == 0.0 ? 0.0 : point_of_x;
    value.evaluate(mpfr_atan2, s.value(), t.value());
    misses.expect(value.lies_in(result), "atan2", y, x, point_of_y, point_of_x, result);
    misses.expect(result.upper() - result.lower() < 3.15, "width of atan2", y, x, result);
    if (y.lower() == y.upper() && x.lower() == x.upper()) {
      misses.expect(result.lower() == value.rounded_down() && result.upper() == value.rounded_up(),
                    "tightness", y, x, result);
    }
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE("the corners that atan2 is evaluated at") {
  const rigor::UpwardRounding mode;
  const Interval pi = rigor::pi();
  const Interval four(4.0);
  CHECK(is_subset(pi / four, atan2(Interval(1.0), Interval(1.0))));
  CHECK(is_subset(pi, atan2(Interval(-0.0), Interval(-1.0))));
  CHECK(is_subset(pi, atan2(bounds(-0.0, 1.0), Interval(-1.0))));
  CHECK(rigor::is_empty(atan2(bounds(-kSmallest, 1.0), Interval(-1.0))));
  CHECK(rigor::is_empty(atan2(bounds(-1.0, 0.0), bounds(-1.0, 1.0))));
  CHECK(rigor::is_empty(atan2(Interval(0.0), Interval(0.0))));
  CHECK(identical(atan2(bounds(0.0, 1.0), bounds(1.0, kInfinity)), bounds(0.0, (pi / four).upper())));
  CHECK(identical(atan2(bounds(-1.0, 1.0), bounds(1.0, 2.0)), -atan2(bounds(-1.0, 1.0), bounds(1.0, 2.0))));
  CHECK(identical(atan2(bounds(1.0, kInfinity), Interval::entire()), bounds(0.0, pi.upper())));
}

TEST_CASE("functional equations") {
  Operands operands(27);
  Misses misses;
  for (std::int64_t round = effort(kElementaryCases / 10); round > 0; --round) {
    const Interval a = operands.around(operands.random().uniform(-20.0, 20.0));
    const Interval b = operands.around(operands.random().uniform(-20.0, 20.0));
    if (!rigor::is_finite(a) || !rigor::is_finite(b)) {
      continue;
    }
    const rigor::UpwardRounding mode;
    const auto [sine_a, cosine_a] = sin_cos(a);
    const auto [sine_b, cosine_b] = sin_cos(b);
    misses.expect(rigor::contains(square(sine_a) + square(cosine_a), 1.0), "sin^2 + cos^2 = 1", a);
    misses.expect(!rigor::is_empty(intersection(sin(a + b), sine_a * cosine_b + cosine_a * sine_b)),
                  "sin(a + b)", a, b);
    misses.expect(!rigor::is_empty(intersection(exp(a + b), exp(a) * exp(b))), "exp(a + b)", a, b);
    misses.expect(is_subset(a, log(exp(a))) || exp(a).lower() <= 0.0, "log(exp(a))", a);
    const Interval tangent = tan(a);
    misses.expect(rigor::is_empty(tangent) || rigor::contains(cosine_a, 0.0) ||
                      !rigor::is_empty(intersection(tangent, sine_a / cosine_a)),
                  "tan = sin/cos", a);
    const bool in_first_branch = rigor::magnitude(a) < 1.5;
    misses.expect(!in_first_branch || is_subset(a, atan(tan(a))), "atan(tan(a))", a);
    const bool in_right_half_plane = b.lower() > 0.0;
    misses.expect(!in_right_half_plane || !rigor::is_empty(intersection(atan2(a, b), atan(a / b))), "atan2",
                  a, b);
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE("empty operands give empty results, unbounded ones what is true of all real numbers") {
  const rigor::UpwardRounding mode;
  using Function = Interval (*)(const Interval&);
  const Function functions[] = {rigor::sin, rigor::cos, rigor::tan, rigor::atan, rigor::exp, rigor::log};
  for (const Interval& empty : {Interval(), Interval(kNaN), Interval(kInfinity), bounds(2.0, 1.0)}) {
    for (const Function function : functions) {
      CHECK(rigor::is_empty(function(empty)));
    }
    CHECK(rigor::is_empty(sin_cos(empty).first));
    CHECK(rigor::is_empty(sin_cos(empty).second));
    CHECK(rigor::is_empty(atan2(empty, Interval(1.0))));
    CHECK(rigor::is_empty(atan2(Interval(1.0), empty)));
  }
  CHECK(identical(sin(Interval::entire()), bounds(-1.0, 1.0)));
  CHECK(identical(cos(bounds(3.0, kInfinity)), bounds(-1.0, 1.0)));
  CHECK(rigor::is_empty(tan(Interval::entire())));
  CHECK(rigor::is_empty(log(Interval(0.0))));
  CHECK(rigor::is_empty(log(bounds(-1.0, 1.0))));
  CHECK(identical(exp(bounds(-kInfinity, 0.0)), bounds(0.0, 1.0)));
  CHECK(identical(exp(bounds(1e4, 1e5)), bounds(kLargest, kInfinity)));
  CHECK(identical(exp(bounds(-1e5, -1e4)), bounds(0.0, kSmallest)));
  CHECK(identical(log(bounds(1.0, kInfinity)), bounds(0.0, kInfinity)));
  CHECK(rigor::contains(atan(Interval::entire()), 1.5707963267948966));
}

TEST_CASE("the functions that need the upward mode refuse any other, in every build") {
  const Interval one(1.0);
  CHECK_THROWS_AS((void)sin(one), rigor::RoundingModeError);
  CHECK_THROWS_AS((void)cos(one), rigor::RoundingModeError);
  CHECK_THROWS_AS((void)sin_cos(one), rigor::RoundingModeError);
  CHECK_THROWS_AS((void)tan(one), rigor::RoundingModeError);
  CHECK(identical(exp(one), upward([&] { return exp(one); })));
  CHECK(identical(log(Interval(3.0)), upward([] { return log(Interval(3.0)); })));
  CHECK(identical(atan(one), upward([&] { return atan(one); })));
  CHECK(identical(atan2(one, Interval(-2.0)), upward([&] { return atan2(one, Interval(-2.0)); })));
}

TEST_CASE("threads do not disturb each other") {
  const auto evaluate = [] {
    const rigor::UpwardRounding mode;
    std::vector<Interval> results;
    for (int index = 1; index <= 500; ++index) {
      const Interval x(0.37 * index + (index % 5 == 0 ? 0x1p+30 : 0.0));
      results.insert(results.end(),
                     {sin(x), cos(x), tan(x), atan(x), exp(x), log(x), atan2(x, Interval(-1.5))});
    }
    return results;
  };
  const std::vector<Interval> expected = evaluate();
  std::vector<std::vector<Interval>> found(4);
  std::vector<std::thread> threads;
  for (std::vector<Interval>& results : found) {
    threads.emplace_back([&results, &evaluate] { results = evaluate(); });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  for (const std::vector<Interval>& results : found) {
    REQUIRE(results.size() == expected.size());
    CHECK(std::equal(results.begin(), results.end(), expected.begin(),
                     [](const Interval& a, const Interval& b) { return identical(a, b); }));
  }
}
