#include "certificates/model/language/vocabulary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "certificates/design/input_error.hpp"
#include "certificates/design/nearest_key.hpp"
#include "certificates/model/language/written_out.hpp"

namespace veritrack::certificates::language {

namespace {

using trackers::Operation;

constexpr std::array kFunctions{
    Function{"sqrt", Operation::sqrt, 1},
    Function{"exp", Operation::exp, 1},
    Function{"log", Operation::log, 1},
    Function{"sin", Operation::sin, 1},
    Function{"cos", Operation::cos, 1},
    Function{"tan", Operation::tan, 1},
    Function{"asin", Operation::asin, 1},
    Function{"acos", Operation::acos, 1},
    Function{"atan", Operation::atan, 1},
    Function{"atan2", Operation::atan2, 2},
    Function{"stays_within", Operation::stays_within, 3},
};

/// Functions that have a kink or a jump.
constexpr std::array<std::string_view, 16> kNotSmooth{
    "min",   "max",  "fmin", "fmax",     "floor",     "ceil", "round", "trunc",
    "clamp", "clip", "sat",  "saturate", "heaviside", "if",   "step",  "limit"};

constexpr std::size_t kShownOfFunction = 40;

}  // namespace

std::optional<Function> find_function(std::string_view name) {
  const auto* const found = std::find_if(kFunctions.begin(), kFunctions.end(),
                                         [&](const Function& function) { return function.name == name; });
  return found != kFunctions.end() ? std::optional(*found) : std::nullopt;
}

std::string objection_to_function(std::string_view name) {
  const std::string shown = printable(name, kShownOfFunction);
  if (name == "mod" || name == "fmod" || name == "remainder") {
    return fmt::format(
        "{} is not smooth; allowed here: wrap(x), which brings an angle between -pi and pi, or a state "
        "that is named in angles",
        shown);
  }
  if (name == "abs" || name == "fabs") {
    return fmt::format("{} is not smooth; allowed here: sqrt(x^2), where x stays away from 0 in lock", shown);
  }
  if (name == "sign" || name == "sgn") {
    return fmt::format("{} is not smooth; allowed here: x/sqrt(x^2), where x stays away from 0 in lock",
                       shown);
  }
  if (std::find(kNotSmooth.begin(), kNotSmooth.end(), name) != kNotSmooth.end()) {
    return fmt::format(
        "{} is not smooth; allowed here: stays_within(x, low, high), which is x, if {} never acts in lock "
        "(it is "
        "proved then that low < x < high)",
        shown, shown);
  }
  if (name == "pow") {
    return "pow is unknown; allowed: x^n with a whole exponent, sqrt(x), or exp(p*log(x))";
  }
  std::vector<std::string> names;
  names.reserve(std::size(kFunctions));
  for (const Function& function : kFunctions) {
    names.emplace_back(function.name);
  }
  names.insert(names.end(), written_out_functions().begin(), written_out_functions().end());
  return fmt::format("unknown function {}; nearest: {}; allowed: {}", shown, nearest_key(name, names),
                     fmt::join(names, ", "));
}

std::string_view reserved_meaning(std::string_view name) {
  if (name == "pi") {
    return "the circle constant";
  }
  if (name == "omega") {
    return "the true frequency";
  }
  if (name == "phi") {
    return "the phase of the tone";
  }
  if (name == "A") {
    return "the amplitude of the tone";
  }
  const std::vector<std::string>& others = written_out_functions();
  return find_function(name) || std::find(others.begin(), others.end(), name) != others.end() ? "a function"
                                                                                              : "";
}

}  // namespace veritrack::certificates::language
