#include "analysis/model/tube/angle_check.hpp"

#include <cmath>
#include <cstddef>
#include <optional>

namespace veritrack::model {

namespace {

using rigor::Interval;
using trackers::Instruction;
using trackers::Operation;
using trackers::StraightLineProgram;

/// The number of turns by which a value changes for a turn of each input: a whole number each; empty where
/// the change is not a whole number of turns of the inputs.
using Turns = std::optional<std::vector<long>>;

/// The whole number that the interval is exactly.
std::optional<long> whole_number(const Interval& x) {
  constexpr double kMost = 1000.0;
  const bool is_whole =
      x.lower() == x.upper() && std::floor(x.lower()) == x.lower() && std::fabs(x.lower()) <= kMost;
  return is_whole ? std::optional(static_cast<long>(x.lower())) : std::nullopt;
}

bool does_not_turn(const Turns& turns) {
  if (!turns) {
    return false;
  }
  for (const long each : *turns) {
    if (each != 0) {
      return false;
    }
  }
  return true;
}

/// factor_a a + factor_b b.
Turns combined(const Turns& a, long factor_a, const Turns& b, long factor_b) {
  if (!a || !b) {
    return std::nullopt;
  }
  constexpr long kMost = 1'000'000;
  std::vector<long> sum(a->size());
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] = factor_a * (*a)[i] + factor_b * (*b)[i];
    if (std::labs(sum[i]) > kMost) {
      return std::nullopt;
    }
  }
  return sum;
}

/// The turns of all registers; `inputs` those of the inputs, of which the first are constants.
std::vector<Turns> turns_of(const StraightLineProgram& program, const std::vector<Interval>& constants,
                            std::vector<Turns> registers, std::size_t count) {
  const Turns still = std::vector<long>(count, 0);
  for (const Instruction& instruction : program.instructions()) {
    const auto operand = [&](int place) -> const Turns& {
      return registers[static_cast<std::size_t>(place)];
    };
    const auto constant = [&](int place) -> std::optional<long> {
      const auto number = static_cast<std::size_t>(place);
      return number < constants.size() ? whole_number(constants[number]) : std::nullopt;
    };
    Turns result = still;
    for (const int place : {instruction.first, instruction.second, instruction.third}) {
      if (place >= 0 && !does_not_turn(operand(place))) {
        result = std::nullopt;  // unless the operation is one of those below
      }
    }
    switch (instruction.operation) {
      case Operation::add:
        result = combined(operand(instruction.first), 1, operand(instruction.second), 1);
        break;
      case Operation::subtract:
        result = combined(operand(instruction.first), 1, operand(instruction.second), -1);
        break;
      case Operation::negate:
        result = combined(operand(instruction.first), -1, still, 0);
        break;
      case Operation::multiply:
        if (!result && constant(instruction.first)) {
          result = combined(operand(instruction.second), *constant(instruction.first), still, 0);
        } else if (!result && constant(instruction.second)) {
          result = combined(operand(instruction.first), *constant(instruction.second), still, 0);
        }
        break;
      case Operation::sin:
      case Operation::cos:
      case Operation::tan:
        result = operand(instruction.first) ? still : Turns(std::nullopt);
        break;
      default:
        break;
    }
    registers.push_back(std::move(result));
  }
  return registers;
}

std::vector<Turns> still_inputs(int inputs, std::size_t count) {
  return std::vector<Turns>(static_cast<std::size_t>(inputs), std::vector<long>(count, 0));
}

/// Traces a register that depends on whole turns back to its origin.
int origin_of(const StraightLineProgram& program, const std::vector<Turns>& registers, int place) {
  for (;;) {
    if (place < program.inputs() || registers[static_cast<std::size_t>(place)]) {
      return place;
    }
    const Instruction& made =
        program.instructions()[static_cast<std::size_t>(place) - static_cast<std::size_t>(program.inputs())];
    int earlier = -1;
    for (const int operand : {made.third, made.second, made.first}) {
      earlier = operand >= 0 && !registers[static_cast<std::size_t>(operand)] ? operand : earlier;
    }
    if (earlier < 0) {
      return place;
    }
    place = earlier;
  }
}

}  // namespace

std::optional<TurnObjection> find_turn_objection(const trackers::Recursion& recursion,
                                                 const std::vector<Interval>& constants) {
  const auto states = static_cast<std::size_t>(recursion.states);
  const auto first_state = static_cast<std::size_t>(recursion.constants);
  const auto with_angles = [&](const StraightLineProgram& program) {
    std::vector<Turns> inputs = still_inputs(program.inputs(), states);
    for (std::size_t i = 0; i < states; ++i) {
      (*inputs[first_state + i])[i] = recursion.is_angle[i] ? 1 : 0;
    }
    return turns_of(program, constants, std::move(inputs), states);
  };
  const std::vector<Turns> of_step = with_angles(recursion.step);
  for (std::size_t i = 0; i < states; ++i) {
    std::vector<long> expected(states, 0);
    expected[i] = recursion.is_angle[i] ? 1 : 0;
    const int place = recursion.step.results()[i];
    const Turns& found = of_step[static_cast<std::size_t>(place)];
    if (!found || *found != expected) {
      return TurnObjection{static_cast<int>(i), origin_of(recursion.step, of_step, place)};
    }
  }
  const std::vector<Turns> of_frequency = with_angles(recursion.frequency);
  const int place = recursion.frequency.results().front();
  return does_not_turn(of_frequency[static_cast<std::size_t>(place)])
             ? std::nullopt
             : std::optional(TurnObjection{-1, origin_of(recursion.frequency, of_frequency, place)});
}

std::string angle_objection(const trackers::Recursion& recursion, const std::vector<Interval>& constants) {
  const auto states = static_cast<std::size_t>(recursion.states);
  if (constants.size() != static_cast<std::size_t>(recursion.constants) ||
      recursion.is_angle.size() != states) {
    return "the constants or the list of angles do not fit the recursion";
  }
  const std::optional<TurnObjection> objection = find_turn_objection(recursion, constants);
  if (!objection) {
    return {};
  }
  if (objection->state < 0) {
    return "the frequency depends on whole turns of an angle";
  }
  return "the next value of state number " + std::to_string(objection->state + 1) +
         (recursion.is_angle[static_cast<std::size_t>(objection->state)]
              ? " does not turn as the angle does"
              : " depends on whole turns of an angle");
}

bool is_periodic(const StraightLineProgram& signal, const std::vector<Interval>& constants) {
  if (signal.inputs() != static_cast<int>(constants.size()) + 2 || signal.results().empty()) {
    return false;
  }
  std::vector<Turns> inputs = still_inputs(signal.inputs(), 1);
  (*inputs.back())[0] = 1;
  const std::vector<Turns> registers = turns_of(signal, constants, std::move(inputs), 1);
  for (const int place : signal.results()) {
    if (!does_not_turn(registers[static_cast<std::size_t>(place)])) {
      return false;
    }
  }
  return true;
}

}  // namespace veritrack::model
