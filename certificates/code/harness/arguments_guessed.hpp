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
  std::string summary;               ///< "kp = 1600.0f, ki = 20000.0f"; empty: nothing is guessed
  std::string advice;                ///< a sentence on what to do
  std::vector<std::string> numbers;  ///< the names of those that are guesses
};

/// The arguments for these parameters: the object, a variable of the file, or a guess by the name. What
/// suggests nothing becomes a name that does not compile, PUT_gamma_HERE.
[[nodiscard]] GuessedArguments guessed_arguments(const std::vector<Variable>& parameters,
                                                 const HarnessPlan& plan, const Declarations& declarations,
                                                 const GuessContext& context);

/// The constructor that the harness calls; nullptr: none, or one that takes nothing.
[[nodiscard]] const Function* called_constructor(const HarnessPlan& plan, const Declarations& declarations);

/// The names of all numbers that the harness sets, and the file does not.
[[nodiscard]] std::vector<std::string> guessed_numbers(const HarnessPlan& plan,
                                                       const Declarations& declarations);

/// Members of the object that nothing in the file sets.
[[nodiscard]] std::vector<const Variable*> open_members(const HarnessPlan& plan,
                                                        const Declarations& declarations);

/// Statements for members of the object that nothing in the file sets, such as gains.
[[nodiscard]] std::string members_left_open(const HarnessPlan& plan, const Declarations& declarations,
                                            const GuessContext& context);

[[nodiscard]] GuessContext guess_context(const HarnessPlan& plan, const Declarations& declarations);

/// The object or a variable, as this parameter takes it.
[[nodiscard]] std::string object_argument(const Variable& parameter, const std::string& object);

/// The name of a function in the harness, where those of the file are renamed.
[[nodiscard]] std::string called_name(const HarnessPlan& plan, const Function& function);

}  // namespace veritrack::certificates::code
