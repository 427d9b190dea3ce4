// Formulas to straight-line programs: names are looked up, and definitions put in order.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "certificates/model/language/constants.hpp"
#include "certificates/model/language/expression.hpp"
#include "trackers/model/straight_line_program.hpp"

namespace veritrack::certificates::language {

/// A program with the place in the file that each instruction came from.
struct CompiledProgram {
  trackers::StraightLineProgram program{0};
  std::vector<Position> positions;   ///< one for each instruction
  std::map<int, std::string> names;  ///< of registers that a definition has given a name to
  /// The registers of all names, including later ones for the same register: one register may have several.
  std::map<std::string, int> places;
};

/// The program for these formulas, whose results are their values in that order. Inputs: the constants, then
/// the `inputs` by name. Throws LanguageError with the nearest known name.
[[nodiscard]] CompiledProgram compile_formulas(const std::vector<const Expression*>& formulas,
                                               const Constants& constants,
                                               const std::vector<std::string>& inputs);

/// The program for a step: the results are the next values of the `states`, in their order. Definitions may
/// stand in any order. Inputs: the constants, the states, the samples. Throws LanguageError.
[[nodiscard]] CompiledProgram compile_step(const std::vector<Definition>& definitions,
                                           const Constants& constants, const std::vector<std::string>& states,
                                           const std::vector<std::string>& samples, Position place_of_step);

/// Throws LanguageError unless the name is free: it is not a function and has no other meaning.
void require_free_name(std::string_view name, Position position);

}  // namespace veritrack::certificates::language
