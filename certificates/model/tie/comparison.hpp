// The steps of a built program beside those of the listing.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "certificates/model/tie/build.hpp"
#include "certificates/model/tie/evaluation.hpp"
#include "trackers/code/listing.hpp"

namespace veritrack::certificates::tie {

/// A value in which program and listing differ.
struct Difference {
  int value = -1;         ///< the number of a state; that of states: the frequency
  bool is_start = false;  ///< of the value after `setup`; otherwise of a step
  std::uint64_t in_program = 0;
  std::uint64_t in_listing = 0;
  StepInput before;  ///< of a step
};

/// One program, compared.
struct BuildResult {
  std::string build;
  int compared = 0;   ///< steps
  int different = 0;  ///< steps in which any value differs
  bool differs_at_start = false;
  std::optional<Difference> first;
  std::vector<double> largest;  ///< differences of numbers, by state, the frequency last
  std::map<int, int> left_out;  ///< steps that do not keep an obligation, by its number

  [[nodiscard]] bool is_equal() const { return !first.has_value(); }
};

/// Whether values are the same: bits, where any two that are no numbers are equal.
[[nodiscard]] bool are_equal(trackers::code::Format format, std::uint64_t a, std::uint64_t b);

/// Runs the program from each of the steps, and the listing from what the program then has in its states,
/// with the results of the program's own library. Steps that do not keep an obligation are not run. Throws
/// BuildError.
[[nodiscard]] BuildResult compared(const trackers::code::Listing& listing, const BuiltProgram& program,
                                   const std::vector<StepInput>& steps);

}  // namespace veritrack::certificates::tie
