#include "analysis/rigor/self_test.hpp"

#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/mpfr_reference.hpp"
#include "analysis/rigor/self_test_patterns.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::rigor {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The control register before main: a -ffast-math on the link line sets flush-to-zero at start-up.
const unsigned int control_at_start = detail::read_control();

class Examiner {
 public:
  void expect(bool holds, std::string_view what) {
    if (!holds) {
      report_.failures.emplace_back(what);
    }
  }

  void expect_value(double actual, double expected, const std::string& what) {
    const bool same = actual == expected;
    expect(same, what + " gave " + to_hexadecimal(actual) + " instead of " + to_hexadecimal(expected));
  }

  [[nodiscard]] SelfTestReport take_report() { return std::move(report_); }

 private:
  SelfTestReport report_;
};

// ---- the state of the processor

constexpr unsigned int kExceptionMasks = 0x1F80;  // MXCSR: set while floating-point exceptions do not trap

void examine_control(Examiner& examiner, unsigned int control, const std::string& when) {
  examiner.expect((control & detail::kFlushMask) == 0,
                  when + ": denormal numbers are flushed to zero (is -ffast-math on the link line?)");
  examiner.expect((control & detail::kRoundingMask) == 0, when + ": the rounding mode is not to-nearest");
  examiner.expect((control & kExceptionMasks) == kExceptionMasks, when + ": floating-point exceptions trap");
}

void examine_scopes(Examiner& examiner) {
  constexpr unsigned int kAllModes = detail::kRoundingMask | detail::kFlushMask;
  const unsigned int before = detail::read_control() & kAllModes;
  {
    const UpwardRounding outer;
    examiner.expect(rounding_is_upward(), "UpwardRounding does not set the mode");
    {
      const NearestRounding inner;
      examiner.expect(!rounding_is_upward(), "NearestRounding does not set the mode");
    }
    examiner.expect(rounding_is_upward(), "an inner scope does not restore the mode");
    try {
      const NearestRounding inner;
      throw ArithmeticError("unwinding");
    } catch (const ArithmeticError&) {
      examiner.expect(rounding_is_upward(), "unwinding does not restore the mode");
    }
  }
  examiner.expect((detail::read_control() & kAllModes) == before, "a scope does not restore the mode");

  const unsigned int control = detail::read_control();
  detail::write_control(control | detail::kFlushMask);
  {
    const UpwardRounding scope;
    examiner.expect(rounding_is_upward(), "UpwardRounding does not clear flush-to-zero");
  }
  detail::write_control(control);
}

// ---- what the compiler may have done

// Ordinary expressions on literals, as careless code would write them. The empty statement prevents the
// compiler from treating the functions as pure, whose calls might be moved across a change of the rounding
// mode.
[[gnu::noinline]] double literal_third() {
  asm volatile("" : : : "memory");
  return 1.0 / 3.0;
}
[[gnu::noinline]] double literal_sum() {
  asm volatile("" : : : "memory");
  return 1.0 + 0x1p-60;
}
[[gnu::noinline]] double literal_product() {
  asm volatile("" : : : "memory");
  return -0.1 * 0.1;
}

void examine_literals(Examiner& examiner) {
  std::optional<UpwardRounding> mode(std::in_place);
  const double third = literal_third();
  const double sum = literal_sum();
  const double product = literal_product();
  mode.reset();
  const std::string folded = " was folded by the compiler (compile with -frounding-math): it";
  examiner.expect_value(third, 0x1.5555555555556p-2, "1.0 / 3.0" + folded);
  examiner.expect_value(sum, 0x1.0000000000001p+0, "1.0 + 0x1p-60" + folded);
  examiner.expect_value(product, -0x1.47ae147ae147bp-7, "-0.1 * 0.1" + folded);
}

void examine_reuse_across_modes(Examiner& examiner) {
  const auto third = [] { return detail::opaque(detail::opaque(1.0) / detail::opaque(3.0)); };
  std::optional<UpwardRounding> mode(std::in_place);
  const double first = third();
  mode.reset();
  const double second = third();
  mode.emplace();
  const double again = third();
  mode.reset();
  examiner.expect_value(first, 0x1.5555555555556p-2, "1 / 3, upward");
  examiner.expect_value(second, 0x1.5555555555555p-2, "1 / 3, to nearest, after the same in upward mode");
  examiner.expect_value(again, 0x1.5555555555556p-2, "1 / 3, upward, after the same in nearest mode");
}

// ---- operations

double evaluate(const Pattern& pattern, Direction direction) {
  const bool down = direction == Direction::down;
  switch (pattern.operation) {
    case '+':
      return down ? add_down(pattern.a, pattern.b) : add_up(pattern.a, pattern.b);
    case '-':
      return down ? sub_down(pattern.a, pattern.b) : sub_up(pattern.a, pattern.b);
    case '*':
      return down ? mul_down(pattern.a, pattern.b) : mul_up(pattern.a, pattern.b);
    case '/':
      return down ? div_down(pattern.a, pattern.b) : div_up(pattern.a, pattern.b);
    default:
      return down ? sqrt_down(pattern.a) : sqrt_up(pattern.a);
  }
}

Interval evaluate(const Pattern& pattern) {
  const Interval a(pattern.a);
  const Interval b(pattern.b);
  switch (pattern.operation) {
    case '+':
      return a + b;
    case '-':
      return a - b;
    case '*':
      return a * b;
    case '/':
      return a / b;
    default:
      return sqrt(a);
  }
}

void examine_operations(Examiner& examiner) {
  for (const Pattern& pattern : kPatterns) {
    std::optional<UpwardRounding> mode(std::in_place);
    const double down = evaluate(pattern, Direction::down);
    const double up = evaluate(pattern, Direction::up);
    const Interval both = evaluate(pattern);
    mode.reset();
    const std::string name = pattern.operation == 'r' ? "sqrt " + to_hexadecimal(pattern.a)
                                                      : to_hexadecimal(pattern.a) + " " + pattern.operation +
                                                            " " + to_hexadecimal(pattern.b);
    examiner.expect_value(down, pattern.down, name + ", downward,");
    examiner.expect_value(up, pattern.up, name + ", upward,");
    examiner.expect_value(both.lower(), pattern.down, name + ", lower bound of the interval,");
    examiner.expect_value(both.upper(), pattern.up, name + ", upper bound of the interval,");
  }
}

void examine_elementary_functions(Examiner& examiner) {
  constexpr double kWidestInUlps = 10.0;
  const UpwardRounding mode;
  for (const ElementaryPattern& pattern : kElementaryPatterns) {
    const std::string name(pattern.name);
    const Interval tightest = Interval::from_bounds(pattern.down, pattern.up);
    const Interval enclosure = pattern.function(Interval(pattern.argument));
    const std::string where = name + "(" + to_hexadecimal(pattern.argument) + ")";
    examiner.expect_value(pattern.reference(pattern.argument, Direction::down), pattern.down,
                          "MPFR's " + where);
    examiner.expect_value(pattern.reference(pattern.argument, Direction::up), pattern.up, "MPFR's " + where);
    // cannot bind (tightest): it is true wherever the tests of these functions pass, and is for machines
    // where they do not.
    examiner.expect(is_subset(tightest, enclosure), where + " misses the value");
    examiner.expect(width(enclosure) <= mul_up(kWidestInUlps, width(tightest)), where + " is too wide");
  }
}

// ---- operands that must not certify

void examine_predicates(Examiner& examiner, const Interval& operand, const std::string& name) {
  const Interval one(1.0);
  const bool certifies = certainly_less(operand, one) || certainly_less(one, operand) ||
                         certainly_less_equal(operand, one) || certainly_less_equal(one, operand) ||
                         certainly_positive(operand) || certainly_negative(operand) || is_finite(operand);
  examiner.expect(!certifies, name + " certifies something");
  examiner.expect(
      decide_less(operand, one) == Verdict::undecided && decide_less(one, operand) == Verdict::undecided,
      name + " decides something");
}

void examine_exceptional_operands(Examiner& examiner) {
  const UpwardRounding mode;
  const double nan = detail::opaque(kNaN);
  const double infinity = detail::opaque(kInfinity);
  const bool nan_equals_itself = nan == nan || nan <= nan || nan >= nan;
  examiner.expect(!nan_equals_itself && !std::isfinite(nan) && !std::isfinite(infinity),
                  "NaN or infinity is taken for a number (is -ffinite-math-only in use?)");
  const Interval one(1.0);
  examine_predicates(examiner, Interval(nan), "NaN");
  examine_predicates(examiner, Interval(infinity), "infinity");
  examine_predicates(examiner, Interval(-infinity), "-infinity");
  examine_predicates(examiner, Interval::from_bounds(nan, 2.0), "[NaN, 2]");
  examine_predicates(examiner, Interval::from_bounds(2.0, nan), "[2, NaN]");
  examine_predicates(examiner, Interval::from_bounds(3.0, 2.0), "[3, 2]");
  examine_predicates(examiner, Interval::from_bounds(2.0, infinity), "[2, infinity]");
  examine_predicates(examiner, Interval::from_bounds(-infinity, -2.0), "[-infinity, -2]");
  examine_predicates(examiner, Interval(nan) * Interval::from_bounds(1.0, 2.0), "NaN * [1, 2]");
  examine_predicates(examiner, Interval(nan) * Interval(0.0), "NaN * 0");
  examine_predicates(examiner, one / Interval::from_bounds(0.0, 1.0), "1 / [0, 1]");
  examine_predicates(examiner, sqrt(Interval::from_bounds(-1.0, 4.0)), "sqrt [-1, 4]");
  examine_predicates(examiner, log(Interval::from_bounds(0.0, 4.0)), "log [0, 4]");
  examine_predicates(examiner, sin(Interval(nan)), "sin NaN");
}

}  // namespace

SelfTestReport run_self_test() {
  Examiner examiner;
  try {
    examine_control(examiner, control_at_start, "when the process started");
    examine_control(examiner, detail::read_control(), "when the self-test started");
    examine_scopes(examiner);
    examine_literals(examiner);
    examine_reuse_across_modes(examiner);
    examine_operations(examiner);
    examine_elementary_functions(examiner);
    examine_exceptional_operands(examiner);
  } catch (const std::exception& error) {
    examiner.expect(false, error.what());
  }
  return examiner.take_report();
}

void require_sound_arithmetic() {
  const SelfTestReport report = run_self_test();
  if (report.passed()) {
    return;
  }
  std::string message = "the arithmetic of this process is not fit for proofs:";
  for (const std::string& failure : report.failures) {
    message += "\n  " + failure;
  }
  throw ArithmeticError(message);
}

}  // namespace veritrack::rigor
