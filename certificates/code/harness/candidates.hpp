// Which function of a file takes one sample, and which one prepares it.
#pragma once

#include <string>
#include <vector>

#include "certificates/code/harness/declarations.hpp"

namespace veritrack::certificates::code {

/// What a parameter of a step is given.
enum class Role {
  sample,  ///< a sample
  angle,   ///< the angle of two samples
  period,  ///< the time between samples
  object,  ///< the structure that holds the loop
  config,  ///< a variable of the file, which is only read
  output   ///< a number that the function writes
};

/// A function that may be the step.
struct StepCandidate {
  const Function* function = nullptr;
  std::vector<Role> roles;  ///< of its parameters
  int score = 0;            ///< the highest is the likeliest
  std::string why;          ///< what speaks for it, in words

  /// Samples of the harness: 1 or 2.
  [[nodiscard]] int samples() const;
  /// The type of what holds the loop, a class or what a parameter points to; empty: variables of the file.
  [[nodiscard]] std::string object_type() const;
};

/// A function that is no candidate, and why.
struct RefusedFunction {
  const Function* function = nullptr;
  std::string why;
};

struct StepCandidates {
  std::vector<StepCandidate> taken;  ///< the likeliest first
  std::vector<RefusedFunction> refused;
};

/// Of the functions that `file` defines.
[[nodiscard]] StepCandidates step_candidates(const Declarations& declarations, const std::string& file);

/// Functions that prepare the step, the likeliest first: they have the same object and no sample.
[[nodiscard]] std::vector<const Function*> init_candidates(const Declarations& declarations,
                                                           const std::string& file,
                                                           const StepCandidate& step);

/// True for a function of no parameters, or of the object alone, that returns a number and writes nothing.
[[nodiscard]] bool reads_a_number(const Function& function, const StepCandidate& step,
                                  const Declarations& declarations);

/// A variable of the file that holds the object, where there is one only; nullptr otherwise.
[[nodiscard]] const Variable* object_in_file(const Declarations& declarations, const std::string& type);

}  // namespace veritrack::certificates::code
