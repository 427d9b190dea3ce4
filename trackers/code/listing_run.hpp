// A listing, run bit by bit: what the compiled program computes where nothing is fused.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "trackers/code/listing.hpp"

namespace veritrack::trackers::code {

/// The result of an operation that is undefined for its operands.
class UndefinedOperation : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

namespace detail {

template <typename Real>
[[nodiscard]] Real number_as(std::uint64_t bits) {
  if constexpr (sizeof(Real) == 4) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
  } else {
    return std::bit_cast<double>(bits);
  }
}
[[nodiscard]] inline std::uint64_t as_bits(float value) {
  return std::bit_cast<std::uint32_t>(value);
}
[[nodiscard]] inline std::uint64_t as_bits(double value) {
  return std::bit_cast<std::uint64_t>(value);
}

/// An operation on numbers of one format whose result has the same.
template <typename Real>
[[nodiscard]] Real on_numbers(Operation operation, Real a, Real b, Real c) {
  switch (operation) {
    case Operation::fadd:
      return a + b;
    case Operation::fsub:
      return a - b;
    case Operation::fmul:
      return a * b;
    case Operation::fdiv:
      return a / b;
    case Operation::fneg:
      return -a;
    case Operation::fma:
      return std::fma(a, b, c);
    case Operation::sqrt:
      return std::sqrt(a);
    case Operation::fabs:
      return std::fabs(a);
    case Operation::floor:
      return std::floor(a);
    case Operation::ceil:
      return std::ceil(a);
    case Operation::trunc:
      return std::trunc(a);
    case Operation::rint:
      return std::nearbyint(a);
    case Operation::round:
      return std::round(a);
    case Operation::fmin:
      return std::fmin(a, b);
    case Operation::fmax:
      return std::fmax(a, b);
    case Operation::copysign:
      return std::copysign(a, b);
    case Operation::fmod:
      return std::fmod(a, b);
    case Operation::sin:
      return std::sin(a);
    case Operation::cos:
      return std::cos(a);
    case Operation::tan:
      return std::tan(a);
    case Operation::asin:
      return std::asin(a);
    case Operation::acos:
      return std::acos(a);
    case Operation::atan:
      return std::atan(a);
    case Operation::atan2:
      return std::atan2(a, b);
    case Operation::exp:
      return std::exp(a);
    case Operation::log:
      return std::log(a);
    case Operation::pow:
      return std::pow(a, b);
    case Operation::hypot:
      return std::hypot(a, b);
    case Operation::tanh:
      return std::tanh(a);
    default:
      throw std::invalid_argument("an operation that is none of numbers");
  }
}

/// Whether a comparison of numbers holds.
[[nodiscard]] inline bool holds(Predicate predicate, double a, double b) {
  const bool unordered = std::isnan(a) || std::isnan(b);
  switch (predicate) {
    case Predicate::oeq:
      return a == b;
    case Predicate::one:
      return a < b || a > b;
    case Predicate::olt:
      return a < b;
    case Predicate::ole:
      return a <= b;
    case Predicate::ogt:
      return a > b;
    case Predicate::oge:
      return a >= b;
    case Predicate::ord:
      return !unordered;
    case Predicate::ueq:
      return unordered || a == b;
    case Predicate::une:
      return unordered || a != b;
    case Predicate::ult:
      return unordered || a < b;
    case Predicate::ule:
      return unordered || a <= b;
    case Predicate::ugt:
      return unordered || a > b;
    case Predicate::uge:
      return unordered || a >= b;
    case Predicate::uno:
      return unordered;
    default:
      throw std::invalid_argument("a predicate that is none of numbers");
  }
}

/// Whether a comparison of integers holds.
[[nodiscard]] inline bool holds(Predicate predicate, Format format, std::uint64_t a, std::uint64_t b) {
  const std::int64_t x = signed_value(format, a);
  const std::int64_t y = signed_value(format, b);
  switch (predicate) {
    case Predicate::eq:
      return a == b;
    case Predicate::ne:
      return a != b;
    case Predicate::ult:
      return a < b;
    case Predicate::ule:
      return a <= b;
    case Predicate::ugt:
      return a > b;
    case Predicate::uge:
      return a >= b;
    case Predicate::slt:
      return x < y;
    case Predicate::sle:
      return x <= y;
    case Predicate::sgt:
      return x > y;
    case Predicate::sge:
      return x >= y;
    default:
      throw std::invalid_argument("a predicate that is none of integers");
  }
}

/// An operation on integers of one format, modulo 2^bits. Throws UndefinedOperation.
[[nodiscard]] inline std::uint64_t on_integers(Operation operation, Format format, std::uint64_t a,
                                               std::uint64_t b) {
  const std::int64_t x = signed_value(format, a);
  const std::int64_t y = signed_value(format, b);
  const bool divides = operation == Operation::udiv || operation == Operation::sdiv ||
                       operation == Operation::urem || operation == Operation::srem;
  const bool shifts =
      operation == Operation::shl || operation == Operation::lshr || operation == Operation::ashr;
  const bool overflows = y == -1 && x == (std::int64_t{-1} << static_cast<unsigned>(format.bits - 1));
  if ((divides && b == 0) || (shifts && b >= static_cast<std::uint64_t>(format.bits)) ||
      ((operation == Operation::sdiv || operation == Operation::srem) && overflows)) {
    throw UndefinedOperation("an operation on integers is not defined here");
  }
  switch (operation) {
    case Operation::add:
      return wrapped(format, a + b);
    case Operation::sub:
      return wrapped(format, a - b);
    case Operation::mul:
      return wrapped(format, a * b);
    case Operation::udiv:
      return a / b;
    case Operation::urem:
      return a % b;
    case Operation::sdiv:
      return wrapped(format, static_cast<std::uint64_t>(x / y));
    case Operation::srem:
      return wrapped(format, static_cast<std::uint64_t>(x % y));
    case Operation::bit_and:
      return a & b;
    case Operation::bit_or:
      return a | b;
    case Operation::bit_xor:
      return a ^ b;
    case Operation::shl:
      return wrapped(format, a << b);
    case Operation::lshr:
      return a >> b;
    case Operation::ashr:
      return wrapped(format, static_cast<std::uint64_t>(x >> b));
    default:
      throw std::invalid_argument("an operation that is none of integers");
  }
}

/// A number as an integer, toward 0. Throws UndefinedOperation where it is out of range.
[[nodiscard]] inline std::uint64_t to_integer(Operation operation, Format format, double number) {
  const double whole = std::trunc(number);
  const bool is_signed = operation == Operation::fptosi;
  const double limit = std::ldexp(1.0, is_signed ? format.bits - 1 : format.bits);
  const bool fits = whole < limit && (is_signed ? whole >= -limit : whole >= 0.0);
  if (!fits) {
    throw UndefinedOperation("a number is converted to an integer that does not hold it");
  }
  return is_signed ? wrapped(format, static_cast<std::uint64_t>(static_cast<std::int64_t>(whole)))
                   : static_cast<std::uint64_t>(whole);
}

/// An integer rounded to a number.
[[nodiscard]] inline std::uint64_t to_number(Format format, Format from, bool is_signed, std::uint64_t bits) {
  const std::int64_t x = signed_value(from, bits);
  if (format.bits == 32) {
    return as_bits(is_signed ? static_cast<float>(x) : static_cast<float>(bits));
  }
  return as_bits(is_signed ? static_cast<double>(x) : static_cast<double>(bits));
}

}  // namespace detail

/// The bits of one operation, from those of its operands and their formats. Needs rounding to nearest. Throws
/// UndefinedOperation. Not of inputs, tables.
[[nodiscard]] inline std::uint64_t value_of(const Instruction& instruction,
                                            std::span<const std::uint64_t> operands,
                                            std::span<const Format> formats) {
  const std::uint64_t a = operands.empty() ? 0 : operands[0];
  const std::uint64_t b = operands.size() > 1 ? operands[1] : 0;
  const std::uint64_t c = operands.size() > 2 ? operands[2] : 0;
  const Format from = formats.empty() ? Format{} : formats[0];
  switch (instruction.operation) {
    case Operation::constant:
      return instruction.bits;
    case Operation::fpext:
    case Operation::fptrunc:
      return bits_of(instruction.format, number_of(from, a));
    case Operation::sitofp:
    case Operation::uitofp:
      return detail::to_number(instruction.format, from, instruction.operation == Operation::sitofp, a);
    case Operation::fptosi:
    case Operation::fptoui:
      return detail::to_integer(instruction.operation, instruction.format, number_of(from, a));
    case Operation::zext:
    case Operation::bits:
      return a;
    case Operation::sext:
      return wrapped(instruction.format, static_cast<std::uint64_t>(signed_value(from, a)));
    case Operation::integer_trunc:
      return wrapped(instruction.format, a);
    case Operation::fcmp:
      return detail::holds(instruction.predicate, number_of(from, a), number_of(from, b)) ? 1 : 0;
    case Operation::icmp:
      return detail::holds(instruction.predicate, from, a, b) ? 1 : 0;
    case Operation::select:
      return a != 0 ? b : c;
    default:
      break;
  }
  if (!instruction.format.is_float) {
    return detail::on_integers(instruction.operation, instruction.format, a, b);
  }
  using detail::as_bits, detail::number_as, detail::on_numbers;
  if (instruction.format.bits == 32) {
    return as_bits(
        on_numbers(instruction.operation, number_as<float>(a), number_as<float>(b), number_as<float>(c)));
  }
  return as_bits(
      on_numbers(instruction.operation, number_as<double>(a), number_as<double>(b), number_as<double>(c)));
}

/// All registers of a listing, for states and samples given as bits. The result of an operation that is not
/// defined is 0: the obligations say that it is not used.
[[nodiscard]] inline std::vector<std::uint64_t> run(const Listing& listing,
                                                    std::span<const std::uint64_t> states,
                                                    std::span<const std::uint64_t> samples) {
  if (states.size() != listing.states.size() || samples.size() != listing.samples.size()) {
    throw std::invalid_argument("wrong number of states or samples of a listing");
  }
  std::vector<std::uint64_t> registers(listing.instructions.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    registers[static_cast<std::size_t>(listing.states[i].input)] = states[i];
  }
  for (std::size_t i = 0; i < samples.size(); ++i) {
    registers[static_cast<std::size_t>(listing.samples[i])] = samples[i];
  }
  for (std::size_t i = 0; i < registers.size(); ++i) {
    const Instruction& instruction = listing.instructions[i];
    if (instruction.operation == Operation::input) {
      continue;
    }
    std::array<std::uint64_t, 3> values{};
    std::array<Format, 3> formats{};
    for (std::size_t k = 0; k < 3 && instruction.operands[k] >= 0; ++k) {
      const auto operand = static_cast<std::size_t>(instruction.operands[k]);
      values[k] = registers[operand];
      formats[k] = listing.instructions[operand].format;
    }
    if (instruction.operation == Operation::table) {
      const std::vector<std::uint64_t>& table = listing.tables[static_cast<std::size_t>(instruction.table)];
      registers[i] = values[0] < table.size() ? table[values[0]] : 0;
      continue;
    }
    try {
      registers[i] = value_of(instruction, values, formats);
    } catch (const UndefinedOperation&) {
      registers[i] = 0;
    }
  }
  return registers;
}

}  // namespace veritrack::trackers::code
