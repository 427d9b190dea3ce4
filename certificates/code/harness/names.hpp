// What names in a program suggest.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace veritrack::certificates::code {

/// The words of a name, in small letters: `pll_runFast2` has pll, run, fast, 2.
[[nodiscard]] std::vector<std::string> words_of_name(std::string_view name);

/// The name without its namespaces.
[[nodiscard]] std::string last_name(std::string_view name);

[[nodiscard]] bool has_word(std::string_view name, std::initializer_list<std::string_view> words);

/// How much a name suggests a step: 2 by what it does, 1 by what it is about, 0 not at all.
[[nodiscard]] int step_likeness(std::string_view name);

/// Of a function that prepares a step, of the time between samples in seconds, of samples a second,
/// of an angle.
[[nodiscard]] bool is_named_like_init(std::string_view name);
[[nodiscard]] bool is_named_like_period(std::string_view name);
[[nodiscard]] bool is_named_like_sample_rate(std::string_view name);
[[nodiscard]] bool is_named_like_angle(std::string_view name);

/// How much a name suggests the estimate of a frequency: 0 is not at all.
[[nodiscard]] int frequency_likeness(std::string_view name);

}  // namespace veritrack::certificates::code
