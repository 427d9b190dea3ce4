#include "analysis/model/code/turns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace veritrack::model::code {

namespace {

using trackers::code::Instruction;
using trackers::code::Operation;
using trackers::code::Predicate;

constexpr std::size_t kMostPieces = 256;

bool is_whole_turns(double number) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double turns = std::round(number / kTurn);
  return turns != 0.0 && std::fabs(turns) <= 4.0 && std::fabs(number - turns * kTurn) <= kWrapSlack;
}

/// Of an odd number of half turns.
bool is_half_turns(double number) {
  return !is_whole_turns(number) && is_whole_turns(2.0 * number);
}

bool is_less(Predicate predicate) {
  return predicate == Predicate::olt || predicate == Predicate::ole || predicate == Predicate::ult ||
         predicate == Predicate::ule;
}
bool is_greater(Predicate predicate) {
  return predicate == Predicate::ogt || predicate == Predicate::oge || predicate == Predicate::ugt ||
         predicate == Predicate::uge;
}

}  // namespace

int Turns::plain(int value) const {
  while (true) {
    const Instruction& instruction = at(value);
    if (instruction.operation == Operation::fpext || instruction.operation == Operation::fptrunc) {
      value = instruction.operands[0];
      continue;
    }
    const bool is_choice = instruction.operation == Operation::select && instruction.format.is_float;
    const std::optional<bool> is_number =
        is_choice ? tests_for_numbers(instruction.operands[0]) : std::nullopt;
    if (!is_number) {
      return value;
    }
    value = instruction.operands[*is_number ? 1 : 2];
  }
}

std::optional<bool> Turns::tests_for_numbers(int condition) const {
  const Instruction& instruction = at(condition);
  if (instruction.operation == Operation::fcmp &&
      (instruction.predicate == Predicate::uno || instruction.predicate == Predicate::ord)) {
    return instruction.predicate == Predicate::ord;
  }
  if (instruction.operation == Operation::bit_xor &&
      at(instruction.operands[1]).operation == Operation::constant) {
    const std::optional<bool> inner = tests_for_numbers(instruction.operands[0]);
    return inner ? std::optional(*inner != (at(instruction.operands[1]).bits != 0)) : std::nullopt;
  }
  return std::nullopt;
}

std::pair<int, double> Turns::plain_with_roundings(int value) const {
  double roundings = 0.0;
  while (plain(value) != value) {
    const Instruction& instruction = at(value);
    roundings += instruction.operation == Operation::fptrunc ? unit_roundoff(instruction.format) : 0.0;
    const bool is_choice = instruction.operation == Operation::select;
    value = instruction.operands[is_choice ? (*tests_for_numbers(instruction.operands[0]) ? 1 : 2) : 0];
  }
  return {value, roundings};
}

std::optional<double> Turns::number(int value) const {
  const Instruction& instruction = at(value);  // behind a conversion it may be another one
  if (instruction.operation != Operation::constant || !instruction.format.is_float) {
    return std::nullopt;
  }
  return trackers::code::number_of(instruction.format, instruction.bits);
}

int Turns::without_turns(int value) {
  value = plain(value);
  const auto known = without_turns_.find(value);
  if (known != without_turns_.end()) {
    return known->second;
  }
  const Instruction& instruction = at(value);
  int result = value;
  if (const std::optional<Reduction> reduction = reduction_of(value)) {
    result = without_turns(reduction->argument);
  } else if (instruction.operation == Operation::select && instruction.format.is_float) {
    const int yes = without_turns(instruction.operands[1]);
    const int no = without_turns(instruction.operands[2]);
    result = yes == no ? yes : value;
  } else if (instruction.operation == Operation::fadd || instruction.operation == Operation::fsub) {
    const std::optional<double> turns = number(instruction.operands[1]);
    if (turns && is_whole_turns(*turns)) {
      result = without_turns(instruction.operands[0]);
    } else if (const std::optional<int> centred = centred_of(value)) {
      result = *centred;
    }
  }
  without_turns_[value] = result;
  return result;
}

/// Half a turn added, wrapped, and taken away again.
std::optional<int> Turns::centred_of(int value) {
  const auto half_turned = [&](int sum) {
    const Instruction& instruction = at(sum);
    const bool is_sum = instruction.operation == Operation::fadd || instruction.operation == Operation::fsub;
    const std::optional<double> constant = is_sum ? number(instruction.operands[1]) : std::nullopt;
    return constant && is_half_turns(*constant) ? std::optional(instruction.operands[0]) : std::nullopt;
  };
  const std::optional<int> behind = half_turned(value);
  const std::optional<int> moved =
      behind && is_wrapped(*behind) ? half_turned(without_turns(*behind)) : std::nullopt;
  return moved ? std::optional(without_turns(*moved)) : std::nullopt;
}

bool Turns::is_wrapped(int value) {
  const int behind = plain(value);
  return (at(behind).operation == Operation::select && without_turns(behind) != behind) ||
         reduction_of(behind).has_value() || centred_of(behind).has_value();
}

std::optional<Range> Turns::range(int value, int base, Range of_base) const {
  const auto parts = pieces(value, base, Part{of_base, {}, {}});
  if (!parts || parts->empty()) {
    return std::nullopt;
  }
  Range whole{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const auto& [part, shift] : *parts) {
    whole.low = std::min(whole.low, part.of_base.low + shift.by);
    whole.high = std::max(whole.high, part.of_base.high + shift.by);
  }
  return whole;
}

std::optional<std::vector<Turns::Shift>> Turns::shifts(int value, int base, Range of_base) const {
  const auto parts = pieces(value, base, Part{of_base, {}, {}});
  if (!parts || parts->empty()) {
    return std::nullopt;
  }
  std::vector<Shift> all;
  for (const Piece& piece : *parts) {
    all.push_back(piece.shift);
  }
  return all;
}

std::optional<std::vector<Turns::Piece>> Turns::pieces(int value, int base, const Part& part) const {
  const auto [behind, converted] = plain_with_roundings(value);
  value = behind;
  if (value == base) {
    return std::vector{Piece{part, {0.0, converted}}};
  }
  const Instruction& instruction = at(value);
  if (const std::optional<Reduction> reduction = reduction_of(value)) {
    auto parts = reduced(value, *reduction, base, part);
    for (std::size_t i = 0; parts && i < parts->size(); ++i) {
      (*parts)[i].shift.roundings += converted;
    }
    return parts;
  }
  if (instruction.operation == Operation::fadd || instruction.operation == Operation::fsub) {
    const std::optional<double> moved = number(instruction.operands[1]);
    auto parts = moved ? pieces(instruction.operands[0], base, part) : std::nullopt;
    if (parts) {
      for (Piece& piece : *parts) {
        piece.shift.by += instruction.operation == Operation::fadd ? *moved : -*moved;
        piece.shift.roundings += converted + unit_roundoff(instruction.format);
      }
    }
    return parts;
  }
  const auto truths =
      instruction.operation == Operation::select ? truth(instruction.operands[0], base, part) : std::nullopt;
  if (!truths) {
    return std::nullopt;
  }
  std::vector<Piece> all;
  for (const auto& [where, holds] : *truths) {
    const auto branch = pieces(instruction.operands[holds ? 1 : 2], base, where);
    if (!branch || all.size() > kMostPieces) {
      return std::nullopt;
    }
    for (Piece piece : *branch) {
      piece.shift.roundings += converted;
      all.push_back(std::move(piece));
    }
  }
  return all;
}

std::optional<Operation> Turns::counted(int value, int argument, double turn) const {
  const Instruction& count = at(plain(value));
  const Operation rounding = count.operation;
  if (rounding != Operation::rint && rounding != Operation::round && rounding != Operation::floor &&
      rounding != Operation::ceil && rounding != Operation::trunc) {
    return std::nullopt;
  }
  // A constant in single precision is off by 6e-8.
  constexpr double kOff = 2e-7;
  const Instruction& quotient = at(plain(count.operands[0]));
  const auto is_argument = [&](int operand) { return plain(operand) == plain(argument); };
  const auto is_near = [&](int operand, double factor) {
    const std::optional<double> constant = number(operand);
    return constant && std::fabs(*constant * factor - 1.0) <= kOff;
  };
  const bool divides = quotient.operation == Operation::fdiv && is_argument(quotient.operands[0]) &&
                       is_near(quotient.operands[1], 1.0 / turn);
  const bool multiplies = quotient.operation == Operation::fmul &&
                          ((is_argument(quotient.operands[0]) && is_near(quotient.operands[1], turn)) ||
                           (is_argument(quotient.operands[1]) && is_near(quotient.operands[0], turn)));
  return divides || multiplies ? std::optional(rounding) : std::nullopt;
}

std::optional<Turns::Reduction> Turns::reduction_of(int value) const {
  const Instruction& instruction = at(value);
  const auto is_turn = [](std::optional<double> number) {
    return number && std::fabs(*number - 2.0 * std::numbers::pi) <= kWrapSlack;
  };
  if (instruction.operation == Operation::fmod && is_turn(number(instruction.operands[1]))) {
    return Reduction{instruction.operands[0], Operation::trunc, *number(instruction.operands[1]), 0.0};
  }
  if (instruction.operation != Operation::fsub) {
    return std::nullopt;
  }
  const Instruction& product = at(instruction.operands[1]);  // in the format of the difference
  for (const std::size_t constant : {0U, 1U}) {
    const std::optional<double> turn =
        product.operation == Operation::fmul ? number(product.operands[constant]) : std::nullopt;
    const auto rounding = is_turn(turn)
                              ? counted(product.operands[1 - constant], instruction.operands[0], *turn)
                              : std::nullopt;
    if (rounding) {
      // The product is at most the sum of the argument and what is left of it.
      return Reduction{instruction.operands[0], *rounding, *turn, 3.0 * unit_roundoff(instruction.format)};
    }
  }
  return std::nullopt;
}

std::optional<std::vector<Turns::Piece>> Turns::reduced(int value, const Reduction& reduction, int base,
                                                        const Part& part) const {
  constexpr double kMostTurns = 3.0;  // a count next to where it changes is off by less than the slack
  const auto before = pieces(reduction.argument, base, part);
  if (!before) {
    return std::nullopt;
  }
  std::vector<Piece> all;
  for (const Piece& piece : *before) {
    const double low = piece.part.of_base.low + piece.shift.by;
    const double high = piece.part.of_base.high + piece.shift.by;
    if (!(low >= -kMostTurns * reduction.turn) || !(high <= kMostTurns * reduction.turn)) {
      return std::nullopt;
    }
    for (double count = -kMostTurns - 1.0; count <= kMostTurns + 1.0; ++count) {
      double begin = count - 0.5;
      double end = count + 0.5;
      if (reduction.rounding == Operation::floor) {
        begin = count;
        end = count + 1.0;
      } else if (reduction.rounding == Operation::ceil) {
        begin = count - 1.0;
        end = count;
      } else if (reduction.rounding == Operation::trunc) {
        begin = count > 0.0 ? count : count - 1.0;
        end = count < 0.0 ? count : count + 1.0;
      }
      const Range cut{std::max(piece.part.of_base.low, begin * reduction.turn - kWrapSlack - piece.shift.by),
                      std::min(piece.part.of_base.high, end * reduction.turn + kWrapSlack - piece.shift.by)};
      const auto known = piece.part.counted.find(value);
      if (cut.low <= cut.high && (known == piece.part.counted.end() || known->second == count)) {
        Piece left = piece;
        left.part.of_base = cut;
        left.part.counted[value] = count;
        left.shift.by -= count * reduction.turn;
        left.shift.roundings += reduction.roundings;
        all.push_back(std::move(left));
      }
    }
  }
  return all.size() <= kMostPieces ? std::optional(std::move(all)) : std::nullopt;
}

std::optional<std::vector<Turns::Truth>> Turns::truth(int condition, int base, const Part& part) const {
  const Instruction& instruction = at(condition);
  if (const std::optional<bool> is_number = tests_for_numbers(condition)) {
    return std::vector{Truth{part, *is_number}};
  }
  if (instruction.operation == Operation::constant) {
    return std::vector{Truth{part, instruction.bits != 0}};
  }
  if (instruction.operation == Operation::bit_xor &&
      at(instruction.operands[1]).operation == Operation::constant) {
    auto truths = truth(instruction.operands[0], base, part);
    if (truths && at(instruction.operands[1]).bits != 0) {
      for (Truth& each : *truths) {
        each.holds = !each.holds;
      }
    }
    return truths;
  }
  if (instruction.operation != Operation::bit_and && instruction.operation != Operation::bit_or) {
    return truth_of_comparison(condition, base, part);
  }
  const auto first = truth(instruction.operands[0], base, part);
  if (!first) {
    return std::nullopt;
  }
  std::vector<Truth> all;
  for (const Truth& each : *first) {
    if (each.holds != (instruction.operation == Operation::bit_and)) {
      all.push_back(each);  // the first has decided
      continue;
    }
    const auto second = truth(instruction.operands[1], base, each.part);
    if (!second || all.size() > kMostPieces) {
      return std::nullopt;
    }
    all.insert(all.end(), second->begin(), second->end());
  }
  return all;
}

std::optional<std::vector<Turns::Truth>> Turns::truth_of_comparison(int condition, int base,
                                                                    const Part& part) const {
  const Instruction& instruction = at(condition);
  if (instruction.operation != Operation::fcmp ||
      !(is_less(instruction.predicate) || is_greater(instruction.predicate))) {
    return std::nullopt;
  }
  if (const auto known = part.decided.find(condition); known != part.decided.end()) {
    return std::vector{Truth{part, known->second}};
  }
  const std::optional<double> limit = number(instruction.operands[1]);
  const auto parts = limit ? pieces(instruction.operands[0], base, part) : std::nullopt;
  if (!parts) {
    return std::nullopt;
  }
  std::vector<Truth> all;
  for (const Piece& piece : *parts) {
    const Part& where = piece.part;
    // Sums and conversions in single precision may be to the other side of a limit next to it.
    const double at_base = *limit - piece.shift.by;
    const auto add = [&](double low, double high, bool holds) {
      const Range cut{std::max(where.of_base.low, low), std::min(where.of_base.high, high)};
      if (cut.low <= cut.high) {
        all.push_back({{cut, where.decided, where.counted}, holds});
        all.back().part.decided[condition] = holds;
      }
    };
    const double infinity = std::numeric_limits<double>::infinity();
    add(-infinity, at_base + kWrapSlack / 4, is_less(instruction.predicate));
    add(at_base - kWrapSlack / 4, infinity, is_greater(instruction.predicate));
  }
  return all;
}

bool Turns::is_never(int condition, int base, Range of_base) const {
  const auto truths = truth(condition, base, Part{of_base, {}, {}});
  return truths && !truths->empty() &&
         std::none_of(truths->begin(), truths->end(), [](const Truth& each) { return each.holds; });
}

}  // namespace veritrack::model::code
