#include "certificates/code/harness/arguments_guessed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>

#include "certificates/code/harness/types.hpp"

namespace veritrack::certificates::code {

std::string object_argument(const Variable& parameter, const std::string& object) {
  return (is_pointer(parameter.type) ? "&" : "") + object;
}

std::string called_name(const HarnessPlan& plan, const Function& function) {
  const bool is_renamed = function.owner.empty() && std::find(plan.renamed.begin(), plan.renamed.end(),
                                                              function.name) != plan.renamed.end();
  const bool is_of_class = !function.owner.empty() && function.is_static;
  return (is_renamed ? "own_" : is_of_class ? function.owner + "::" : "") + function.name;
}

GuessContext guess_context(const HarnessPlan& plan, const Declarations& declarations) {
  GuessContext context;
  context.sample_rate = plan.sample_rate > 0.0 ? plan.sample_rate : 1.0;
  context.unit = plan.frequencies.front().unit;
  context.is_times_period = [&plan, &declarations](const std::string& name) {
    return plan.time && std::any_of(declarations.functions.begin(), declarations.functions.end(),
                                    [&](const Function& each) {
                                      return each.products.count({name, plan.time->name}) != 0;
                                    });
  };
  return context;
}

GuessedArguments guessed_arguments(const std::vector<Variable>& parameters, const HarnessPlan& plan,
                                   const Declarations& declarations, const GuessContext& context) {
  GuessedArguments result;
  const Record* object = declarations.record_of(plan.step.object_type());
  bool has_unknown = false;
  for (const Variable& parameter : parameters) {
    const Record* record = declarations.record_of(parameter.type);
    const Variable* variable = record == nullptr ? nullptr : object_in_file(declarations, parameter.type);
    if (record != nullptr && record == object) {
      result.values.push_back(object_argument(parameter, plan.names.object));
      continue;
    }
    std::optional<std::string> guess;
    if (variable != nullptr) {
      guess = object_argument(parameter, variable->name);
    } else if (is_number_type(parameter.type)) {
      GuessContext own = context;
      own.is_double = bare_type(parameter.type) == "double";
      guess = guessed_number(parameter.name, own);
    }
    has_unknown = has_unknown || !guess;
    if (variable == nullptr) {
      result.numbers.push_back(parameter.name);
    }
    result.values.push_back(guess ? *guess : fmt::format("PUT_{}_HERE", parameter.name));
    result.summary +=
        fmt::format("{}{} = {}", result.summary.empty() ? "" : ", ", parameter.name, result.values.back());
  }
  result.advice = has_unknown ? "The file has no values for them, and some names suggest none: put yours."
                              : "The file has no values for them: put yours.";
  if (result.numbers.empty()) {
    result.advice = "It is the only such variable of the file.";
  }
  return result;
}

const Function* called_constructor(const HarnessPlan& plan, const Declarations& declarations) {
  const Function* chosen = nullptr;
  for (const Function& function : declarations.functions) {
    if (!plan.has_own_object && function.is_constructor && function.owner == plan.step.object_type() &&
        (chosen == nullptr || function.parameters.size() < chosen->parameters.size())) {
      chosen = &function;
    }
  }
  return chosen == nullptr || chosen->parameters.empty() ? nullptr : chosen;
}

std::vector<const Variable*> open_members(const HarnessPlan& plan, const Declarations& declarations) {
  const Record* record = declarations.record_of(plan.step.object_type());
  std::vector<const Variable*> result;
  if (record == nullptr || plan.has_own_object || plan.is_cpp) {
    return result;
  }
  for (const Variable& member : record->members) {
    const bool is_set =
        std::any_of(declarations.functions.begin(), declarations.functions.end(), [&](const Function& each) {
          return each.written_members.count(member.name) != 0 || each.assigned.count(member.name) != 0;
        });
    if (is_number_type(member.type) && !is_set) {
      result.push_back(&member);
    }
  }
  return result;
}

std::string members_left_open(const HarnessPlan& plan, const Declarations& declarations,
                              const GuessContext& context) {
  std::string text;
  for (const Variable* member : open_members(plan, declarations)) {
    GuessContext own = context;
    own.is_double = bare_type(member->type) == "double";
    const std::optional<std::string> guess = guessed_number(member->name, own);
    text += fmt::format("  {}.{} = {};  // {}: nothing in the file sets {} ({})\n", plan.names.object,
                        member->name, guess.value_or("0"), guess ? "guessed" : "put yours", member->name,
                        at_line(member->place));
  }
  return text;
}

std::vector<std::string> guessed_numbers(const HarnessPlan& plan, const Declarations& declarations) {
  const GuessContext context = guess_context(plan, declarations);
  std::vector<std::string> names;
  for (const Function* function :
       {called_constructor(plan, declarations), plan.inits.empty() ? nullptr : plan.inits.front()}) {
    if (function != nullptr) {
      const std::vector<std::string> more =
          guessed_arguments(function->parameters, plan, declarations, context).numbers;
      names.insert(names.end(), more.begin(), more.end());
    }
  }
  for (const Variable* member : open_members(plan, declarations)) {
    names.push_back(member->name);
  }
  for (std::size_t i = 0; i < plan.step.roles.size(); ++i) {
    if (plan.step.roles[i] == Role::period) {
      names.push_back(plan.step.function->parameters[i].name);
    }
  }
  return names;
}

}  // namespace veritrack::certificates::code
