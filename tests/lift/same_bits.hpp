// A listing and the program that it was made of, from random states.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "tests/lift/lifting.hpp"
#include "trackers/code/listing.hpp"

namespace veritrack::lift {

inline constexpr int kSteps = 3000;

/// Random states and samples, and what the listing makes of them, for steps that have to be defined.
[[nodiscard]] Runs expected_steps(const trackers::code::Listing& listing);

/// The steps in which some bits differ; results that are no numbers are equal.
[[nodiscard]] int differences(const trackers::code::Listing& listing, const Runs& expected,
                              const Runs& compiled);

/// Lifts the text, compiles it by gcc -O0 and gcc -O2, and compares; an error or a difference fails the test.
[[nodiscard]] trackers::code::Listing check_same_bits(
    const std::string& text, const std::string& name = "step.c",
    const std::map<std::string, std::string>& expressions = {});

}  // namespace veritrack::lift
