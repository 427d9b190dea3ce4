#include "certificates/model/operation_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>

#include "analysis/model/tube/angle_check.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/model/program_text.hpp"

namespace veritrack::certificates {

namespace {

using language::CompiledProgram;
using language::LanguageError;
using trackers::Operation;

constexpr std::size_t kShown = 80;  // bytes of a formula

/// The names of the inputs of a program: constants, states, and of a step the samples.
std::vector<std::string> inputs_of(const Model& model, bool with_samples) {
  std::vector<std::string> names;
  for (const language::Constant& constant : model.constants) {
    names.push_back(constant.name);
  }
  names.insert(names.end(), model.states.begin(), model.states.end());
  if (with_samples) {
    names.insert(names.end(), model.samples.begin(), model.samples.end());
  }
  return names;
}

/// The number of names and operations in a register's formula, written out down to named registers.
std::vector<double> lengths_of(const CompiledProgram& compiled) {
  std::vector<double> lengths(static_cast<std::size_t>(compiled.program.inputs()), 1.0);
  for (const trackers::Instruction& made : compiled.program.instructions()) {
    double length = 1.0;
    for (const int operand : {made.first, made.second, made.third}) {
      if (operand >= 0) {
        length += compiled.names.contains(operand) ? 1.0 : lengths[static_cast<std::size_t>(operand)];
      }
    }
    lengths.push_back(length);
  }
  return lengths;
}

/// The formula; a filter that is written out has unreadable formulas.
std::string formula_at(const CompiledProgram& compiled, const std::vector<std::string>& inputs,
                       const std::vector<double>& lengths, int place) {
  constexpr double kLongest = 60.0;
  return lengths[static_cast<std::size_t>(place)] <= kLongest
             ? printable(formula_of(compiled.program, inputs, compiled.names, place), kShown)
             : "a long formula";
}

/// The name, or else the formula.
std::string shown(const CompiledProgram& compiled, const std::vector<std::string>& inputs,
                  const std::vector<double>& lengths, int place) {
  const auto named = compiled.names.find(place);
  return named != compiled.names.end() && place >= compiled.program.inputs()
             ? named->second
             : formula_at(compiled, inputs, lengths, place);
}

Position position_of(const CompiledProgram& compiled, int place, Position otherwise) {
  const int number = place - compiled.program.inputs();
  return number >= 0 && number < static_cast<int>(compiled.positions.size())
             ? compiled.positions[static_cast<std::size_t>(number)]
             : otherwise;
}

/// The values of registers that depend on constants alone, otherwise NaN.
std::vector<double> constant_registers(const Model& model, const CompiledProgram& compiled) {
  std::vector<double> inputs(static_cast<std::size_t>(compiled.program.inputs()), NAN);
  for (std::size_t i = 0; i < model.constants.size(); ++i) {
    inputs[i] = model.constants[i].nearest;
  }
  std::vector<double> registers;
  std::vector<double> results(compiled.program.results().size());
  compiled.program.run<double>(std::span<const double>(inputs), registers, std::span<double>(results));
  return registers;
}

/// Whether it converts turns to rad, or rad to turns.
bool converts_turns(const Model& model, const CompiledProgram& compiled, const trackers::Instruction& made) {
  constexpr double kRadiansInTurn = 2.0 * std::numbers::pi;
  constexpr double kClose = 1e-9;
  const bool is_factor = made.operation == Operation::multiply || made.operation == Operation::divide;
  const std::vector<double> values = is_factor ? constant_registers(model, compiled) : std::vector<double>();
  return is_factor &&
         (std::fabs(values[static_cast<std::size_t>(made.first)] / kRadiansInTurn - 1.0) < kClose ||
          std::fabs(values[static_cast<std::size_t>(made.second)] / kRadiansInTurn - 1.0) < kClose);
}

/// Where the place shows what was meant, a further remark.
std::string advice_on_turns(const Model& model, const CompiledProgram& compiled, int place,
                            const std::string& angle) {
  const int number = place - compiled.program.inputs();
  if (number < 0) {
    return "";
  }
  const trackers::Instruction& made = compiled.program.instructions()[static_cast<std::size_t>(number)];
  if (converts_turns(model, compiled, made)) {
    return "; an angle is in rad: for a state in turns use a state that is 2*pi times it";
  }
  if (angle.empty()) {
    return "";
  }
  if (what_is_wrapped(compiled.program, made)) {
    return fmt::format("; wrap(...) as the whole next value of an angle is allowed where no line uses {}'",
                       angle);
  }
  return made.operation == Operation::choose
             ? fmt::format("; leave the wrap out: {} is an angle, known modulo 2*pi", angle)
             : "";
}

}  // namespace

void require_whole_turns(const Model& model, const ModelTable& table, const std::vector<SourceText>& signal) {
  std::vector<rigor::Interval> constants;
  for (const language::Constant& constant : model.constants) {
    constants.push_back(constant.value);
  }
  if (const auto objection = model::find_turn_objection(model.recursion, constants)) {
    const bool is_frequency = objection->state < 0;
    const CompiledProgram& compiled = is_frequency ? model.frequency : model.step;
    const auto state = static_cast<std::size_t>(std::max(objection->state, 0));
    const bool is_angle = !is_frequency && model.recursion.is_angle[state];
    const bool is_result = objection->place == compiled.program.results()[state];
    const std::string value =
        is_frequency ? std::string("the frequency") : fmt::format("{}'", model.states[state]);
    const std::string formula =
        formula_at(compiled, inputs_of(model, !is_frequency), lengths_of(compiled), objection->place);
    throw LanguageError(
        position_of(compiled, objection->place,
                    is_frequency ? table.frequency.position : table.step.position),
        fmt::format("{} {}, in {}; allowed: angles with whole factors, inside of sin, cos and tan, and in "
                    "sums in the next value of an angle{}",
                    value,
                    !is_result ? "depends on a part of a turn of an angle"
                    : is_angle ? "does not turn once when the angle turns once"
                               : "is not the same after a whole turn of an angle",
                    formula,
                    advice_on_turns(model, compiled, objection->place,
                                    is_angle ? model.states[state] : std::string())));
  }
  if (!model::is_periodic(model.signal, constants)) {
    throw LanguageError(signal.front().position,
                        "the signal is not known to have the period 2 pi in phi; allowed: phi with whole "
                        "factors, inside of sin, cos and tan");
  }
}

std::vector<std::string> objections_to_operations(const Model& model) {
  std::vector<std::string> objections;
  const std::vector<std::string> inputs = inputs_of(model, true);
  const std::vector<double> lengths = lengths_of(model.step);
  int place = model.step.program.inputs();
  for (const trackers::Instruction& made : model.step.program.instructions()) {
    const std::string at = fmt::format(" (line {})", position_of(model.step, place, {}).line);
    const auto operand = [&](int number) { return shown(model.step, inputs, lengths, number); };
    switch (made.operation) {
      case Operation::divide:
        objections.push_back("the denominator " + operand(made.second) + at + " may vanish");
        break;
      case Operation::sqrt:
      case Operation::log:
        objections.push_back(fmt::format("what {} is taken of, {}{}, may be 0 or less",
                                         made.operation == Operation::sqrt ? "the root" : "the logarithm",
                                         operand(made.first), at));
        break;
      case Operation::asin:
      case Operation::acos:
        objections.push_back(fmt::format("the argument of {}, {}{}, may reach 1 or -1",
                                         made.operation == Operation::asin ? "asin" : "acos",
                                         operand(made.first), at));
        break;
      case Operation::tan:
        objections.push_back("tan(" + operand(made.first) + ")" + at + " may become infinite");
        break;
      case Operation::atan2:
        if (const auto wrapped = what_is_wrapped(model.step.program, made)) {
          objections.push_back(fmt::format(
              "wrap({}){} may reach its jump, where what it wraps is half a turn", operand(*wrapped), at));
          break;
        }
        objections.push_back(
            fmt::format("atan2({}, {}){} may reach its jump, where the second argument is "
                        "negative or 0 and the first is 0",
                        operand(made.first), operand(made.second), at));
        break;
      case Operation::stays_within:
        objections.push_back(fmt::format("{}{} may leave the limits of stays_within, {} and {}",
                                         operand(made.first), at, operand(made.second), operand(made.third)));
        break;
      case Operation::choose:
      case Operation::sign:
        objections.push_back(fmt::format("{}{}, at whose 0 {} jumps, may change its sign",
                                         operand(made.first), at,
                                         made.operation == Operation::sign ? "sign" : "a condition"));
        break;
      case Operation::clamp:
        objections.push_back(fmt::format("the limits of clamp{}, {} and {}, may change places", at,
                                         operand(made.second), operand(made.third)));
        break;
      default:
        objections.push_back("an operation" + at + " may become infinite");
    }
    ++place;
  }
  return objections;
}

std::vector<std::string> clamps_of(const Model& model) {
  std::vector<std::string> clamps;
  const std::vector<std::string> inputs = inputs_of(model, true);
  const std::vector<double> lengths = lengths_of(model.step);
  const auto limit = [&](int number) {
    const std::string formula = shown(model.step, inputs, lengths, number);
    const auto place = static_cast<std::size_t>(number);
    const bool is_parameter = place < model.constants.size() && !model.constants[place].is_literal;
    return is_parameter ? fmt::format("{} = {:.6g}", formula, rigor::midpoint(model.constants[place].value))
                        : formula;
  };
  int place = model.step.program.inputs();
  for (const trackers::Instruction& made : model.step.program.instructions()) {
    if (made.operation == Operation::clamp) {
      clamps.push_back(fmt::format("clamp({}, {}, {}) (line {})",
                                   shown(model.step, inputs, lengths, made.first), limit(made.second),
                                   limit(made.third), position_of(model.step, place, {}).line));
    }
    ++place;
  }
  return clamps;
}

}  // namespace veritrack::certificates
