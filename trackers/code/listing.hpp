// What a step of a C function computes, as a list of IEEE operations: no memory, no loops, no jumps.
//
// Symbolic execution of the compiled function makes such a list (lift/), certificates and their checker read
// it. An operation that appears twice with the same operands is listed once.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace veritrack::trackers::code {

/// The format of a value: binary32, binary64, or an integer of 1 to 64 bits.
struct Format {
  bool is_float = false;
  int bits = 0;

  friend bool operator==(const Format&, const Format&) = default;
};

inline constexpr Format kSingle{true, 32};
inline constexpr Format kDouble{true, 64};
inline constexpr Format kBit{false, 1};

/// The operations. Those named after functions of <math.h> are these functions in the format of the result.
enum class Operation : std::uint8_t {
  constant,  ///< `bits`
  input,     ///< a sample or a state
  // Of numbers, correctly rounded.
  fadd,
  fsub,
  fmul,
  fdiv,
  fneg,
  fma,
  sqrt,
  fpext,
  fptrunc,
  sitofp,
  uitofp,
  // Of numbers, exact.
  fabs,
  floor,
  ceil,
  trunc,
  rint,
  round,
  fmin,
  fmax,
  copysign,
  fmod,
  fptosi,  ///< undefined outside the range of the result
  fptoui,
  // Of the library of C, with an error of its own.
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  atan2,
  exp,
  log,
  pow,
  hypot,
  tanh,
  // Of integers, modulo 2^bits.
  add,
  sub,
  mul,
  udiv,
  sdiv,
  urem,
  srem,
  bit_and,
  bit_or,
  bit_xor,
  shl,
  lshr,
  ashr,
  zext,
  sext,
  integer_trunc,
  // Of both.
  bits,    ///< the same bits in another format
  fcmp,    ///< `predicate`
  icmp,    ///< `predicate`
  select,  ///< the second where the first is true, the third otherwise
  table    ///< an element of `tables[table]`, chosen by an integer
};

/// The predicates of comparisons: those of numbers are false (ordered) or true (unordered) where an operand
/// is not a number; those of integers are signed or unsigned.
enum class Predicate : std::uint8_t {
  none,
  oeq,
  one,
  olt,
  ole,
  ogt,
  oge,
  ord,
  ueq,
  une,
  ult,
  ule,
  ugt,
  uge,
  uno,
  eq,
  ne,
  slt,
  sle,
  sgt,
  sge
};

/// A place in the user's sources: a number of `Listing::files`, -1 where it is not known, and line and column
/// from 1.
struct Place {
  int file = -1;
  int line = 0;
  int column = 0;
};

/// One operation; its number in the list is its register. Operands are registers listed before, -1 where the
/// operation has fewer.
struct Instruction {
  Operation operation = Operation::constant;
  Format format;
  Predicate predicate = Predicate::none;
  std::array<int, 3> operands{-1, -1, -1};
  int table = -1;
  std::uint64_t bits = 0;  ///< of a constant: the number in its format, or the integer
  Place place;
};

/// A value that the program keeps from step to step.
struct State {
  std::string name;
  int input = -1;                ///< the register that holds it before the step
  int next = -1;                 ///< and after it
  std::uint64_t start_bits = 0;  ///< after `setup`
};

/// A register that has to be 0 (a bit) for the list to say what the program does, and why.
struct Obligation {
  int must_be_zero = -1;
  std::string why;
  Place place;
};

/// An atan2 that stands for what the program computes: the same angle up to whole turns, for samples that are
/// turned a little, and no larger than this.
struct NearArcTangent {
  int value = -1;
  double largest = 0.0;
};

struct Listing {
  std::vector<std::string> files;
  std::vector<Instruction> instructions;
  std::vector<std::vector<std::uint64_t>> tables;
  std::vector<int> library_tables;  ///< those whose elements a library has computed: another may differ
  std::vector<std::string> sample_names;
  std::vector<int> samples;  ///< registers
  std::vector<State> states;
  int frequency = -1;  ///< the register of the estimate, from the states before the step alone
  std::vector<Obligation> obligations;
  int steps_before = 0;  ///< the list says what steps do after the first ones, in which modes settle
  NearArcTangent near_arc_tangent;
};

/// The number of a register in the text of the listing, where a constant stands in place of its register.
[[nodiscard]] inline int number_in_text(const Listing& listing, int value) {
  int number = 0;
  for (int i = 0; i < value; ++i) {
    number += listing.instructions[static_cast<std::size_t>(i)].operation != Operation::constant ? 1 : 0;
  }
  return number;
}

/// The name and the number of operands of an operation.
struct OperationName {
  Operation operation;
  std::string_view name;
  int operands;
};

inline constexpr std::array kOperationNames{
    OperationName{Operation::fadd, "fadd", 2},
    OperationName{Operation::fsub, "fsub", 2},
    OperationName{Operation::fmul, "fmul", 2},
    OperationName{Operation::fdiv, "fdiv", 2},
    OperationName{Operation::fneg, "fneg", 1},
    OperationName{Operation::fma, "fma", 3},
    OperationName{Operation::sqrt, "sqrt", 1},
    OperationName{Operation::fpext, "fpext", 1},
    OperationName{Operation::fptrunc, "fptrunc", 1},
    OperationName{Operation::sitofp, "sitofp", 1},
    OperationName{Operation::uitofp, "uitofp", 1},
    OperationName{Operation::fabs, "fabs", 1},
    OperationName{Operation::floor, "floor", 1},
    OperationName{Operation::ceil, "ceil", 1},
    OperationName{Operation::trunc, "ftrunc", 1},
    OperationName{Operation::rint, "rint", 1},
    OperationName{Operation::round, "round", 1},
    OperationName{Operation::fmin, "fmin", 2},
    OperationName{Operation::fmax, "fmax", 2},
    OperationName{Operation::copysign, "copysign", 2},
    OperationName{Operation::fmod, "fmod", 2},
    OperationName{Operation::fptosi, "fptosi", 1},
    OperationName{Operation::fptoui, "fptoui", 1},
    OperationName{Operation::sin, "sin", 1},
    OperationName{Operation::cos, "cos", 1},
    OperationName{Operation::tan, "tan", 1},
    OperationName{Operation::asin, "asin", 1},
    OperationName{Operation::acos, "acos", 1},
    OperationName{Operation::atan, "atan", 1},
    OperationName{Operation::atan2, "atan2", 2},
    OperationName{Operation::exp, "exp", 1},
    OperationName{Operation::log, "log", 1},
    OperationName{Operation::pow, "pow", 2},
    OperationName{Operation::hypot, "hypot", 2},
    OperationName{Operation::tanh, "tanh", 1},
    OperationName{Operation::add, "add", 2},
    OperationName{Operation::sub, "sub", 2},
    OperationName{Operation::mul, "mul", 2},
    OperationName{Operation::udiv, "udiv", 2},
    OperationName{Operation::sdiv, "sdiv", 2},
    OperationName{Operation::urem, "urem", 2},
    OperationName{Operation::srem, "srem", 2},
    OperationName{Operation::bit_and, "and", 2},
    OperationName{Operation::bit_or, "or", 2},
    OperationName{Operation::bit_xor, "xor", 2},
    OperationName{Operation::shl, "shl", 2},
    OperationName{Operation::lshr, "lshr", 2},
    OperationName{Operation::ashr, "ashr", 2},
    OperationName{Operation::zext, "zext", 1},
    OperationName{Operation::sext, "sext", 1},
    OperationName{Operation::integer_trunc, "trunc", 1},
    OperationName{Operation::bits, "bits", 1},
    OperationName{Operation::fcmp, "fcmp", 2},
    OperationName{Operation::icmp, "icmp", 2},
    OperationName{Operation::select, "select", 3},
    OperationName{Operation::table, "table", 1},
};

/// The names of predicates, in their order; that of `none` is empty.
inline constexpr std::array<std::string_view, 21> kPredicateNames{
    "",    "oeq", "one", "olt", "ole", "ogt", "oge", "ord", "ueq", "une", "ult",
    "ule", "ugt", "uge", "uno", "eq",  "ne",  "slt", "sle", "sgt", "sge"};

[[nodiscard]] inline const OperationName* name_of(Operation operation) {
  for (const OperationName& name : kOperationNames) {
    if (name.operation == operation) {
      return &name;
    }
  }
  return nullptr;
}

/// The number that the bits are in a format of numbers.
[[nodiscard]] inline double number_of(Format format, std::uint64_t bits) {
  return format.bits == 32 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                           : std::bit_cast<double>(bits);
}

/// The bits of a number in a format of numbers, which it is rounded to.
[[nodiscard]] inline std::uint64_t bits_of(Format format, double number) {
  return format.bits == 32 ? std::bit_cast<std::uint32_t>(static_cast<float>(number))
                           : std::bit_cast<std::uint64_t>(number);
}

/// The lowest bits of an integer format.
[[nodiscard]] inline std::uint64_t wrapped(Format format, std::uint64_t value) {
  return format.bits >= 64 ? value : value & ((std::uint64_t{1} << static_cast<unsigned>(format.bits)) - 1);
}

/// An integer with its sign.
[[nodiscard]] inline std::int64_t signed_value(Format format, std::uint64_t bits) {
  const auto unused = static_cast<unsigned>(64 - format.bits);
  return static_cast<std::int64_t>(bits << unused) >> unused;
}

}  // namespace veritrack::trackers::code
