#include "analysis/statements/comparison.hpp"

#include <utility>

#include "analysis/rigor/decimal.hpp"

namespace veritrack::theorems {

using rigor::Interval;
using rigor::Verdict;

namespace {

constexpr int kDigits = 6;

std::string not_known(const std::string& words) {
  return words + " is undefined, or overflows, for the values of this design.";
}

}  // namespace

Side zero() {
  return {"0", Interval(0.0), true};
}
Side one() {
  return {"1", Interval(1.0), true};
}

std::string at_least(const Interval& x) {
  return rigor::lower_decimal(x, kDigits);
}
std::string at_most(const Interval& x) {
  return rigor::upper_decimal(x, kDigits);
}
std::string enclosed(const Interval& x) {
  const std::string lower = at_least(x);
  return lower == at_most(x) ? lower : rigor::to_decimal(x, kDigits);
}

Verdict decide(const Interval& left, const Interval& right, Strictness strictness) {
  return strictness == Strictness::strict ? decide_less(left, right) : decide_less_equal(left, right);
}

std::string explain(const Side& left, const Side& right, Verdict verdict) {
  if (verdict == Verdict::undecided) {
    if (!is_finite(left.value) || !is_finite(right.value)) {
      return not_known(is_finite(left.value) ? right.words : left.words);
    }
    const auto shown = [](const Side& side) {
      return side.is_literal ? side.words : side.words + " in " + enclosed(side.value);
    };
    return shown(left) + " and " + shown(right) + " cannot be separated.";
  }
  const bool holds = verdict == Verdict::proved;
  const std::string left_end =
      holds ? " at most " + at_most(left.value) : " at least " + at_least(left.value);
  const std::string right_end =
      holds ? " at least " + at_least(right.value) : " at most " + at_most(right.value);
  if (left.is_literal) {
    return right.words + " is" + right_end + ".";
  }
  if (right.is_literal) {
    return left.words + " is" + left_end + ".";
  }
  return left.words + " is" + left_end + (holds ? " and " : " but ") + right.words + right_end + ".";
}

Condition compare(std::string id, std::string statement, const Side& left, const Side& right,
                  Strictness strictness) {
  const Verdict verdict = decide(left.value, right.value, strictness);
  return {std::move(id), std::move(statement), verdict,
          left.value,    right.value,          explain(left, right, verdict)};
}

}  // namespace veritrack::theorems
