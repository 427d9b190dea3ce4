#include "certificates/code/harness/frequency_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdlib>
#include <regex>
#include <set>

#include "certificates/code/harness/members.hpp"
#include "certificates/code/harness/names.hpp"
#include "certificates/code/harness/types.hpp"

namespace veritrack::certificates::code {

namespace {

std::string lower_case(std::string text) {
  for (char& c : text) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return text;
}

bool has_product(const Declarations& declarations, const std::string& a, const std::string& b) {
  return std::any_of(declarations.functions.begin(), declarations.functions.end(), [&](const Function& each) {
    // Functions that write nothing convert units for others.
    return !each.writes.empty() && each.products.count({last_name(a), last_name(b)}) != 0;
  });
}

/// #define DT 0.001f
std::optional<SampleTime> from_macro(const std::string& source_text, const std::string& file) {
  static const std::regex kMacro(R"(^[ \t]*#[ \t]*define[ \t]+(\w+)[ \t]+([^\n]+))", std::regex::multiline);
  for (std::sregex_iterator found(source_text.begin(), source_text.end(), kMacro), end; found != end;
       ++found) {
    const std::string name = (*found)[1];
    const bool is_rate = is_named_like_sample_rate(lower_case(name));
    if (!is_rate && !is_named_like_period(lower_case(name))) {
      continue;
    }
    const auto lines = std::count(source_text.begin(), source_text.begin() + found->position(1), '\n');
    SampleTime time{name, is_rate, name, {file, static_cast<int>(lines) + 1, 1}, {}};
    const std::string text = (*found)[2];
    const std::size_t begin = text.find_first_not_of("( ");
    char* rest = nullptr;
    double value = std::strtod(text.c_str() + (begin == std::string::npos ? 0 : begin), &rest);
    const std::string after = lower_case(rest);
    if (const std::size_t slash = after.find('/'); slash < 3) {
      value /= std::strtod(after.c_str() + after.find_first_not_of("/ (", slash), nullptr);
    }
    if (value > 0.0 && value < 1e12) {
      time.hz = is_rate ? value : 1.0 / value;
    }
    return time;
  }
  return std::nullopt;
}

/// True for a function whose result is a product with the time between samples.
bool multiplies_by_time(const Declarations& declarations, const FrequencySource& source,
                        const SampleTime& time) {
  return std::any_of(declarations.functions.begin(), declarations.functions.end(), [&](const Function& each) {
    return each.name == source.name && each.has_body &&
           std::any_of(each.products.begin(), each.products.end(),
                       [&](const auto& product) { return product.first == last_name(time.name); });
  });
}

/// The unit, and why it is taken for that.
void find_unit(FrequencySource& source, const Declarations& declarations,
               const std::optional<SampleTime>& time, const std::string& line) {
  const std::string text = lower_case(line);
  const std::size_t at = std::min(text.find("//"), text.find("/*"));
  const std::string comment = at == std::string::npos ? std::string() : text.substr(at);
  const auto set = [&](FrequencyUnit unit, std::string why) {
    source.unit = unit;
    source.why_unit = std::move(why);
  };
  if (comment.find("rad/sample") != std::string::npos ||
      comment.find("rad per sample") != std::string::npos) {
    return set(FrequencyUnit::radians_per_sample, "rad/sample, as the comment there says");
  }
  if (comment.find("rad/s") != std::string::npos || comment.find("rad per s") != std::string::npos) {
    return set(FrequencyUnit::radians_per_second, "rad/s, as the comment there says");
  }
  if (std::regex_search(comment, std::regex(R"(\bhz\b)"))) {
    return set(FrequencyUnit::hertz, "Hz, as the comment there says");
  }
  if (has_word(source.name, {"hz"})) {
    return set(FrequencyUnit::hertz, "Hz, from its name");
  }
  if (time && !source.is_result && multiplies_by_time(declarations, source, *time)) {
    return set(FrequencyUnit::radians_per_sample, "rad/sample, as it multiplies by " + time->name);
  }
  const bool has_turn = has_product(declarations, source.name, "2pi");
  const bool has_time = time && has_product(declarations, source.name, time->name);
  if (has_time) {
    return set(has_turn ? FrequencyUnit::hertz : FrequencyUnit::radians_per_second,
               fmt::format("{}, as it is multiplied by {}{} in the file", has_turn ? "Hz" : "rad/s",
                           has_turn ? "a turn and " : "", time->is_rate ? "1/" + time->name : time->name));
  }
  if (time && (has_turn || has_word(source.name, {"freq", "frequency", "f"}))) {
    return set(FrequencyUnit::hertz, "Hz, from its name");
  }
  if (time && has_word(source.name, {"omega", "speed", "velocity", "vel"})) {
    return set(FrequencyUnit::radians_per_second, "rad/s, from its name");
  }
  set(FrequencyUnit::radians_per_sample, time ? "rad/sample, as nothing multiplies it by " + time->name
                                              : "rad/sample, as the file has no time between samples");
}

/// Names to which something that is no constant is assigned, anywhere in the file.
std::set<std::string> written_names(const Declarations& declarations) {
  std::set<std::string> names;
  for (const Function& function : declarations.functions) {
    names.insert(function.written_members.begin(), function.written_members.end());
  }
  return names;
}

/// A function that returns the estimate: of the file, of the object, or a method of a variable of the file.
void add_functions(const Declarations& declarations, const StepCandidate& step, const HarnessNames& names,
                   std::vector<FrequencySource>& into) {
  constexpr int kOfFunction = 20;
  for (const Function& function : declarations.functions) {
    const int likeness = frequency_likeness(last_name(function.name));
    if (likeness < 2) {
      continue;
    }
    std::string call;
    if (reads_a_number(function, step, declarations)) {
      if (!function.owner.empty()) {
        call = names.object + "." + function.name + "()";
      } else if (function.parameters.empty()) {
        call = function.name + "()";
      } else {
        call =
            function.name + (is_pointer(function.parameters.front().type) ? "(&" : "(") + names.object + ")";
      }
    } else if (!function.owner.empty() && function.parameters.empty() && function.writes.empty() &&
               function.has_body && !function.is_template && is_number_type(function.result)) {
      const Variable* variable = object_in_file(declarations, function.owner);
      call = variable == nullptr ? "" : variable->name + "." + function.name + "()";
    }
    if (!call.empty()) {
      into.push_back({call, function.name, function.place, {}, {}, kOfFunction + likeness, false});
    }
  }
}

}  // namespace

std::optional<SampleTime> sample_time(const Declarations& declarations, const StepCandidate& step,
                                      const HarnessNames& names, const std::string& source_text,
                                      const std::string& file) {
  std::optional<SampleTime> best;
  int best_depth = 0;
  for (const Member& member : members_of(declarations, names.object, step.object_type(), file)) {
    const bool is_rate = is_named_like_sample_rate(member.name);
    if (!is_rate && !is_named_like_period(member.name)) {
      continue;
    }
    if (!best || member.depth < best_depth) {
      best = SampleTime{member.expression, is_rate, member.name, member.place, {}};
      best_depth = member.depth;
      if (member.value && *member.value > 0.0) {
        best->hz = is_rate ? *member.value : 1.0 / *member.value;
      }
    }
  }
  if (!best) {
    best = from_macro(source_text, file);
  }
  for (std::size_t i = 0; i < step.roles.size() && !best; ++i) {
    if (step.roles[i] == Role::period) {
      best = SampleTime{"", false, step.function->parameters[i].name, {}, {}};
    }
  }
  return best;
}

std::vector<FrequencySource> frequency_sources(const Declarations& declarations, const StepCandidate& step,
                                               const HarnessNames& names,
                                               const std::optional<SampleTime>& time, const std::string& file,
                                               LineReader line_of) {
  constexpr int kOfWritten = 10;
  constexpr int kOfOutput = 12;
  std::vector<FrequencySource> sources;
  add_functions(declarations, step, names, sources);
  const std::set<std::string> written = written_names(declarations);
  for (const Member& member : members_of(declarations, names.object, step.object_type(), file)) {
    const int likeness = frequency_likeness(last_name(member.name));
    if (likeness > 0 && written.count(last_name(member.name)) != 0) {
      sources.push_back({member.expression,
                         member.name,
                         member.place,
                         {},
                         {},
                         kOfWritten + likeness - member.depth,
                         false});
    }
  }
  for (std::size_t i = 0; i < step.roles.size(); ++i) {
    const Variable& parameter = step.function->parameters[i];
    const int likeness = frequency_likeness(parameter.name);
    if (step.roles[i] == Role::output && likeness > 0) {
      sources.push_back({names.outputs + parameter.name,
                         parameter.name,
                         parameter.place,
                         {},
                         {},
                         kOfOutput + likeness,
                         false});
    }
  }
  if (is_number_type(step.function->result)) {
    const int likeness = frequency_likeness(last_name(step.function->name));
    sources.push_back({names.result,
                       step.function->name,
                       step.function->place,
                       {},
                       {},
                       likeness > 0 ? kOfOutput + likeness : 1,
                       true});
  }
  std::stable_sort(sources.begin(), sources.end(),
                   [](const FrequencySource& a, const FrequencySource& b) { return a.score > b.score; });
  for (FrequencySource& source : sources) {
    find_unit(source, declarations, time, line_of(source.place));
  }
  return sources;
}

}  // namespace veritrack::certificates::code
