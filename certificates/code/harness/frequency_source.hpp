// Where a program keeps its estimate of the frequency, and in which unit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "certificates/code/harness/candidates.hpp"
#include "certificates/code/harness/declarations.hpp"

namespace veritrack::certificates::code {

/// The time between samples in the program: an expression, and its value in seconds where the file says it.
struct SampleTime {
  std::string expression;    ///< seconds, or samples a second
  bool is_rate = false;      ///< samples a second
  std::string name;          ///< of the variable
  DeclarationPlace place;    ///< line 0: it is a parameter of the step, or not in the file at all
  std::optional<double> hz;  ///< samples a second
};

enum class FrequencyUnit { radians_per_sample, radians_per_second, hertz };

struct FrequencySource {
  std::string expression;  ///< in C, without the factor of its unit
  std::string name;
  DeclarationPlace place;
  FrequencyUnit unit = FrequencyUnit::radians_per_sample;
  std::string why_unit;  ///< in words
  int score = 0;
  bool is_result = false;  ///< what the step returns
};

/// A line of a source file, for its comment.
using LineReader = std::string (*)(const DeclarationPlace&);

/// How the harness writes the object and the outputs of the step.
struct HarnessNames {
  std::string object;   ///< an expression; empty: there is none
  std::string result;   ///< a variable for what the step returns
  std::string outputs;  ///< what names of variables for outputs begin with
};

/// The time between samples, as a member of the object, a variable, a macro, or a parameter of the step.
[[nodiscard]] std::optional<SampleTime> sample_time(const Declarations& declarations,
                                                    const StepCandidate& step, const HarnessNames& names,
                                                    const std::string& source_text, const std::string& file);

/// The likeliest first; empty: nothing has such a name, and the step returns no number.
[[nodiscard]] std::vector<FrequencySource> frequency_sources(const Declarations& declarations,
                                                             const StepCandidate& step,
                                                             const HarnessNames& names,
                                                             const std::optional<SampleTime>& time,
                                                             const std::string& file, LineReader line_of);

}  // namespace veritrack::certificates::code
