// What rounding adds to a step of a program: a bound on what its registers are off from the same operations
// on real numbers.
#pragma once

#include <map>
#include <optional>
#include <utility>
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

/// A number that a program is given in its format.
struct RoundedNumber {
  rigor::Interval exact;
  double value = 0.0;
};

/// A register whose exact value is proved to stay between two others, which are made of numbers.
struct RegisterLimit {
  int value = -1;
  int low = -1;
  int high = -1;
};

/// What is known of the listing of a recursion that is written as formulas.
struct WrittenFacts {
  std::map<int, RoundedNumber> numbers;  ///< by register, which is an input
  std::vector<RegisterLimit> limits;
  /// Limits of clamps, which have to be in this order: then a clamp is a maximum and a minimum.
  std::vector<std::pair<int, int>> ordered;
};

/// The ranges of what goes into a step.
struct StepRanges {
  std::vector<rigor::Interval> states;
  rigor::Interval sample;
  /// Of the registers that are wrapped, by what is wrapped; each is certain where steps of angles are below
  /// half a turn.
  std::map<int, Range> bases;
  const WrittenFacts* facts = nullptr;  ///< or none
  double least_sample = 0.0;            ///< at most the length of the vector of two samples
};

/// Differences of angles that are used as numbers, and in a listing of code the angles of samples that are
/// turned back, are assumed to stay within this, rad: then a wrap or the jump of atan2 does not tear them.
inline constexpr double kMostOfWrapped = 3.14;

/// For operations of IEEE 754, each rounded to nearest, products and sums fused or not, results below the
/// normal range kept or flushed to 0; sine and cosine in single precision within 1.5 * 2^-24, other functions
/// of the library within two units in the last place. What is wrapped in a written recursion and has no entry
/// among the bases has the range of its value. Empty where no bound is known: an operation without
/// one, a branch that is not decided and jumps, a division by what may be 0, a result that may overflow.
/// `without` gets the first operation that has none. Needs the upward rounding mode.
[[nodiscard]] std::optional<StepRounding> step_rounding(const trackers::code::Listing& listing,
                                                        const StepRanges& ranges, int* without = nullptr);

}  // namespace veritrack::model::code
