#include "lift/graph.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "lift/value.hpp"
#include "trackers/code/listing_run.hpp"

namespace veritrack::lift {

namespace {

using trackers::code::kBit;

constexpr std::size_t kMostOperations = 200'000;

bool is_of_library(Operation operation) {
  return operation >= Operation::sin && operation <= Operation::tanh;
}

/// Whether the result alone is undefined where the operation is: a value that may not be used. Divisions by 0
/// end the program.
bool only_result_is_undefined(Operation operation) {
  return operation == Operation::fptosi || operation == Operation::fptoui || operation == Operation::shl ||
         operation == Operation::lshr || operation == Operation::ashr;
}

}  // namespace

int Graph::put(Instruction instruction) {
  const Key key{instruction.operation,   instruction.format.is_float, instruction.format.bits,
                instruction.predicate,   instruction.operands[0],     instruction.operands[1],
                instruction.operands[2], instruction.table,           instruction.bits};
  const auto [place, is_new] = known_.try_emplace(key, static_cast<int>(instructions_.size()));
  if (is_new) {
    if (instructions_.size() >= kMostOperations) {
      throw LiftError("the function has more than 200,000 operations");
    }
    instruction.place = place_;
    instructions_.push_back(instruction);
  }
  return place->second;
}

int Graph::constant(Format format, std::uint64_t bits) {
  Instruction instruction;
  instruction.format = format;
  instruction.bits = format.is_float ? bits : trackers::code::wrapped(format, bits);
  return put(instruction);
}

int Graph::number(Format format, double value) {
  return constant(format, trackers::code::bits_of(format, value));
}

int Graph::input(Format format) {
  Instruction instruction;
  instruction.operation = Operation::input;
  instruction.format = format;
  instruction.bits = instructions_.size();  // no other input has it
  return put(instruction);
}

std::int64_t Graph::signed_bits(int value) const {
  return trackers::code::signed_value(format(value), bits(value));
}

int Graph::make(Operation operation, Format format, std::vector<int> operands, Predicate predicate) {
  Instruction instruction;
  instruction.operation = operation;
  instruction.format = format;
  instruction.predicate = predicate;
  std::copy(operands.begin(), operands.end(), instruction.operands.begin());
  const bool all_known =
      std::all_of(operands.begin(), operands.end(), [&](int operand) { return is_known(operand); });
  if (all_known && !is_of_library(operation)) {
    std::array<std::uint64_t, 3> values{};
    std::array<Format, 3> formats{};
    for (std::size_t k = 0; k < operands.size(); ++k) {
      values[k] = bits(operands[k]);
      formats[k] = this->format(operands[k]);
    }
    try {
      return constant(format, trackers::code::value_of(instruction, values, formats));
    } catch (const trackers::code::UndefinedOperation& error) {
      if (only_result_is_undefined(operation)) {
        return constant(format, 0);  // the executor requires that it is not used
      }
      throw LiftError(error.what());
    }
  }
  const int equal = simpler(instruction);
  return equal >= 0 ? equal : put(instruction);
}

int Graph::simpler(const Instruction& instruction) {
  const auto& [a, b, c] = instruction.operands;
  switch (instruction.operation) {
    case Operation::select:
      if (b == c) {
        return b;
      }
      if (is_known(a)) {
        return bits(a) != 0 ? b : c;
      }
      // A bit that says whether a bit is 1.
      return instruction.format == kBit && is_known(b) && is_known(c) ? (bits(b) != 0 ? a : negated(a)) : -1;
    case Operation::bits:
      return at(a).operation == Operation::bits && format(at(a).operands[0]) == instruction.format
                 ? at(a).operands[0]
                 : -1;
    case Operation::integer_trunc:
      return (at(a).operation == Operation::zext || at(a).operation == Operation::sext) &&
                     format(at(a).operands[0]) == instruction.format
                 ? at(a).operands[0]
                 : -1;
    case Operation::icmp:
      return simpler_comparison(instruction);
    default:
      return instruction.format.is_float || b < 0 ? -1 : simpler_of_integers(instruction);
  }
}

int Graph::simpler_of_integers(const Instruction& instruction) {
  const Operation operation = instruction.operation;
  if (instruction.format == kBit && operation == Operation::bit_and) {
    const auto [x, y, unused] = instruction.operands;
    if (x == y) {
      return x;
    }
    if (negated(x) == y || negated(y) == x) {
      return bit(false);
    }
  }
  for (const auto& [x, y] : {std::pair(instruction.operands[0], instruction.operands[1]),
                             std::pair(instruction.operands[1], instruction.operands[0])}) {
    const bool is_zero = is_known(y) && bits(y) == 0;
    const bool commutes = operation == Operation::add || operation == Operation::bit_or ||
                          operation == Operation::bit_xor || operation == Operation::bit_and;
    if (y == instruction.operands[0] && !commutes) {
      break;
    }
    if (operation == Operation::bit_and) {
      if (is_zero) {
        return y;
      }
      if (is_known(y) && bits(y) == trackers::code::wrapped(instruction.format, ~std::uint64_t{0})) {
        return x;
      }
    } else if (is_zero && (commutes || operation == Operation::sub || operation == Operation::shl ||
                           operation == Operation::lshr || operation == Operation::ashr)) {
      return x;
    } else if (instruction.format == kBit && operation == Operation::bit_or && is_known(y)) {
      return y;
    } else if (instruction.format == kBit && operation == Operation::bit_xor && is_known(y) &&
               at(x).operation == Operation::bit_xor && is_known(at(x).operands[1])) {
      return at(x).operands[0];
    }
  }
  return -1;
}

int Graph::simpler_comparison(const Instruction& instruction) {
  const auto& [a, b, unused] = instruction.operands;
  if (!is_known(b) || bits(b) != 0 ||
      (instruction.predicate != Predicate::eq && instruction.predicate != Predicate::ne)) {
    return -1;
  }
  if (at(a).operation != Operation::zext && at(a).operation != Operation::sext) {
    return -1;
  }
  const int widened = at(a).operands[0];
  if (format(widened) != kBit) {
    return -1;
  }
  return instruction.predicate == Predicate::ne ? widened : negated(widened);
}

int Graph::element(Format format, int index, const std::vector<std::uint64_t>& table, bool is_of_library) {
  Instruction instruction;
  instruction.operation = Operation::table;
  instruction.format = format;
  instruction.operands[0] = index;
  const auto found = std::find(tables_.begin(), tables_.end(), table);
  instruction.table = static_cast<int>(found - tables_.begin());
  if (found == tables_.end()) {
    tables_.push_back(table);
  }
  if (is_of_library) {
    tables_of_library_.insert(instruction.table);
  }
  return put(instruction);
}

int Graph::select(int condition, int yes, int no) {
  return make(Operation::select, format(yes), {condition, yes, no});
}

int Graph::negated(int condition) {
  return make(Operation::bit_xor, kBit, {condition, bit(true)});
}

int Graph::both(int a, int b) {
  return make(Operation::bit_and, kBit, {a, b});
}

int Graph::reinterpreted(int value, Format format) {
  return this->format(value) == format ? value : make(Operation::bits, format, {value});
}

bool Graph::is_free_of_inputs(int value) {
  // Operands come before what is made of them, so that one pass over the new ones is enough.
  for (auto i = free_of_inputs_.size(); i <= static_cast<std::size_t>(value); ++i) {
    const Instruction& instruction = instructions_[i];
    bool is_free = instruction.operation != Operation::input;
    for (const int operand : instruction.operands) {
      is_free = is_free && (operand < 0 || free_of_inputs_[static_cast<std::size_t>(operand)]);
    }
    free_of_inputs_.push_back(is_free);
  }
  return free_of_inputs_[static_cast<std::size_t>(value)];
}

std::uint64_t Graph::computed_here(int value) {
  std::vector<bool> needed(static_cast<std::size_t>(value) + 1, false);
  needed.back() = true;
  for (auto i = needed.size(); i-- > 0;) {
    for (const int operand : instructions_[i].operands) {
      if (needed[i] && operand >= 0) {
        needed[static_cast<std::size_t>(operand)] = true;
      }
    }
  }
  std::vector<std::uint64_t> computed(needed.size(), 0);
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (!needed[i]) {
      continue;
    }
    const Instruction& instruction = instructions_[i];
    std::array<std::uint64_t, 3> values{};
    std::array<Format, 3> formats{};
    for (std::size_t k = 0; k < 3 && instruction.operands[k] >= 0; ++k) {
      values[k] = computed[static_cast<std::size_t>(instruction.operands[k])];
      formats[k] = format(instruction.operands[k]);
    }
    computed[i] = instruction.operation == Operation::table
                      ? tables_[static_cast<std::size_t>(instruction.table)].at(values[0])
                      : trackers::code::value_of(instruction, values, formats);
  }
  return computed.back();
}

}  // namespace veritrack::lift
