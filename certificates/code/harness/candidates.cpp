#include "certificates/code/harness/candidates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "certificates/code/harness/names.hpp"
#include "certificates/code/harness/types.hpp"

namespace veritrack::certificates::code {

namespace {

bool is_float_pointer(const std::string& type) {
  return (is_pointer(type) || is_reference(type)) && is_number_type(bare_type(type));
}

/// The roles of the parameters, or why there are none.
std::string find_roles(const Declarations& declarations, const Function& function, std::vector<Role>& roles) {
  const bool is_method = !function.owner.empty() && !function.is_static;
  bool has_object = is_method;
  int samples = 0;
  for (const Variable& parameter : function.parameters) {
    const std::string& type = parameter.type;
    if (is_number_type(type)) {
      const bool is_period = is_named_like_period(parameter.name);
      roles.push_back(is_period ? Role::period : Role::sample);
      samples += is_period ? 0 : 1;
    } else if (declarations.record_of(type) != nullptr && is_writable(type) && !has_object) {
      roles.push_back(Role::object);
      has_object = true;
    } else if (declarations.record_of(type) != nullptr && (is_pointer(type) || is_reference(type)) &&
               !is_writable(type) && object_in_file(declarations, type) != nullptr) {
      roles.push_back(Role::config);
    } else if (is_float_pointer(type) && is_writable(type)) {
      roles.push_back(Role::output);
    } else {
      return fmt::format("its parameter {} is of type {}", parameter.name.empty() ? "?" : parameter.name,
                         type);
    }
  }
  constexpr int kMostSamples = 2;
  if (samples == 0 || samples > kMostSamples) {
    return samples == 0 ? "it takes no number by value"
                        : fmt::format("it takes {} numbers, and samples are one or two", samples);
  }
  if (samples == 1) {
    for (std::size_t i = 0; i < roles.size(); ++i) {
      if (roles[i] == Role::sample && is_named_like_angle(function.parameters[i].name)) {
        roles[i] = Role::angle;
      }
    }
  }
  return {};
}

std::string why_not(const Declarations& declarations, const Function& function, std::vector<Role>& roles) {
  if (function.is_constructor || function.name == "main") {
    return function.is_constructor ? "it is a constructor" : "it is main";
  }
  if (function.is_template) {
    return "it is a template of which the file uses no instance with types";
  }
  if (std::string why = find_roles(declarations, function, roles); !why.empty()) {
    return why;
  }
  if (has_word(function.name, {"set", "get", "preset"})) {
    return "its name is that of a setter";
  }
  if (function.writes.empty()) {
    return "it keeps nothing: it writes to no structure and to no variable outside";
  }
  return is_named_like_init(last_name(function.name)) ? "its name is that of a preparation" : "";
}

bool writes_its_object(const Function& function, const std::vector<Role>& roles) {
  if (function.writes.count("this") != 0) {
    return true;
  }
  for (std::size_t i = 0; i < roles.size(); ++i) {
    if (roles[i] == Role::object && function.writes.count(function.parameters[i].name) != 0) {
      return true;
    }
  }
  return false;
}

void rate(StepCandidate& step, const std::vector<StepCandidate>& all) {
  constexpr int kOfName = 2;
  constexpr int kOfOuter = 3;
  constexpr int kOfObject = 2;
  std::vector<std::string> reasons;
  if (const int likeness = step_likeness(last_name(step.function->name)); likeness > 0) {
    step.score += likeness * kOfName;
    reasons.emplace_back("from its name");
  }
  if (writes_its_object(*step.function, step.roles)) {
    step.score += kOfObject;
    reasons.emplace_back(step.function->owner.empty() ? "as it writes through its parameter"
                                                      : "as it writes members of its class");
  }
  const bool is_called = std::any_of(all.begin(), all.end(), [&](const StepCandidate& other) {
    return other.function != step.function &&
           other.function->calls.count(last_name(step.function->name)) != 0;
  });
  if (!is_called) {
    step.score += kOfOuter;
    if (all.size() > 1) {
      reasons.emplace_back("as no other such function calls it");
    }
  }
  for (const std::string& reason : reasons) {
    step.why += (step.why.empty() ? "" : ", ") + reason;
  }
  step.why = step.why.empty() ? "by its parameters" : step.why;
}

}  // namespace

int StepCandidate::samples() const {
  const auto angles = std::count(roles.begin(), roles.end(), Role::angle);
  return static_cast<int>(2 * angles + std::count(roles.begin(), roles.end(), Role::sample));
}

std::string StepCandidate::object_type() const {
  if (!function->owner.empty() && !function->is_static) {
    return function->owner;
  }
  for (std::size_t i = 0; i < roles.size(); ++i) {
    if (roles[i] == Role::object) {
      return bare_type(function->parameters[i].type);
    }
  }
  return {};
}

const Variable* object_in_file(const Declarations& declarations, const std::string& type) {
  const Record* record = declarations.record_of(type);
  const Variable* found = nullptr;
  for (const Variable& variable : declarations.variables) {
    const bool is_one = variable.type.find_first_of("*&[") == std::string::npos;
    if (record != nullptr && is_one && declarations.record_of(variable.type) == record) {
      if (found != nullptr && found->name != variable.name) {
        return nullptr;
      }
      found = &variable;
    }
  }
  return found;
}

StepCandidates step_candidates(const Declarations& declarations, const std::string& file) {
  StepCandidates result;
  for (const Function& function : declarations.functions) {
    if (!function.has_body || function.place.file != file) {
      continue;
    }
    StepCandidate candidate{&function, {}, 0, {}};
    if (std::string why = why_not(declarations, function, candidate.roles); !why.empty()) {
      result.refused.push_back({&function, std::move(why)});
    } else {
      result.taken.push_back(std::move(candidate));
    }
  }
  for (StepCandidate& candidate : result.taken) {
    rate(candidate, result.taken);
  }
  std::stable_sort(result.taken.begin(), result.taken.end(),
                   [](const StepCandidate& a, const StepCandidate& b) { return a.score > b.score; });
  return result;
}

std::vector<const Function*> init_candidates(const Declarations& declarations, const std::string& file,
                                             const StepCandidate& step) {
  const Record* record = declarations.record_of(step.object_type());
  const Variable* object = object_in_file(declarations, step.object_type());
  std::vector<std::pair<int, const Function*>> rated;
  for (const Function& function : declarations.functions) {
    const bool is_named_so =
        is_named_like_init(last_name(function.name)) && function.name != step.function->name;
    if (!function.has_body || function.place.file != file || function.is_constructor ||
        function.is_template || !is_named_so) {
      continue;
    }
    const bool is_method = !function.owner.empty() && function.owner == step.function->owner;
    const bool takes_object = !function.parameters.empty() && function.owner.empty() && record != nullptr &&
                              declarations.record_of(function.parameters.front().type) == record &&
                              is_writable(function.parameters.front().type);
    const bool is_for_file =
        function.owner.empty() && function.parameters.empty() &&
        (record == nullptr || (object != nullptr && function.uses.count(last_name(object->name)) != 0));
    const bool is_for_variables = function.owner.empty() && record == nullptr &&
                                  std::all_of(function.parameters.begin(), function.parameters.end(),
                                              [](const Variable& each) { return is_number_type(each.type); });
    if (is_method || takes_object || is_for_file || is_for_variables) {
      const bool is_first = has_word(function.name, {"init", "setup", "initialize", "initialise", "create"});
      const bool is_reset = has_word(function.name, {"reset"});
      const bool needs_nothing = function.parameters.empty() && function.owner.empty();
      constexpr int kOfName = 4;
      rated.emplace_back((is_first ? kOfName : is_reset ? 1 : 2) + (needs_nothing ? 2 : 0), &function);
    }
  }
  std::stable_sort(rated.begin(), rated.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<const Function*> result;
  result.reserve(rated.size());
  for (const auto& [score, function] : rated) {
    result.push_back(function);
  }
  return result;
}

bool reads_a_number(const Function& function, const StepCandidate& step, const Declarations& declarations) {
  const bool is_method = !function.owner.empty() && function.owner == step.function->owner;
  const std::string type = step.object_type();
  const bool takes_object =
      function.owner.empty() && function.parameters.size() == 1 && !type.empty() &&
      (is_pointer(function.parameters.front().type) || is_reference(function.parameters.front().type)) &&
      declarations.record_of(function.parameters.front().type) == declarations.record_of(type) &&
      declarations.record_of(type) != nullptr;
  const bool takes_nothing = function.parameters.empty() && (function.owner.empty() || is_method);
  return function.has_body && !function.is_template && function.writes.empty() &&
         is_number_type(function.result) && (takes_object || takes_nothing) && &function != step.function;
}

}  // namespace veritrack::certificates::code
