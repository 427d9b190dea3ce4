#include "certificates/code/comparisons.hpp"

namespace veritrack::certificates::code {

using trackers::code::Instruction;
using trackers::code::Operation;
using trackers::code::Predicate;

std::optional<double> Comparisons::number(int value) const {
  const Instruction& instruction = at(turns_->plain(value));
  if (instruction.operation != Operation::constant || !instruction.format.is_float) {
    return std::nullopt;
  }
  return trackers::code::number_of(instruction.format, instruction.bits);
}

std::optional<Less> Comparisons::less(int condition) const {
  const Instruction& instruction = at(condition);
  if (instruction.operation != Operation::fcmp) {
    return std::nullopt;
  }
  const auto& [a, b, unused] = instruction.operands;
  switch (instruction.predicate) {
    case Predicate::olt:
    case Predicate::ult:
      return Less{a, b, false};
    case Predicate::ogt:
    case Predicate::ugt:
      return Less{b, a, false};
    case Predicate::oge:
    case Predicate::uge:
      return Less{a, b, true};
    case Predicate::ole:
    case Predicate::ule:
      return Less{b, a, true};
    default:
      return std::nullopt;
  }
}

std::optional<Limited> Comparisons::with_limit(int inner, double limit, bool is_low) const {
  Limited result = limited(inner);
  std::optional<double>& same = is_low ? result.low : result.high;
  const std::optional<double>& other = is_low ? result.high : result.low;
  if (same || (other && (is_low ? limit >= *other : limit <= *other))) {
    return std::nullopt;
  }
  same = limit;
  return result;
}

Limited Comparisons::limited(int value) const {
  value = turns_->plain(value);
  const Instruction& instruction = at(value);
  const Limited itself{value, {}, {}};
  const auto& [a, b, c] = instruction.operands;
  if (instruction.operation == Operation::fmin || instruction.operation == Operation::fmax) {
    const std::optional<double> limit = number(a) ? number(a) : number(b);
    const int inner = number(a) ? b : a;
    return limit ? with_limit(inner, *limit, instruction.operation == Operation::fmax).value_or(itself)
                 : itself;
  }
  const std::optional<Less> comparison = instruction.operation == Operation::select ? less(a) : std::nullopt;
  if (!comparison) {
    return itself;
  }
  const int if_less = comparison->negated ? c : b;
  const int otherwise = comparison->negated ? b : c;
  // x < limit ? limit : x is at least the limit, x < limit ? x : limit at most, and likewise for limit < x.
  const bool limit_is_second = number(comparison->second).has_value();
  const std::optional<double> limit =
      limit_is_second ? number(comparison->second) : number(comparison->first);
  const int compared = turns_->plain(limit_is_second ? comparison->first : comparison->second);
  for (const bool takes_limit_if_less : {true, false}) {
    const std::optional<double> taken = number(takes_limit_if_less ? if_less : otherwise);
    const int inner = takes_limit_if_less ? otherwise : if_less;
    if (limit && taken && *taken == *limit && limited(inner).value == compared) {
      const bool is_low = limit_is_second == takes_limit_if_less;
      return with_limit(inner, *limit, is_low).value_or(itself);
    }
  }
  return itself;
}

}  // namespace veritrack::certificates::code
