#include "analysis/rigor/quarter_turns.hpp"

#include <cstdint>

#include "analysis/rigor/sine_cosine_constants.hpp"

namespace veritrack::rigor::detail {

// The integers below are converted by truncation, which no rounding mode changes.

bool may_contain_quarter_turn(const Interval& x, int residue, int modulus) {
  constexpr double kExactlyConvertible = 0x1p+51;
  const Interval two_over_pi = Interval::from_bounds(kTwoOverPi.low, kTwoOverPi.high);
  const Interval turns = x * two_over_pi;  // contains n whenever x contains n pi/2
  const bool small = magnitude(turns) < kExactlyConvertible;
  if (!small) {
    return true;
  }
  const auto truncated_lower = static_cast<std::int64_t>(turns.lower());
  const auto truncated_upper = static_cast<std::int64_t>(turns.upper());
  const std::int64_t first = truncated_lower + (static_cast<double>(truncated_lower) < turns.lower() ? 1 : 0);
  const std::int64_t last = truncated_upper - (static_cast<double>(truncated_upper) > turns.upper() ? 1 : 0);
  const std::int64_t steps = (residue - first) % modulus;  // from `first` to the next one with this residue
  return first + (steps < 0 ? steps + modulus : steps) <= last;
}

}  // namespace veritrack::rigor::detail
