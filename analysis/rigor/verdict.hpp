// Verdict: the result of a finite computation with outward-rounded arithmetic about a statement.
#pragma once

#include <initializer_list>
#include <string_view>

#include "analysis/rigor/interval.hpp"

namespace veritrack::rigor {

/// PROVED: the computation shows the statement. REFUTED: it shows the negation. UNDECIDED: neither. It is the
/// first value, so that a verdict that was never set claims nothing.
enum class Verdict { undecided, proved, refuted };

/// "proved", "refuted" or "undecided".
[[nodiscard]] std::string_view to_string(Verdict verdict) noexcept;

/// Is a < b, for all points of the two operands? REFUTED means a >= b for all points. UNDECIDED when the
/// operands overlap, are empty or are unbounded. Throws RoundingModeError unless the upward mode is held.
[[nodiscard]] Verdict decide_less(const Interval& a, const Interval& b);

/// Is a <= b, for all points of the two operands? As decide_less.
[[nodiscard]] Verdict decide_less_equal(const Interval& a, const Interval& b);

/// The conjunction: PROVED when all are PROVED, REFUTED when one is REFUTED, else UNDECIDED. The empty
/// conjunction is UNDECIDED, although logic would call it true: nothing was examined.
[[nodiscard]] Verdict conjunction(std::initializer_list<Verdict> verdicts) noexcept;
template <typename Range>
[[nodiscard]] Verdict conjunction(const Range& verdicts) noexcept {
  bool any = false;
  bool all_proved = true;
  for (const Verdict verdict : verdicts) {
    if (verdict == Verdict::refuted) {
      return Verdict::refuted;
    }
    any = true;
    all_proved = all_proved && verdict == Verdict::proved;
  }
  return any && all_proved ? Verdict::proved : Verdict::undecided;
}

}  // namespace veritrack::rigor
