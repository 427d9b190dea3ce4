// Numbers for what a file leaves open: gains, a sample rate.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "certificates/code/harness/frequency_source.hpp"

namespace veritrack::certificates::code {

/// What is known when a number is guessed.
struct GuessContext {
  double sample_rate = 1.0;  ///< Hz; 1 where the program has no time
  FrequencyUnit unit = FrequencyUnit::radians_per_sample;
  bool is_double = false;
  /// True for a name that the file multiplies by the time between samples.
  std::function<bool(const std::string&)> is_times_period;
};

/// A number of C for a parameter or a member of that name: those of a loop with about 0.16 and 0.0002 a
/// sample for its phase and its frequency. None for a name that suggests nothing.
[[nodiscard]] std::optional<std::string> guessed_number(const std::string& name, const GuessContext& context);

/// A literal of C: 0.5f, 2000.0.
[[nodiscard]] std::string number_literal(double value, bool is_double);

}  // namespace veritrack::certificates::code
