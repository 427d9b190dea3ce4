// Conditions of the form left < right: the verdict, and a sentence with the reason.
#pragma once

#include <string>

#include "analysis/statements/derivation.hpp"

namespace veritrack::theorems {

/// One side of an inequality: its name in the reason, and its value. A literal (0 or 1) is named by its
/// value.
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

/// left < right, or left <= right. Needs the upward rounding mode.
[[nodiscard]] rigor::Verdict decide(const rigor::Interval& left, const rigor::Interval& right,
                                    Strictness strictness);

/// The reason for the verdict on left < right (or left <= right), in one sentence.
[[nodiscard]] std::string explain(const Side& left, const Side& right, rigor::Verdict verdict);

/// left < right (or left <= right), reported with its two sides. Needs the upward rounding
/// mode.
[[nodiscard]] Condition compare(std::string id, std::string statement, const Side& left, const Side& right,
                                Strictness strictness = Strictness::strict);

}  // namespace veritrack::theorems
