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

/// The function of that name; empty if there is none.
[[nodiscard]] std::optional<Function> find_function(std::string_view name);

/// The message about a function that formulas may not use: the fault, and what to write instead.
[[nodiscard]] std::string objection_to_function(std::string_view name);

/// The fixed meaning of a name: "the circle constant"; empty for a name that is free.
[[nodiscard]] std::string_view reserved_meaning(std::string_view name);

}  // namespace veritrack::certificates::language
