// The functions of formulas, and the names that have a meaning of their own.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trackers/model/straight_line_program.hpp"

namespace veritrack::certificates::language {

/// A function that formulas may use.
struct Function {
  std::string_view name;
  trackers::Operation operation;
  int arguments;
};

/// The function of that name; none if there is none.
[[nodiscard]] std::optional<Function> find_function(std::string_view name);

/// What to say about a function that formulas may not use: what is wrong with it, and what to write.
[[nodiscard]] std::string objection_to_function(std::string_view name);

/// What a name means whatever else is defined: "the circle constant"; empty for a name that is free.
[[nodiscard]] std::string_view reserved_meaning(std::string_view name);

}  // namespace veritrack::certificates::language
