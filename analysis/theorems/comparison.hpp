// Conditions of the form left < right: the verdict, and the sentence that says what decided it.
#pragma once

#include <string>

#include "analysis/theorems/derivation.hpp"

namespace veritrack::theorems {

/// One side of an inequality: how the reason calls it, and what it is. A literal (0 or 1) is its own value.
struct Side {
  std::string words;
  rigor::Interval value;
  bool is_literal = false;
};

[[nodiscard]] Side zero();
[[nodiscard]] Side one();

/// The lower end as a decimal, rounded down; the upper end, rounded up. Six digits.
[[nodiscard]] std::string at_least(const rigor::Interval& x);
[[nodiscard]] std::string at_most(const rigor::Interval& x);
/// "[lower, upper]", outward-rounded to six digits, or one decimal where that is exact.
[[nodiscard]] std::string enclosed(const rigor::Interval& x);

enum class Strictness { strict, weak };

/// left < right, or left <= right. Needs the held rounding mode.
[[nodiscard]] rigor::Verdict decide(const rigor::Interval& left, const rigor::Interval& right,
                                    Strictness strictness);

/// What decided left < right (or left <= right), in one sentence.
[[nodiscard]] std::string explain(const Side& left, const Side& right, rigor::Verdict verdict);

/// left < right (or left <= right), reported with the two sides that decided it. Needs the held rounding
/// mode.
[[nodiscard]] Condition compare(std::string id, std::string statement, const Side& left, const Side& right,
                                Strictness strictness = Strictness::strict);

}  // namespace veritrack::theorems
