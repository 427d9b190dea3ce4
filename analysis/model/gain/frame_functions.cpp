// Products and functions of one value, and their remainders: docs/gain-proof.md, section 2.
#include <algorithm>
#include <cmath>

#include "analysis/model/gain/frame_rules.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::model {

using rigor::Interval;

namespace {

struct FunctionRule {
  const char* name;
  Interval (*value)(const Interval& x);
  Interval (*slope)(const Interval& x);
};

const Interval kOne(1.0);

FunctionRule rule_of(FrameOperation operation) {
  using I = const Interval&;
  switch (operation) {
    case FrameOperation::reciprocal:
      return {"a quotient", [](I x) { return kOne / x; }, [](I x) { return -kOne / square(x); }};
    case FrameOperation::root:
      return {"a square root", [](I x) { return sqrt(x); }, [](I x) { return Interval(0.5) / sqrt(x); }};
    case FrameOperation::exponential:
      return {"exp", [](I x) { return rigor::exp(x); }, [](I x) { return rigor::exp(x); }};
    case FrameOperation::logarithm:
      return {"log", [](I x) { return rigor::log(x); }, [](I x) { return kOne / x; }};
    case FrameOperation::tangent:
      return {"tan", [](I x) { return rigor::tan(x); }, [](I x) { return kOne + square(rigor::tan(x)); }};
    case FrameOperation::arcsine:
      return {"asin", [](I x) { return rigor::asin(x); }, [](I x) { return kOne / sqrt(kOne - square(x)); }};
    case FrameOperation::arccosine:
      return {"acos", [](I x) { return rigor::acos(x); }, [](I x) { return -kOne / sqrt(kOne - square(x)); }};
    case FrameOperation::arctangent:
      return {"atan", [](I x) { return rigor::atan(x); }, [](I x) { return kOne / (kOne + square(x)); }};
    default:
      throw NoFrame("a function without a rule");
  }
}

/// At most the integral of |f'(b +- s) - f'(b)| over s from 0 to Y.
double function_remainder(const FunctionRule& rule, const Interval& base, double bound) {
  constexpr int kCells = 64;
  if (!(bound < INFINITY)) {
    return INFINITY;
  }
  const Interval slope = rule.slope(base);
  double sum = 0.0;
  for (int i = 0; i < kCells; ++i) {
    const Interval cell =
        Interval(bound) * Interval::from_bounds(i, i + 1) / Interval(static_cast<double>(kCells));
    const Interval up = rule.slope(base + cell) - slope;
    const Interval down = rule.slope(base - cell) - slope;
    if (!rigor::is_finite(up) || !rigor::is_finite(down)) {
      return INFINITY;
    }
    sum = rigor::add_up(
        sum, rigor::mul_up(std::max(rigor::magnitude(up), rigor::magnitude(down)), rigor::width(cell)));
  }
  return sum;
}

/// The same of exp, whose slope at the base is known: one power after the other.
double exponential_remainder(const Interval& slope, double bound) {
  constexpr double kCells = 64.0;
  if (!(bound < INFINITY)) {
    return INFINITY;
  }
  const double width = bound / kCells;
  const double growth = rigor::exp(Interval(width)).upper();
  double at_end = slope.upper();
  double sum = 0.0;
  for (int i = 0; i < static_cast<int>(kCells); ++i) {
    at_end = rigor::mul_up(at_end, growth);
    sum = rigor::add_up(sum, rigor::mul_up(rigor::sub_up(at_end, slope.lower()), width));
  }
  return sum < INFINITY ? sum : INFINITY;
}

}  // namespace

FrameLine FrameRules::product_line(Frame& frame, const FrameLine& a, const FrameLine& b, bool is_square) {
  require_no_turns(a);
  require_no_turns(b);
  const Interval x = base_of(a, frame.band_);
  const Interval y = base_of(b, frame.band_);
  FrameLine line = sum_of(scaled(form_of(a), y, std::nullopt), scaled(form_of(b), x, std::nullopt), false);
  // To first order in omega where one of them does not depend on it.
  if (a.per_frequency == Interval(0.0) || b.per_frequency == Interval(0.0)) {
    line.constant = a.constant * b.constant;
    line.per_frequency = a.per_frequency * b.constant + b.per_frequency * a.constant;
  } else {
    line.constant = is_square ? square(x) : x * y;
  }
  if (a.is_form_empty() || b.is_form_empty()) {
    return line;
  }
  const auto first = static_cast<std::size_t>(add_form(frame, a));
  const auto second = is_square ? first : static_cast<std::size_t>(add_form(frame, b));
  add_remainder(frame, line, "a product", [first, second](const std::vector<double>& bounds) {
    return rigor::mul_up(bounds[first], bounds[second]);
  });
  return line;
}

FrameLine FrameRules::function_line(Frame& frame, FrameOperation operation, const FrameLine& operand) {
  require_no_turns(operand);
  const FunctionRule rule = rule_of(operation);
  const Interval base = base_of(operand, frame.band_);
  const Interval slope = rule.slope(base);
  FrameLine line;
  line.constant = rule.value(base);
  if (operand.is_form_empty()) {
    return line;
  }
  if (!rigor::is_finite(slope) || !rigor::is_finite(line.constant)) {
    throw NoFrame("the steady state is at the border of an operation");
  }
  line = sum_of(line, scaled(form_of(operand), slope, std::nullopt), false);
  const auto form = static_cast<std::size_t>(add_form(frame, operand));
  const bool is_exponential = operation == FrameOperation::exponential;
  add_remainder(frame, line, rule.name,
                [rule, base, slope, form, is_exponential](const std::vector<double>& bounds) {
                  return is_exponential ? exponential_remainder(slope, bounds[form])
                                        : function_remainder(rule, base, bounds[form]);
                });
  return line;
}

}  // namespace veritrack::model
