// Straight-line programs as formulas of a programming language.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trackers/model/straight_line_program.hpp"

namespace veritrack::certificates {

/// The notation of formulas.
struct FormulaSyntax {
  std::string_view power;  ///< operator of powers; empty: the function power(x, n)

  std::string_view function_prefix;  ///< before sqrt and the like
};

/// A line `name = formula`.
struct Assignment {
  std::string name;
  std::string formula;
};

/// The lines that compute the results of a program. `inputs` are the names of its inputs, `names` those of
/// registers that have one, `results` those of the results. A register without a name that is used more than
/// once gets one that begins with `prefix`.
[[nodiscard]] std::vector<Assignment> assignments(const trackers::StraightLineProgram& program,
                                                  const std::vector<std::string>& inputs,
                                                  const std::map<int, std::string>& names,
                                                  const std::vector<std::string>& results,
                                                  std::string_view prefix, const FormulaSyntax& syntax);

/// The x of atan2(sin(x), cos(x)), as wrap(x) is written out.
[[nodiscard]] std::optional<int> what_is_wrapped(const trackers::StraightLineProgram& program,
                                                 const trackers::Instruction& made);

/// The formula of a register, in terms of inputs and named registers; with wrap(x), for messages.
[[nodiscard]] std::string formula_of(const trackers::StraightLineProgram& program,
                                     const std::vector<std::string>& inputs,
                                     const std::map<int, std::string>& names, int place);

}  // namespace veritrack::certificates
