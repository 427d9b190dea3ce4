// A calculation as a list of operations, to be run over any scalar.
//
// Formulas that a user writes become such a list, once. It is run over double to track, over intervals and
// ball models to prove, over dual numbers to differentiate: the list is never rewritten, so the certified
// program is the one that runs. An operation that appears twice with the same operands is listed once.
#pragma once

#include <cmath>
#include <compare>
#include <cstddef>
#include <map>
#include <span>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <vector>

#include "trackers/model/piecewise.hpp"
#include "trackers/scalar_functions.hpp"

namespace veritrack::trackers {

/// The operation of an instruction. `power` has an integer exponent of at least 0. `stays_within` (x, low,
/// high) is x, and says that low < x < high has to be shown wherever the program is used. `choose` (x, a, b)
/// is a where x > 0, and b elsewhere; operations of the other branch need not be defined.
enum class Operation {
  add,
  subtract,
  multiply,
  divide,
  negate,
  power,
  sqrt,
  exp,
  log,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  atan2,
  stays_within,
  minimum,
  maximum,
  absolute,
  sign,
  clamp,
  choose
};

/// One operation. Operands are numbers of registers, -1 where the operation has fewer; the exponent of
/// `power` stands in `exponent`, which is 0 otherwise.
struct Instruction {
  Operation operation{};
  int first = -1;
  int second = -1;
  int third = -1;
  int exponent = 0;

  // clang-tidy 14 takes the 0 of a comparison for a null pointer.
  friend auto operator<=>(const Instruction&,
                          const Instruction&) = default;  // NOLINT(modernize-use-nullptr)
};

namespace detail {

/// x^exponent by squaring, from the highest bit of the exponent down. x^0 is 1.
template <typename Scalar>
[[nodiscard]] Scalar integer_power(const Scalar& x, int exponent) {
  if (exponent == 0) {
    return Scalar(1);
  }
  int bit = 1;
  while (bit <= exponent / 2) {
    bit *= 2;
  }
  Scalar result = x;
  while (bit > 1) {
    bit /= 2;
    result = square(result);
    if ((exponent & bit) != 0) {
      result = result * x;
    }
  }
  return result;
}

/// x: for numbers, nothing has to be shown.
[[nodiscard]] inline double stays_within(double x, double /*low*/, double /*high*/) {
  return x;
}

/// x where something is known of `limit`, and nothing otherwise; of numbers x.
template <typename Scalar>
[[nodiscard]] Scalar where_known(const Scalar& x, [[maybe_unused]] const Scalar& limit) {
  if constexpr (std::is_floating_point_v<Scalar>) {
    return x;
  } else {
    const int none = 0;
    return x + Scalar(none) * limit;
  }
}

}  // namespace detail

/// The registers 0, ..., inputs() - 1 hold the inputs, and instruction i writes register inputs() + i. The
/// results are registers, in an order that belongs to the user of the program.
class StraightLineProgram {
 public:
  explicit StraightLineProgram(int inputs) : inputs_(inputs) {}

  /// The register that holds the result of this instruction: of an earlier equal one, if any. Throws
  /// std::invalid_argument when an operand is no register yet or the exponent is negative.
  int append(const Instruction& instruction) {
    for (const int operand : {instruction.first, instruction.second, instruction.third}) {
      if (operand >= registers() || operand < -1) {
        throw std::invalid_argument("an operand is not a register of the program");
      }
    }
    if (instruction.first < 0 || instruction.exponent < 0) {
      throw std::invalid_argument("an operation without operand, or with a negative exponent");
    }
    const auto [place, is_new] = known_.try_emplace(instruction, registers());
    if (is_new) {
      instructions_.push_back(instruction);
    }
    return place->second;
  }
  int append(Operation operation, int first, int second = -1, int third = -1) {
    return append({operation, first, second, third, 0});
  }
  void add_result(int result) { results_.push_back(result); }
  /// Where nothing is known of this register, nothing is known of the first result either: a limit that has
  /// to be shown, whatever needs it.
  void add_limit(int limit) { limits_.push_back(limit); }

  [[nodiscard]] int inputs() const { return inputs_; }
  [[nodiscard]] int registers() const { return inputs_ + static_cast<int>(instructions_.size()); }
  [[nodiscard]] const std::vector<Instruction>& instructions() const { return instructions_; }
  [[nodiscard]] const std::vector<int>& results() const { return results_; }
  [[nodiscard]] const std::vector<int>& limits() const { return limits_; }

  /// The results for these inputs. `registers` is working space: once it has grown, a run allocates nothing
  /// of its own. Functions of the scalar are found by argument-dependent lookup. Throws std::invalid_argument
  /// when the sizes do not fit.
  template <typename Scalar>
  void run(std::span<const Scalar> inputs, std::vector<Scalar>& registers, std::span<Scalar> results) const {
    if (inputs.size() != static_cast<std::size_t>(inputs_) || results.size() != results_.size()) {
      throw std::invalid_argument("wrong number of inputs or results of a program");
    }
    registers.assign(inputs.begin(), inputs.end());
    registers.reserve(static_cast<std::size_t>(this->registers()));
    for (const Instruction& instruction : instructions_) {
      registers.push_back(value_of(instruction, registers));
    }
    for (std::size_t i = 0; i < results.size(); ++i) {
      results[i] = registers[static_cast<std::size_t>(results_[i])];
    }
    for (const int limit : limits_) {
      results[0] = detail::where_known(results[0], registers[static_cast<std::size_t>(limit)]);
    }
  }

 private:
  template <typename Scalar>
  [[nodiscard]] static Scalar value_of(const Instruction& instruction, const std::vector<Scalar>& registers) {
    using detail::integer_power;
    using detail::stays_within, detail::minimum, detail::maximum, detail::absolute, detail::sign_of,
        detail::clamped, detail::chosen;
    using std::acos, std::asin, std::atan, std::atan2, std::cos, std::exp, std::log, std::sin, std::sqrt,
        std::tan;
    const auto operand = [&](int number) -> const Scalar& {
      return registers[static_cast<std::size_t>(number)];
    };
    const Scalar& a = operand(instruction.first);
    switch (instruction.operation) {
      case Operation::add:
        return a + operand(instruction.second);
      case Operation::subtract:
        return a - operand(instruction.second);
      case Operation::multiply:
        if (instruction.first == instruction.second) {
          using detail::square;
          return square(a);
        }
        return a * operand(instruction.second);
      case Operation::divide:
        return a / operand(instruction.second);
      case Operation::negate:
        return -a;
      case Operation::power:
        return integer_power(a, instruction.exponent);
      case Operation::sqrt:
        return sqrt(a);
      case Operation::exp:
        return exp(a);
      case Operation::log:
        return log(a);
      case Operation::sin:
        return sin(a);
      case Operation::cos:
        return cos(a);
      case Operation::tan:
        return tan(a);
      case Operation::asin:
        return asin(a);
      case Operation::acos:
        return acos(a);
      case Operation::atan:
        return atan(a);
      case Operation::atan2:
        return atan2(a, operand(instruction.second));
      case Operation::stays_within:
        return stays_within(a, operand(instruction.second), operand(instruction.third));
      case Operation::minimum:
        return minimum(a, operand(instruction.second));
      case Operation::maximum:
        return maximum(a, operand(instruction.second));
      case Operation::absolute:
        return absolute(a);
      case Operation::sign:
        return sign_of(a);
      case Operation::clamp:
        return clamped(a, operand(instruction.second), operand(instruction.third));
      case Operation::choose:
        return chosen(a, operand(instruction.second), operand(instruction.third));
    }
    throw std::invalid_argument("an operation that is not known");
  }

  int inputs_;
  std::vector<Instruction> instructions_;
  std::vector<int> results_;
  std::vector<int> limits_;
  std::map<Instruction, int> known_;
};

}  // namespace veritrack::trackers
