// Where the result of an operation is undefined: conditions that have to be 0 wherever the result is used.
#include <llvm/IR/InstrTypes.h>
#include <llvm/IR/Operator.h>

#include <cmath>

#include "lift/executor.hpp"

namespace veritrack::lift {

namespace {

using trackers::code::kBit;

constexpr const char* kOverflow = "an operation on signed integers does not overflow";

}  // namespace

/// Whether an operation on signed integers of one format overflows.
int Executor::overflow(unsigned opcode, const std::vector<int>& operands, int result) {
  const Format format = graph_.format(result);
  const int a = operands[0];
  const int b = operands[1];
  const auto differ_in_sign = [&](int x, int y) { return graph_.make(Operation::bit_xor, format, {x, y}); };
  const auto is_not = [&](int x, int y) { return graph_.make(Operation::icmp, kBit, {x, y}, Predicate::ne); };
  switch (opcode) {
    case llvm::Instruction::Add:
    case llvm::Instruction::Sub: {
      const int before = differ_in_sign(a, opcode == llvm::Instruction::Add ? result : b);
      const int after = differ_in_sign(opcode == llvm::Instruction::Add ? b : a, result);
      return graph_.make(
          Operation::icmp, kBit,
          {graph_.make(Operation::bit_and, format, {before, after}), graph_.constant(format, 0)},
          Predicate::slt);
    }
    case llvm::Instruction::Mul: {
      if (format.bits > 32) {  // no format holds all products: factors of 32 bits are safe
        const auto is_long = [&](int x) {
          const int low = graph_.make(Operation::integer_trunc, {false, 32}, {x});
          return is_not(x, graph_.make(Operation::sext, format, {low}));
        };
        return graph_.make(Operation::bit_or, kBit, {is_long(a), is_long(b)});
      }
      const Format wide{false, 64};
      const auto widened = [&](int x) { return graph_.make(Operation::sext, wide, {x}); };
      return is_not(graph_.make(Operation::mul, wide, {widened(a), widened(b)}), widened(result));
    }
    default:  // a shift to the left
      return is_not(a, graph_.make(Operation::ashr, format, {result, b}));
  }
}

/// Whether an integer format does not hold a number without its fraction.
int Executor::out_of_range(const llvm::Instruction& instruction, int number, int result) {
  const bool is_signed = instruction.getOpcode() == llvm::Instruction::FPToSI;
  const int bits = graph_.format(result).bits;
  const Format format = graph_.format(number);
  const double low = is_signed ? -std::ldexp(1.0, bits - 1) : 0.0;
  const double high = std::ldexp(1.0, is_signed ? bits - 1 : bits);
  // Numbers between low - 1 and low are cut to low; a format without such numbers has no low - 1.
  const int one_below = graph_.number(format, low - 1.0);
  const bool has_one_below = trackers::code::number_of(format, graph_.bits(one_below)) == low - 1.0;
  const int is_below = has_one_below ? graph_.make(Operation::fcmp, kBit, {number, one_below}, Predicate::ule)
                                     : graph_.make(Operation::fcmp, kBit,
                                                   {number, graph_.number(format, low)}, Predicate::ult);
  const int is_above =
      graph_.make(Operation::fcmp, kBit, {number, graph_.number(format, high)}, Predicate::uge);
  return graph_.make(Operation::bit_or, kBit, {is_below, is_above});
}

void Executor::require_defined(const llvm::Instruction& instruction, const std::vector<int>& operands,
                               int result) {
  const unsigned opcode = instruction.getOpcode();
  using Op = llvm::Instruction;
  const auto is_zero = [&](int x) {
    return graph_.make(Operation::icmp, kBit, {x, graph_.constant(graph_.format(x), 0)}, Predicate::eq);
  };
  switch (opcode) {
    case Op::UDiv:
    case Op::URem:
    case Op::SDiv:
    case Op::SRem:
      require_zero(is_zero(operands[1]), "an integer is not divided by 0");
      if (opcode == Op::SDiv || opcode == Op::SRem) {
        const Format format = graph_.format(result);
        const int lowest =
            graph_.constant(format, std::uint64_t{1} << static_cast<unsigned>(format.bits - 1));
        const int minus_one = graph_.constant(format, ~std::uint64_t{0});
        const int is_lowest = graph_.make(Operation::icmp, kBit, {operands[0], lowest}, Predicate::eq);
        const int is_minus_one = graph_.make(Operation::icmp, kBit, {operands[1], minus_one}, Predicate::eq);
        require_zero(graph_.both(is_lowest, is_minus_one), kOverflow);
      }
      return;
    case Op::FPToSI:
    case Op::FPToUI:
      require_zero(out_of_range(instruction, operands[0], result),
                   "a number that becomes an integer is in its range", result);
      return;
    case Op::Shl:
    case Op::LShr:
    case Op::AShr: {
      const Format format = graph_.format(result);
      const int bits = graph_.constant(format, static_cast<std::uint64_t>(format.bits));
      require_zero(graph_.make(Operation::icmp, kBit, {operands[1], bits}, Predicate::uge),
                   "an integer is shifted by less than its bits", result);
      break;
    }
    default:
      break;
  }
  const auto* can_overflow = llvm::dyn_cast<llvm::OverflowingBinaryOperator>(&instruction);
  if (can_overflow != nullptr && can_overflow->hasNoSignedWrap()) {
    require_zero(overflow(opcode, operands, result), kOverflow, result);
  }
}

}  // namespace veritrack::lift
