// What a program that rounds is off in a step of its recursion, as long as its states stay in ranges.
#pragma once

#include <functional>
#include <stdexcept>
#include <vector>

#include "analysis/rigor/interval.hpp"

namespace veritrack::model {

/// No bound is known; what() says of what.
class NoRounding : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Bounds on what a program is off in a step, of the states and of the frequency that it reports, for these
/// ranges of its states and samples; those of angles are not asked for. Throws NoRounding.
using RoundingOfStep = std::function<std::vector<double>(const std::vector<rigor::Interval>& states,
                                                         const rigor::Interval& sample)>;

/// The noise of a program that rounds is at most this share of the amplitude: a vector of two samples has a
/// direction in its format.
inline constexpr double kMostNoise = 1.0 - 0x1p-10;

/// The rounding of a program while its states are near a steady state.
struct ProgramRounding {
  std::vector<double> room;  ///< by state: how far it may be from the steady state; infinite for angles
  RoundingOfStep of_step;    ///< empty: nothing is rounded
};

}  // namespace veritrack::model
