// The harness of a loop: three functions that veritrack calls, around those of the user.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "certificates/code/harness/candidates.hpp"
#include "certificates/code/harness/declarations.hpp"
#include "certificates/code/harness/frequency_source.hpp"

namespace veritrack::certificates::code {

/// What was chosen of a file.
struct HarnessPlan {
  std::vector<std::string> includes;  ///< files, named from the harness
  std::vector<std::string> renamed;   ///< functions of the file that have a name which the harness needs
  bool is_cpp = false;
  std::string source;  ///< the file as the user named it, for comments
  StepCandidate step;
  std::vector<StepCandidate> other_steps;
  std::vector<const Function*> inits;  ///< the first is called
  std::vector<FrequencySource> frequencies;
  std::optional<SampleTime> time;
  double sample_rate = 0.0;  ///< Hz; 0: the program has no time
  bool is_guessed_rate = false;
  HarnessNames names;
  bool has_own_object = false;  ///< the file declares it
};

/// Its text. What is guessed has a comment with the line that it is guessed from.
[[nodiscard]] std::string harness_text(const HarnessPlan& plan, const Declarations& declarations);

/// pll.c:24
[[nodiscard]] std::string at_line(const DeclarationPlace& place);

}  // namespace veritrack::certificates::code
