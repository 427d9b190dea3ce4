#include "certificates/code/harness/harness.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>

#include "certificates/code/harness/arguments_guessed.hpp"
#include "certificates/code/harness/guesses.hpp"
#include "certificates/code/harness/names.hpp"
#include "certificates/code/harness/types.hpp"

namespace veritrack::certificates::code {

namespace {

/// A comment of lines of at most 100 characters.
std::string comment(const std::string& text, const std::string& indent) {
  constexpr std::size_t kWidth = 100;
  std::string result = indent + "//";
  std::size_t used = result.size();
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    if (used + 1 + word.size() > kWidth) {
      result += "\n" + indent + "//";
      used = indent.size() + 2;
    }
    result += " " + word;
    used += 1 + word.size();
    at = end + 1;
  }
  return result + "\n";
}

std::string also(const std::vector<std::string>& others) {
  return others.empty() ? "no other is possible" : fmt::format("others: {}", fmt::join(others, ", "));
}

std::string type_of_step_number(const HarnessPlan& plan) {
  for (std::size_t i = 0; i < plan.step.roles.size(); ++i) {
    if (plan.step.roles[i] == Role::sample || plan.step.roles[i] == Role::angle) {
      return bare_type(plan.step.function->parameters[i].type);
    }
  }
  return "float";
}

std::string spelled_type(const HarnessPlan& plan, const Declarations& declarations) {
  const std::string type = plan.step.object_type();
  const Record* record = declarations.record_of(type);
  const bool is_tag = !plan.is_cpp && record != nullptr && record->name == type &&
                      std::any_of(plan.step.function->parameters.begin(),
                                  plan.step.function->parameters.end(), [&](const Variable& each) {
                                    return each.type.find("struct " + type) != std::string::npos;
                                  });
  return is_tag ? "struct " + type : type;
}

std::string object_declaration(const HarnessPlan& plan, const Declarations& declarations) {
  if (plan.names.object.empty() || plan.has_own_object) {
    return {};
  }
  std::string text;
  std::string arguments;
  const GuessContext context = guess_context(plan, declarations);
  const Function* chosen = called_constructor(plan, declarations);
  if (chosen != nullptr) {
    const GuessedArguments guessed = guessed_arguments(chosen->parameters, plan, declarations, context);
    text += comment(fmt::format("Guessed: {} of the constructor ({}). {}", guessed.summary,
                                at_line(chosen->place), guessed.advice),
                    "");
    arguments = fmt::format("({})", fmt::join(guessed.values, ", "));
  }
  return text +
         fmt::format("static {} {}{};\n", spelled_type(plan, declarations), plan.names.object, arguments);
}

std::string output_declarations(const HarnessPlan& plan) {
  std::string text;
  for (std::size_t i = 0; i < plan.step.roles.size(); ++i) {
    const Variable& parameter = plan.step.function->parameters[i];
    if (plan.step.roles[i] == Role::output) {
      text += fmt::format("static {} {}{};\n", bare_type(parameter.type), plan.names.outputs, parameter.name);
    }
  }
  if (plan.frequencies.front().is_result) {
    text += fmt::format("static {} {};\n", bare_type(plan.step.function->result), plan.names.result);
  }
  return text;
}

std::string setup_text(const HarnessPlan& plan, const Declarations& declarations) {
  std::string text = plan.is_cpp ? "void setup() {\n" : "void setup(void) {\n";
  const GuessContext context = guess_context(plan, declarations);
  if (plan.inits.empty()) {
    text +=
        comment(fmt::format("{} has no function with a name like init, setup or reset that prepares this.",
                            plan.source),
                "  ");
  } else {
    const Function& init = *plan.inits.front();
    std::vector<std::string> others;
    for (std::size_t i = 1; i < plan.inits.size(); ++i) {
      others.push_back(fmt::format("{} ({})", plan.inits[i]->full_name(), at_line(plan.inits[i]->place)));
    }
    const GuessedArguments guessed = guessed_arguments(init.parameters, plan, declarations, context);
    text += comment(fmt::format("Guessed: {} ({}) prepares the loop, from its name; {}.", init.full_name(),
                                at_line(init.place), also(others)),
                    "  ");
    if (!guessed.summary.empty()) {
      text += comment(fmt::format("Guessed: {}. {}", guessed.summary, guessed.advice), "  ");
    }
    text += fmt::format("  {}{}({});\n", init.owner.empty() ? "" : plan.names.object + ".",
                        called_name(plan, init), fmt::join(guessed.values, ", "));
  }
  return text + members_left_open(plan, declarations, context) + "}\n";
}

std::string step_text(const HarnessPlan& plan, const Declarations& declarations) {
  const Function& function = *plan.step.function;
  const std::string number = type_of_step_number(plan);
  std::vector<std::string> parameters, arguments;
  for (std::size_t i = 0; i < plan.step.roles.size(); ++i) {
    const Variable& parameter = function.parameters[i];
    const Role role = plan.step.roles[i];
    if (role == Role::sample) {
      const std::string fallback = fmt::format("y{}", parameters.size() + 1);
      parameters.push_back(number + " " + (parameter.name.empty() ? fallback : parameter.name));
      arguments.push_back(parameter.name.empty() ? fallback : parameter.name);
    } else if (role == Role::angle) {
      parameters = {number + " in_phase", number + " quadrature"};
      arguments.emplace_back(number == "float" ? "atan2f(quadrature, in_phase)"
                                               : "atan2(quadrature, in_phase)");
    } else if (role == Role::period) {
      arguments.push_back(fmt::format("{} / {}", number_literal(1.0, number == "double"),
                                      number_literal(plan.sample_rate, number == "double")));
    } else if (role == Role::output) {
      arguments.push_back((is_pointer(parameter.type) ? "&" : "") + plan.names.outputs + parameter.name);
    } else {
      const bool is_object = role == Role::object;
      arguments.push_back(object_argument(
          parameter, is_object ? plan.names.object : object_in_file(declarations, parameter.type)->name));
    }
  }
  std::vector<std::string> others;
  for (const StepCandidate& other : plan.other_steps) {
    others.push_back(fmt::format("{} ({})", other.function->full_name(), at_line(other.function->place)));
  }
  std::string text = fmt::format("void step({}) {{\n", fmt::join(parameters, ", "));
  text += comment(
      fmt::format("Guessed: {} ({}) takes a sample, {}; {}.", function.full_name(), at_line(function.place),
                  plan.step.why, others.empty() ? also(others) : also(others) + "; --function NAME chooses"),
      "  ");
  if (std::count(plan.step.roles.begin(), plan.step.roles.end(), Role::angle) != 0) {
    text += comment(
        "Guessed: it takes the angle of the signal, from the name of its parameter. Noise is then "
        "that of the two samples.",
        "  ");
  }
  if (std::count(plan.step.roles.begin(), plan.step.roles.end(), Role::period) != 0) {
    text += comment(fmt::format("Guessed: {:.6g} samples a second.", plan.sample_rate), "  ");
  }
  return text + fmt::format("  {}{}{}({});\n}}\n",
                            plan.frequencies.front().is_result ? plan.names.result + " = " : "",
                            function.owner.empty() || function.is_static ? "" : plan.names.object + ".",
                            called_name(plan, function), fmt::join(arguments, ", "));
}

std::string frequency_text(const HarnessPlan& plan) {
  const FrequencySource& source = plan.frequencies.front();
  const bool is_double = type_of_step_number(plan) == "double";
  std::vector<std::string> others;
  for (std::size_t i = 1; i < plan.frequencies.size(); ++i) {
    others.push_back(fmt::format("{} ({})", plan.frequencies[i].name, at_line(plan.frequencies[i].place)));
  }
  std::string text =
      fmt::format("{} frequency({}) {{\n", type_of_step_number(plan), plan.is_cpp ? "" : "void");
  text += comment(source.name.empty() ? fmt::format("Not found: the estimate; {}.", source.why_unit)
                                      : fmt::format("Guessed: {}{} ({}) is the estimate, {}; {}.",
                                                    source.is_result ? "the result of " : "", source.name,
                                                    at_line(source.place), source.why_unit, also(others)),
                  "  ");
  std::string factor;
  if (source.unit == FrequencyUnit::hertz) {
    factor = is_double ? " * 6.283185307179586" : " * 6.28318531f";
  }
  if (source.unit != FrequencyUnit::radians_per_sample) {
    const bool has_name = plan.time && !plan.time->expression.empty();
    factor += has_name ? (plan.time->is_rate ? " / " : " * ") + plan.time->expression
                       : " / " + number_literal(plan.sample_rate, is_double);
  }
  return text + fmt::format("  return {}{};  // rad/sample\n}}\n", source.expression, factor);
}

}  // namespace

std::string at_line(const DeclarationPlace& place) {
  return fmt::format("{}:{}", std::filesystem::path(place.file).filename().string(), place.line);
}

std::string harness_text(const HarnessPlan& plan, const Declarations& declarations) {
  std::string text =
      comment(fmt::format("The harness of {}: veritrack executes setup once, with numbers, then step and "
                          "frequency with symbols. `veritrack new` has written it; check what it guessed.",
                          plan.source),
              "");
  const bool has_angle =
      std::count(plan.step.roles.begin(), plan.step.roles.end(), Role::angle) != 0 && !plan.is_cpp;
  text += has_angle || plan.is_cpp ? "#include <math.h>\n\n" : "";
  for (const std::string& name : plan.renamed) {
    text += fmt::format("#define {0} own_{0}\n", name);
  }
  for (const std::string& include : plan.includes) {
    text += fmt::format("#include \"{}\"\n", include);
  }
  for (const std::string& name : plan.renamed) {
    text += fmt::format("#undef {}\n", name);
  }
  const std::string variables = object_declaration(plan, declarations) + output_declarations(plan);
  return text + (variables.empty() ? "" : "\n" + variables) + "\n" + setup_text(plan, declarations) + "\n" +
         step_text(plan, declarations) + "\n" + frequency_text(plan);
}

}  // namespace veritrack::certificates::code
