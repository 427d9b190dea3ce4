#include "certificates/model/program_text.hpp"

#include <fmt/format.h>

#include <cstddef>

namespace veritrack::certificates {

namespace {

using trackers::Instruction;
using trackers::Operation;
using trackers::StraightLineProgram;

/// The binding strength of a formula.
enum Precedence : int { of_sum, of_product, of_sign, of_power, of_atom };

struct Text {
  std::string formula;
  Precedence precedence = of_atom;
};

class Writer {
 public:
  Writer(const StraightLineProgram& program, const std::vector<std::string>& inputs,
         const FormulaSyntax& syntax)
      : program_(&program), syntax_(&syntax), names_(static_cast<std::size_t>(program.registers())) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      names_[i] = inputs[i];
    }
  }

  /// For messages: atan2(sin(x), cos(x)) as wrap(x).
  void show_wraps() { shows_wraps_ = true; }
  [[nodiscard]] bool has_name(int place) const { return !names_[static_cast<std::size_t>(place)].empty(); }
  void set_name(int place, const std::string& name) { names_[static_cast<std::size_t>(place)] = name; }

  /// The formula of a register, whether it has a name or not.
  [[nodiscard]] Text formula(int place) const {
    if (place < program_->inputs()) {
      return {names_[static_cast<std::size_t>(place)], of_atom};
    }
    const Instruction& made =
        program_
            ->instructions()[static_cast<std::size_t>(place) - static_cast<std::size_t>(program_->inputs())];
    switch (made.operation) {
      case Operation::add:
        return {operand(made.first, of_sum) + " + " + operand(made.second, of_product), of_sum};
      case Operation::subtract:
        return {operand(made.first, of_sum) + " - " + operand(made.second, of_product), of_sum};
      case Operation::multiply:
        return {operand(made.first, of_product) + "*" + operand(made.second, of_sign), of_product};
      case Operation::divide:
        return {operand(made.first, of_product) + "/" + operand(made.second, of_sign), of_product};
      case Operation::negate:
        return {"-" + operand(made.first, of_power), of_sign};
      case Operation::power:
        return power(made);
      default:
        return {call(made), of_atom};
    }
  }

 private:
  /// The name or the formula, in parentheses unless it binds at least as tightly.
  [[nodiscard]] std::string operand(int place, Precedence least) const {
    if (has_name(place)) {
      return names_[static_cast<std::size_t>(place)];
    }
    const Text text = formula(place);
    return text.precedence >= least ? text.formula : "(" + text.formula + ")";
  }
  [[nodiscard]] Text power(const Instruction& made) const {
    if (syntax_->power.empty()) {
      return {fmt::format("power({}, {})", operand(made.first, of_sum), made.exponent), of_atom};
    }
    return {fmt::format("{}{}{}", operand(made.first, of_atom), syntax_->power, made.exponent), of_power};
  }
  [[nodiscard]] std::string call(const Instruction& made) const {
    const auto standard = [&](std::string_view name) {
      return fmt::format("{}{}({})", syntax_->function_prefix, name, operand(made.first, of_sum));
    };
    switch (made.operation) {
      case Operation::sqrt:
        return standard("sqrt");
      case Operation::exp:
        return standard("exp");
      case Operation::log:
        return standard("log");
      case Operation::sin:
        return standard("sin");
      case Operation::cos:
        return standard("cos");
      case Operation::tan:
        return standard("tan");
      case Operation::asin:
        return standard("asin");
      case Operation::acos:
        return standard("acos");
      case Operation::atan:
        return standard("atan");
      case Operation::atan2:
        if (const auto wrapped = what_is_wrapped(*program_, made); wrapped && shows_wraps_) {
          return fmt::format("wrap({})", operand(*wrapped, of_sum));
        }
        return fmt::format("{}atan2({}, {})", syntax_->function_prefix, operand(made.first, of_sum),
                           operand(made.second, of_sum));
      case Operation::minimum:
        return two("minimum", "min", made);
      case Operation::maximum:
        return two("maximum", "max", made);
      case Operation::absolute:
        return fmt::format("{}({})", is_code() ? "absolute" : "abs", operand(made.first, of_sum));
      case Operation::sign:
        return fmt::format("{}({})", is_code() ? "sign_of" : "sign", operand(made.first, of_sum));
      case Operation::clamp:
        return fmt::format("{}({}, {}, {})", is_code() ? "clamped" : "clamp", operand(made.first, of_sum),
                           operand(made.second, of_sum), operand(made.third, of_sum));
      case Operation::choose:
        return choice(made);
      default:
        return fmt::format("stays_within({}, {}, {})", operand(made.first, of_sum),
                           operand(made.second, of_sum), operand(made.third, of_sum));
    }
  }

  [[nodiscard]] bool is_code() const { return syntax_->power.empty(); }
  [[nodiscard]] std::string two(std::string_view in_code, std::string_view in_formulas,
                                const Instruction& made) const {
    return fmt::format("{}({}, {})", is_code() ? in_code : in_formulas, operand(made.first, of_sum),
                       operand(made.second, of_sum));
  }
  /// With the two values that are compared, in formulas.
  [[nodiscard]] std::string choice(const Instruction& made) const {
    std::string positive = operand(made.first, of_sum);
    if (!is_code()) {
      const int number = made.first - program_->inputs();
      const bool is_difference =
          !has_name(made.first) && number >= 0 &&
          program_->instructions()[static_cast<std::size_t>(number)].operation == Operation::subtract;
      positive += " > 0";
      if (is_difference) {
        const Instruction& difference = program_->instructions()[static_cast<std::size_t>(number)];
        positive = operand(difference.first, of_sum) + " > " + operand(difference.second, of_sum);
      }
    }
    return fmt::format("{}({}, {}, {})", is_code() ? "chosen" : "if", positive, operand(made.second, of_sum),
                       operand(made.third, of_sum));
  }

  const StraightLineProgram* program_;
  const FormulaSyntax* syntax_;
  std::vector<std::string> names_;
  bool shows_wraps_ = false;
};

/// The number of times that each register is a result, or an operand of a register that the results depend
/// on.
std::vector<int> uses(const StraightLineProgram& program) {
  std::vector<int> counts(static_cast<std::size_t>(program.registers()), 0);
  for (const int place : program.results()) {
    ++counts[static_cast<std::size_t>(place)];
  }
  for (std::size_t i = program.instructions().size(); i-- > 0;) {
    const Instruction& instruction = program.instructions()[i];
    if (counts[static_cast<std::size_t>(program.inputs()) + i] == 0) {
      continue;
    }
    for (const int place : {instruction.first, instruction.second, instruction.third}) {
      if (place >= 0) {
        ++counts[static_cast<std::size_t>(place)];
      }
    }
  }
  return counts;
}

}  // namespace

std::optional<int> what_is_wrapped(const StraightLineProgram& program, const Instruction& made) {
  const auto argument = [&](int place, Operation operation) -> std::optional<int> {
    const int number = place - program.inputs();
    if (number < 0) {
      return std::nullopt;
    }
    const Instruction& operand = program.instructions()[static_cast<std::size_t>(number)];
    return operand.operation == operation ? std::optional(operand.first) : std::nullopt;
  };
  if (made.operation != Operation::atan2) {
    return std::nullopt;
  }
  const std::optional<int> sine = argument(made.first, Operation::sin);
  return sine && sine == argument(made.second, Operation::cos) ? sine : std::nullopt;
}

std::vector<Assignment> assignments(const StraightLineProgram& program,
                                    const std::vector<std::string>& inputs,
                                    const std::map<int, std::string>& names,
                                    const std::vector<std::string>& results, std::string_view prefix,
                                    const FormulaSyntax& syntax) {
  Writer writer(program, inputs, syntax);
  const std::vector<int> counts = uses(program);
  std::vector<std::string> result_of(static_cast<std::size_t>(program.registers()));
  for (std::size_t i = 0; i < results.size(); ++i) {
    std::string& name = result_of[static_cast<std::size_t>(program.results()[i])];
    name = name.empty() ? results[i] : name;
  }
  std::vector<Assignment> lines;
  int unnamed = 0;
  for (int place = program.inputs(); place < program.registers(); ++place) {
    const int count = counts[static_cast<std::size_t>(place)];
    if (count == 0) {
      continue;  // nothing depends on it
    }
    const auto named = names.find(place);
    const std::string& result = result_of[static_cast<std::size_t>(place)];
    std::string name = !result.empty() ? result : named != names.end() ? named->second : std::string();
    if (name.empty() && count > 1) {
      name = fmt::format("{}{}", prefix, ++unnamed);
    }
    if (!name.empty()) {
      lines.push_back({name, writer.formula(place).formula});
      writer.set_name(place, name);
    }
  }
  // Results that are inputs, or results again.
  for (std::size_t i = 0; i < results.size(); ++i) {
    const int place = program.results()[i];
    const std::string& first = result_of[static_cast<std::size_t>(place)];
    if (place < program.inputs()) {
      lines.push_back({results[i], writer.formula(place).formula});
    } else if (first != results[i]) {
      lines.push_back({results[i], first});
    }
  }
  return lines;
}

std::string formula_of(const StraightLineProgram& program, const std::vector<std::string>& inputs,
                       const std::map<int, std::string>& names, int place) {
  constexpr FormulaSyntax kSyntax{"^", ""};
  Writer writer(program, inputs, kSyntax);
  for (const auto& [named, name] : names) {
    if (named >= program.inputs()) {
      writer.set_name(named, name);
    }
  }
  writer.show_wraps();
  return writer.formula(place).formula;
}

}  // namespace veritrack::certificates
