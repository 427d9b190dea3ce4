// Source code in, listings and compiled programs out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "trackers/code/listing.hpp"

namespace veritrack::lift {

/// A listing, or the message of the error that there is instead, "file:line:column: what".
struct LiftResult {
  trackers::code::Listing listing;
  std::string error;
};

/// The file compiled by clang-14 as for [code], and lifted. `flags` come last.
[[nodiscard]] LiftResult lift_file(const std::filesystem::path& source, const std::string& flags = "");
/// A text as a file of that name in an empty folder.
[[nodiscard]] LiftResult lift_text(const std::string& text, const std::string& name = "step.c",
                                   const std::string& flags = "");

/// The bits of states and samples before steps, and those of the states and of the frequency that result.
struct Runs {
  std::vector<std::vector<std::uint64_t>> before;  ///< states, then samples
  std::vector<std::uint64_t> start;                ///< states and frequency after setup
  std::vector<std::vector<std::uint64_t>> after;   ///< states after the step, then the frequency before it
};

/// Runs a program made of the file and a `main` of ours, compiled by `compiler` (with its flags; gcc or
/// clang, or its name for C++), from each of `steps.before`. `expressions` say what a state is in the source,
/// where its name in the listing does not.
void run_compiled(const std::filesystem::path& source, const std::string& compiler,
                  const trackers::code::Listing& listing,
                  const std::map<std::string, std::string>& expressions, Runs& steps);

}  // namespace veritrack::lift
