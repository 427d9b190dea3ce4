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
    Function{"min", Operation::minimum, 2},
    Function{"max", Operation::maximum, 2},
    Function{"abs", Operation::absolute, 1},
    Function{"sign", Operation::sign, 1},
    Function{"clamp", Operation::clamp, 3},
    Function{"if", Operation::choose, 3},
};

/// Names that other languages have for functions of this one.
struct Synonym {
  std::string_view name, instead;
};
constexpr std::array kSynonyms{
    Synonym{"mod", "wrap(x), which brings an angle between -pi and pi, or a state that is named in angles"},
    Synonym{"fmod", "wrap(x), which brings an angle between -pi and pi, or a state that is named in angles"},
    Synonym{"remainder",
            "wrap(x), which brings an angle between -pi and pi, or a state that is named in angles"},
    Synonym{"fabs", "abs(x)"},
    Synonym{"sgn", "sign(x), which is 1, -1, or 0 at 0"},
    Synonym{"signum", "sign(x), which is 1, -1, or 0 at 0"},
    Synonym{"fmin", "min(x, y)"},
    Synonym{"fmax", "max(x, y)"},
    Synonym{"clip", "clamp(x, low, high)"},
    Synonym{"sat", "clamp(x, low, high)"},
    Synonym{"saturate", "clamp(x, low, high)"},
    Synonym{"constrain", "clamp(x, low, high)"},
    Synonym{"limit",
            "clamp(x, low, high); or stays_within(x, low, high), which is x and never acts: it is proved "
            "then that low < x < high"},
    Synonym{"heaviside", "if(x > 0, 1, 0)"},
    Synonym{"step", "if(x > 0, 1, 0)"},
    Synonym{"where", "if(x > y, a, b)"},
    Synonym{"select", "if(x > y, a, b)"},
    Synonym{"ternary", "if(x > y, a, b)"},
};

/// Functions that jump again and again: nothing is known of where.
constexpr std::array<std::string_view, 5> kRounding{"floor", "ceil", "round", "trunc", "rint"};

constexpr std::size_t kShownOfFunction = 40;

}  // namespace

std::optional<Function> find_function(std::string_view name) {
  const auto* const found = std::find_if(kFunctions.begin(), kFunctions.end(),
                                         [&](const Function& function) { return function.name == name; });
  return found != kFunctions.end() ? std::optional(*found) : std::nullopt;
}

std::string objection_to_function(std::string_view name) {
  const std::string shown = printable(name, kShownOfFunction);
  const auto* const synonym = std::find_if(kSynonyms.begin(), kSynonyms.end(),
                                           [&](const Synonym& each) { return each.name == name; });
  if (synonym != kSynonyms.end()) {
    return fmt::format("unknown function {}; allowed: {}", shown, synonym->instead);
  }
  if (std::find(kRounding.begin(), kRounding.end(), name) != kRounding.end()) {
    return fmt::format(
        "{} rounds, which cannot be certified; allowed: the value without it, with a noise that includes the "
        "rounding of the sample",
        shown);
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
