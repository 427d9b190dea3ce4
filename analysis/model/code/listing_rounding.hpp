// What rounding adds to a step of a program: a bound on what its registers are off from the same operations
// on real numbers.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "analysis/model/code/turns.hpp"
#include "analysis/rigor/interval.hpp"
#include "trackers/code/listing.hpp"

namespace veritrack::model::code {

/// Bounds on |computed - exact|, where the exact step begins with the states and samples that the program
/// has.
struct StepRounding {
  std::vector<double>
      next;  ///< of the states; of an angle modulo whole turns; at least that of storing the state
  double frequency = 0.0;  ///< rad/sample
};

/// The ranges of what goes into a step.
struct StepRanges {
  std::vector<rigor::Interval> states;
  rigor::Interval sample;
  /// Of the registers that are wrapped, by what is wrapped; each is certain where steps of angles are below
  /// half a turn.
  std::map<int, Range> bases;
};

/// Differences of angles that are used as numbers are assumed to stay within this, rad: then a wrap does not
/// tear them.
inline constexpr double kMostOfWrapped = 3.14;

/// For operations of IEEE 754, each rounded to nearest, products and sums fused or not, results below the
/// normal range kept or flushed to 0; sine and cosine in single precision within 1.5 * 2^-24, other functions
/// of the library within two units in the last place. Empty where no bound is known: an operation without
/// one, a branch that is not decided and jumps, a division by what may be 0, a result that may overflow.
/// `without` gets the first operation that has none. Needs the upward rounding mode.
[[nodiscard]] std::optional<StepRounding> step_rounding(const trackers::code::Listing& listing,
                                                        const StepRanges& ranges, int* without = nullptr);

}  // namespace veritrack::model::code
