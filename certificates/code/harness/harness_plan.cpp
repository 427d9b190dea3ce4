#include "certificates/code/harness/harness_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string_view>
#include <utility>

#include "certificates/code/harness/names.hpp"
#include "certificates/design/input_error.hpp"

namespace veritrack::certificates::code {

namespace {

constexpr std::array<std::string_view, 3> kOfHarness{"setup", "step", "frequency"};

std::string line_of_file(const DeclarationPlace& place) {
  std::ifstream file(place.file);
  std::string line;
  for (int i = 0; i < place.line && std::getline(file, line); ++i) {
  }
  return line;
}

bool is_declared(const Declarations& declarations, const std::string& name) {
  const auto is_called_so = [&](const auto& each) { return each.name == name; };
  return std::any_of(declarations.functions.begin(), declarations.functions.end(),
                     [&](const Function& each) { return each.full_name() == name; }) ||
         std::any_of(declarations.variables.begin(), declarations.variables.end(), is_called_so) ||
         std::any_of(declarations.records.begin(), declarations.records.end(), is_called_so) ||
         declarations.aliases.count(name) != 0;
}

std::string free_name(const Declarations& declarations, std::string name) {
  while (is_declared(declarations, name)) {
    name += '_';
  }
  return name;
}

std::string named_with_line(const Function& function) {
  return fmt::format("{} (line {})", function.full_name(), function.place.line);
}

[[noreturn]] void refuse_file(const StepCandidates& candidates, const std::string& file) {
  std::vector<std::string> seen;
  for (const RefusedFunction& each : candidates.refused) {
    seen.push_back(fmt::format("{}: {}", named_with_line(*each.function), each.why));
  }
  const Position position = candidates.refused.empty()
                                ? Position{1, 1}
                                : Position{candidates.refused.front().function->place.line,
                                           candidates.refused.front().function->place.column};
  throw InputError(
      file, position,
      fmt::format("no function takes a sample; looked for: one or two numbers by value, and a structure or "
                  "variables that it changes; {}",
                  seen.empty() ? std::string("the file defines no function")
                               : fmt::format("seen: {}", fmt::join(seen, "; "))));
}

/// The candidate of that name, with or without its class.
std::size_t index_of(const StepCandidates& candidates, const std::string& function, const std::string& file) {
  const auto is_called_so = [&](const Function& each) {
    const std::string full = each.full_name();
    return full == function || each.name == function || last_name(full) == function;
  };
  for (std::size_t i = 0; i < candidates.taken.size(); ++i) {
    if (is_called_so(*candidates.taken[i].function)) {
      return i;
    }
  }
  for (const RefusedFunction& each : candidates.refused) {
    if (is_called_so(*each.function)) {
      throw InputError(
          file, {each.function->place.line, each.function->place.column},
          fmt::format("{} is no step: {}; allowed: one or two numbers by value, and a structure or "
                      "variables that it changes",
                      each.function->full_name(), each.why));
    }
  }
  std::vector<std::string> known;
  for (const StepCandidate& each : candidates.taken) {
    known.push_back(named_with_line(*each.function));
  }
  if (known.empty()) {
    refuse_file(candidates, file);
  }
  throw InputError(
      file, {1, 1},
      fmt::format("it defines no function {}; allowed: {}", printable(function, 60), fmt::join(known, ", ")));
}

/// Each whole word that the harness renames, in an expression.
std::string with_new_names(const std::string& expression, const std::vector<std::string>& renamed) {
  std::string result;
  for (std::size_t at = 0; at < expression.size();) {
    std::size_t end = at;
    while (end < expression.size() &&
           (std::isalnum(static_cast<unsigned char>(expression[end])) != 0 || expression[end] == '_')) {
      ++end;
    }
    const std::string word = expression.substr(at, end - at);
    result += std::find(renamed.begin(), renamed.end(), word) != renamed.end() ? "own_" + word : word;
    if (end == at) {
      result += expression[end++];
    }
    at = end;
  }
  return result;
}

/// What stands for the estimate where no name suggests one: it does not compile, and its comment has what the
/// step changes.
FrequencySource missing_frequency(const HarnessPlan& plan) {
  const std::set<std::string>& written = plan.step.function->written_members;
  FrequencySource source;
  source.expression = "PUT_FREQUENCY_HERE";
  source.place = plan.step.function->place;
  source.why_unit = fmt::format(
      "as no name is like freq, omega, speed, w or rate: put a formula, in rad/sample, of {}",
      written.empty() ? std::string("what the step changes") : fmt::format("{}", fmt::join(written, ", ")));
  return source;
}

}  // namespace

HarnessPlan harness_plan(const Declarations& declarations, const std::string& file, const std::string& text,
                         const std::string& function) {
  StepCandidates candidates = step_candidates(declarations, file);
  if (candidates.taken.empty() && function.empty()) {
    refuse_file(candidates, file);
  }
  const std::size_t chosen = function.empty() ? 0 : index_of(candidates, function, file);
  HarnessPlan plan;
  plan.step = candidates.taken[chosen];
  if (!function.empty()) {
    plan.step.why = "by --function";
  }
  candidates.taken.erase(candidates.taken.begin() + static_cast<std::ptrdiff_t>(chosen));
  plan.other_steps = std::move(candidates.taken);
  for (const std::string_view name : kOfHarness) {
    if (is_declared(declarations, std::string(name))) {
      plan.renamed.emplace_back(name);
    }
  }
  plan.names.result = free_name(declarations, "result_of_step");
  plan.names.outputs = "out_";
  if (const std::string type = plan.step.object_type(); !type.empty()) {
    const Variable* own = object_in_file(declarations, type);
    plan.has_own_object = own != nullptr && own->type.find("const ") != 0;
    plan.names.object = plan.has_own_object ? own->name : free_name(declarations, "tracker");
  }
  plan.inits = init_candidates(declarations, file, plan.step);
  plan.time = sample_time(declarations, plan.step, plan.names, text, file);
  plan.frequencies = frequency_sources(declarations, plan.step, plan.names, plan.time, file, line_of_file);
  if (plan.frequencies.empty()) {
    plan.frequencies.push_back(missing_frequency(plan));
  }
  for (FrequencySource& source : plan.frequencies) {
    source.expression = with_new_names(source.expression, plan.renamed);
  }
  if (plan.time) {
    plan.time->expression = with_new_names(plan.time->expression, plan.renamed);
  }
  plan.names.object = with_new_names(plan.names.object, plan.renamed);
  return plan;
}

std::vector<std::string> headers_that_declare(const HarnessPlan& plan, const Declarations& declarations,
                                              const std::string& file) {
  std::vector<DeclarationPlace> places;
  std::vector<const Function*> used{plan.step.function};
  if (!plan.inits.empty()) {
    used.push_back(plan.inits.front());
  }
  for (const Function& function : declarations.functions) {
    if (function.name == plan.frequencies.front().name && function.has_body) {
      used.push_back(&function);
    }
  }
  for (const Function* function : used) {
    const auto declared =
        std::find_if(declarations.functions.begin(), declarations.functions.end(), [&](const Function& each) {
          return each.full_name() == function->full_name() && each.place.file != file;
        });
    places.push_back(declared == declarations.functions.end() ? function->place : declared->place);
  }
  if (const Record* record = declarations.record_of(plan.step.object_type())) {
    places.push_back(record->place);
  }
  if (plan.time && plan.time->place.line > 0) {
    places.push_back(plan.time->place);
  }
  places.push_back(plan.frequencies.front().place);
  std::vector<std::string> headers;
  const bool has_variables = plan.has_own_object || plan.step.object_type().empty() ||
                             !plan.renamed.empty() ||
                             std::count(plan.step.roles.begin(), plan.step.roles.end(), Role::config) != 0;
  for (const DeclarationPlace& place : places) {
    const bool is_result = plan.frequencies.front().is_result && &place == &places.back();
    if (has_variables || (place.file == file && !is_result)) {
      return {};
    }
    if (!is_result && std::find(headers.begin(), headers.end(), place.file) == headers.end()) {
      headers.push_back(place.file);
    }
  }
  return headers;
}

}  // namespace veritrack::certificates::code
