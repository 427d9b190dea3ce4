// A program's rounding as inputs of a loop about its steady state (docs/gain-proof.md, section 10).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "checker/model/gain/gain_network.hpp"

namespace veritrack::checker {

/// A program's rounding while its states stay within their room.
struct GainRounding {
  std::vector<Ball> room;  ///< by state: from the steady state; of angles 0, which have no limit
  std::vector<Ball> next;  ///< by state: what a step is off
  Ball frequency;          ///< what the reported frequency is off
};

/// What a program is off in a step: by state, then of the frequency; for states that are no angles in these
/// ranges, and samples. Nothing where no bound is known.
using RoundingOfStep =
    std::function<std::optional<std::vector<Ball>>(const std::vector<Ball>& states, const Ball& sample)>;

/// Noise is at most this share of the amplitude where a program rounds: a vector of two samples has a
/// direction in its format.
constexpr double kMostRoundedNoise = 1.0 - 0x1p-10;

/// The values of each state in its room at the frequencies of a band; of an angle nothing that is finite.
std::vector<Ball> states_within(const std::vector<Ball>& room, const std::vector<SteadyState>& steady,
                                const std::vector<bool>& is_angle, const Ball& lowest, const Ball& highest);

/// Adds an input to each state, and the limits to their room. Throws NotCovered for vectors and in one
/// channel.
void add_rounding(const GainRounding& rounding, const std::vector<bool>& is_angle, GainNetwork& network);

}  // namespace veritrack::checker
