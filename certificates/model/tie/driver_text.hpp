// The sources that are compiled together with the user's files, so that steps can be run from any state.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trackers/code/listing.hpp"

namespace veritrack::certificates::tie {

/// What a program made of these sources is asked, as the first word of its input. The next words are the
/// number of requests, and the requests; its output are its answers. A word has eight bytes, the lowest
/// first.
enum class Question : int {
  start,   ///< no request; answer: the states after setup, and the frequency
  keep,    ///< states; answer: the states that the program then has
  step,    ///< states and samples; answer: the states after the step, and the frequency before it
  library  ///< the number of a function in library_functions(), two arguments; answer: its result
};

/// How the code of the user's files reaches a state: the file, by its number, and an expression of C.
struct StateAccess {
  std::size_t file = 0;
  std::string expression;
};

/// A file of the user's, and functions that set and get state number `state`, whose format is `format`.
[[nodiscard]] std::string access_text(std::size_t state, trackers::code::Format format,
                                      const std::string& expression);

/// The line that includes the user's file.
[[nodiscard]] std::string include_text(const std::filesystem::path& file);

/// Functions that call setup, step and frequency, which the user's file before it declares.
[[nodiscard]] std::string harness_text(const trackers::code::Listing& listing);

/// `main`, which reads questions from the file `in` and writes answers to `out`.
[[nodiscard]] std::string main_text(const trackers::code::Listing& listing, const std::filesystem::path& in,
                                    const std::filesystem::path& out);

/// Expressions that the name of a state in the listing may stand for: itself, and with indices, since "x_2"
/// is a name of x[2], too.
[[nodiscard]] std::vector<std::string> expressions_of(const std::string& state_name);

}  // namespace veritrack::certificates::tie
