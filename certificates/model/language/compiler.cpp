#include "certificates/model/language/compiler.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <map>
#include <set>

#include "certificates/design/input_error.hpp"
#include "certificates/design/nearest_key.hpp"
#include "certificates/model/language/definition_order.hpp"
#include "certificates/model/language/vocabulary.hpp"
#include "certificates/model/language/written_out.hpp"

namespace veritrack::certificates::language {

namespace {

using trackers::Instruction;
using trackers::Operation;
using trackers::StraightLineProgram;

constexpr std::size_t kShown = 60;

/// The names that mean something, and the registers that hold them.
class Names {
 public:
  void define(const std::string& name, int place) { registers_[name] = place; }
  /// Throws LanguageError with the nearest known name.
  [[nodiscard]] int find(const Expression& leaf) const {
    const auto found = registers_.find(leaf.text);
    if (found != registers_.end()) {
      return found->second;
    }
    if (find_function(leaf.text)) {
      throw LanguageError(leaf.position,
                          fmt::format("{} is a function; allowed: {}(...)", leaf.text, leaf.text));
    }
    std::vector<std::string> known;
    for (const auto& [name, place] : registers_) {
      if (std::isdigit(static_cast<unsigned char>(name.front())) == 0 && name.front() != '.') {
        known.push_back(name);
      }
    }
    const std::string shown = printable(leaf.text, kShown);
    const std::string_view meaning = reserved_meaning(leaf.text);
    if (!meaning.empty()) {
      throw LanguageError(leaf.position,
                          fmt::format("{} is {}, which cannot be used here; allowed: {}", shown, meaning,
                                      known.empty() ? "numbers" : fmt::format("{}", fmt::join(known, ", "))));
    }
    throw LanguageError(leaf.position,
                        known.empty()
                            ? fmt::format("unknown name {}; allowed: numbers", shown)
                            : fmt::format("unknown name {}; nearest known name: {}; allowed: {}", shown,
                                          nearest_key(leaf.text, known), fmt::join(known, ", ")));
  }

 private:
  std::map<std::string, int> registers_;
};

Operation operation_of(Expression::Kind kind) {
  switch (kind) {
    case Expression::Kind::negation:
      return Operation::negate;
    case Expression::Kind::sum:
      return Operation::add;
    case Expression::Kind::difference:
      return Operation::subtract;
    case Expression::Kind::product:
      return Operation::multiply;
    case Expression::Kind::quotient:
      return Operation::divide;
    default:
      return Operation::power;
  }
}

/// Appends the instructions of formulas to a program.
class Compiler {
 public:
  Compiler(const Constants& constants, const std::vector<std::string>& inputs) {
    int place = 0;
    for (const Constant& constant : constants) {
      names_.define(constant.name, place++);
    }
    for (const std::string& input : inputs) {
      names_.define(input, place++);
    }
    result_.program = StraightLineProgram(place);
  }

  [[nodiscard]] int place_of(const Expression& expression) {
    if (expression.operands.empty()) {
      return names_.find(expression);
    }
    if (expression.kind == Expression::Kind::comparison) {
      throw LanguageError(
          expression.position,
          fmt::format("a condition with {} that is no first argument of if; allowed: if(x {} y, "
                      "a, b)",
                      expression.text, expression.text));
    }
    Instruction instruction;
    if (expression.kind == Expression::Kind::call) {
      const std::optional<Function> function = find_function(expression.text);
      if (const std::size_t allowed = arguments_of_written_out(expression.text); allowed > 0) {
        throw LanguageError(expression.position,
                            fmt::format("{} has {} arguments; allowed: {}", expression.text,
                                        expression.operands.size(), allowed));
      }
      if (!function) {
        throw LanguageError(expression.position, objection_to_function(expression.text));
      }
      if (static_cast<int>(expression.operands.size()) != function->arguments) {
        throw LanguageError(expression.position,
                            fmt::format("{} has {} arguments; allowed: {}", expression.text,
                                        expression.operands.size(), function->arguments));
      }
      if (function->operation == Operation::choose) {
        return choice(expression);
      }
      instruction.operation = function->operation;
    } else {
      instruction.operation = operation_of(expression.kind);
      instruction.exponent = expression.exponent;
    }
    std::vector<int> operands;
    operands.reserve(expression.operands.size());
    for (const Expression& operand : expression.operands) {
      operands.push_back(place_of(operand));
    }
    operands.resize(3, -1);
    instruction.first = operands[0];
    instruction.second = operands[1];
    instruction.third = operands[2];
    return append(instruction, expression.position);
  }
  void define(const std::string& name, int place) { names_.define(name, place); }
  /// Notes the first name that a register is given.
  void name(int place, const std::string& name) { result_.names.try_emplace(place, name); }
  void add_result(int place) { result_.program.add_result(place); }
  void add_limit(int place) { result_.program.add_limit(place); }
  [[nodiscard]] CompiledProgram take() { return std::move(result_); }

 private:
  int append(const Instruction& instruction, Position position) {
    const int place = result_.program.append(instruction);
    if (result_.program.instructions().size() > result_.positions.size()) {
      result_.positions.push_back(position);
    }
    return place;
  }
  /// if(x > y, a, b): a where x - y > 0, else b. x <= y is the opposite, x < y is y > x.
  [[nodiscard]] int choice(const Expression& call) {
    const Expression& condition = call.operands[0];
    if (condition.kind != Expression::Kind::comparison) {
      throw LanguageError(condition.position,
                          "the first argument of if is no condition; allowed: x < y, x <= y, x > y, x >= y");
    }
    const int left = place_of(condition.operands[0]);
    const int right = place_of(condition.operands[1]);
    const int a = place_of(call.operands[1]);
    const int b = place_of(call.operands[2]);
    const bool is_less = condition.text == "<" || condition.text == ">=";
    const bool is_opposite = condition.text.size() == 2;
    const int positive =
        append({Operation::subtract, is_less ? right : left, is_less ? left : right}, condition.position);
    return append({Operation::choose, positive, is_opposite ? b : a, is_opposite ? a : b}, call.position);
  }

  Names names_;
  CompiledProgram result_;
};

/// The limits that have to be shown, whether or not anything needs them.
bool is_limit(const Definition& definition) {
  const Expression& value = definition.value;
  const auto function = value.kind == Expression::Kind::call ? find_function(value.text) : std::nullopt;
  return function && function->operation == Operation::stays_within;
}

/// Throws LanguageError for a line, not itself a limit, that neither a next value nor a limit needs: nothing
/// would be known about its operations.
void require_needed(const std::vector<const Definition*>& ordered) {
  std::set<std::string> needed;
  for (auto line = ordered.rbegin(); line != ordered.rend(); ++line) {
    const Definition& definition = **line;
    if (definition.name.back() != '\'' && !is_limit(definition) && !needed.contains(definition.name)) {
      throw LanguageError(definition.position,
                          fmt::format("{} is unused: delete it, or it is part of what runs; allowed: lines "
                                      "that a next value needs, and limits, name = stays_within(...)",
                                      printable(definition.name, kShown)));
    }
    for_each_leaf(definition.value, [&](const Expression& leaf) { needed.insert(leaf.text); });
  }
}

}  // namespace

void require_free_name(std::string_view name, Position position) {
  if (name.find('\'') != std::string_view::npos) {
    throw LanguageError(position,
                        fmt::format("{} has a prime; allowed: names without", printable(name, kShown)));
  }
  if (const std::string_view meaning = reserved_meaning(name); !meaning.empty()) {
    throw LanguageError(position, fmt::format("{} is {}; allowed: another name", name, meaning));
  }
}

CompiledProgram compile_formulas(const std::vector<const Expression*>& formulas, const Constants& constants,
                                 const std::vector<std::string>& inputs) {
  Compiler compiler(constants, inputs);
  for (const Expression* formula : formulas) {
    compiler.add_result(compiler.place_of(*formula));
  }
  return compiler.take();
}

CompiledProgram compile_step(const std::vector<Definition>& definitions, const Constants& constants,
                             const std::vector<std::string>& states, const std::vector<std::string>& samples,
                             Position place_of_step) {
  std::vector<std::string> inputs = states;
  inputs.insert(inputs.end(), samples.begin(), samples.end());
  const auto is_known = [&](const std::string& name) {
    return std::find(inputs.begin(), inputs.end(), name) != inputs.end() ||
           std::any_of(constants.begin(), constants.end(),
                       [&](const Constant& constant) { return constant.name == name; });
  };
  for (const Definition& definition : definitions) {
    if (definition.name.back() != '\'') {
      require_free_name(definition.name, definition.position);
      if (is_known(definition.name)) {
        throw LanguageError(
            definition.position,
            fmt::format("{} is a state, a sample or a parameter; allowed: a name of its own, or the "
                        "next value of a state, with a prime",
                        printable(definition.name, kShown)));
      }
    } else if (std::find(states.begin(), states.end(),
                         definition.name.substr(0, definition.name.size() - 1)) == states.end()) {
      throw LanguageError(definition.position,
                          fmt::format("{} is no next value of a state; nearest state: {}; allowed: {}",
                                      printable(definition.name, kShown),
                                      nearest_key(definition.name, states), fmt::join(states, ", ")));
    }
  }
  Compiler compiler(constants, inputs);
  std::map<std::string, int> places;
  const std::vector<const Definition*> ordered = in_order(definitions);
  for (const Definition* definition : ordered) {
    const int place = compiler.place_of(definition->value);
    if (is_limit(*definition)) {
      compiler.add_limit(place);
    }
    compiler.define(definition->name, place);
    compiler.name(place, definition->name);
    places[definition->name] = place;
  }
  for (const std::string& state : states) {
    const auto next = places.find(state + "'");
    if (next == places.end()) {
      throw LanguageError(
          place_of_step,
          fmt::format("the state {} has no next value; allowed: a line {}' = ...", state, state));
    }
    compiler.add_result(next->second);
  }
  require_needed(ordered);
  return compiler.take();
}

}  // namespace veritrack::certificates::language
