// What a harness hands to the functions of the user.
#pragma once

#include <string>
#include <vector>

#include "certificates/code/harness/declarations.hpp"
#include "certificates/code/harness/guesses.hpp"
#include "certificates/code/harness/harness.hpp"

namespace veritrack::certificates::code {

struct GuessedArguments {
  std::vector<std::string> values;
  std::string summary;  ///< "kp = 1600.0f, ki = 20000.0f"; empty: nothing is guessed
  std::string advice;   ///< a sentence on what to do
};

/// The arguments for these parameters: the object, a variable of the file, or a guess by the name. What
/// suggests nothing becomes a name that does not compile, PUT_gamma_HERE.
[[nodiscard]] GuessedArguments guessed_arguments(const std::vector<Variable>& parameters,
                                                 const HarnessPlan& plan, const Declarations& declarations,
                                                 const GuessContext& context);

/// Statements for members of the object that nothing in the file sets, such as gains.
[[nodiscard]] std::string members_left_open(const HarnessPlan& plan, const Declarations& declarations,
                                            const GuessContext& context);

[[nodiscard]] GuessContext guess_context(const HarnessPlan& plan, const Declarations& declarations);

/// The object or a variable, as this parameter takes it.
[[nodiscard]] std::string object_argument(const Variable& parameter, const std::string& object);

/// The name of a function in the harness, where those of the file are renamed.
[[nodiscard]] std::string called_name(const HarnessPlan& plan, const Function& function);

}  // namespace veritrack::certificates::code
