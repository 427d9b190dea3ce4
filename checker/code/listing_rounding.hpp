// What a program's step in IEEE arithmetic is off from the same operations on real numbers, from its listing.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "checker/code/listing.hpp"
#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// Half of a unit in the last place of 1.
inline double half_unit(ListedFormat format) {
  return format.bits == 32 ? 0x1p-24 : 0x1p-53;
}

/// What a program adds to a number by constants.
struct ListedShift {
  double by = 0.0;
  double roundings = 0.0;  ///< the sum of the units of roundoff of its operations and conversions
};

/// A register that is its base less whole turns, and how it may get there.
struct ListedWrap {
  int base = -1;
  double largest = 0.0;             ///< of the sizes of the base and of the register, rad
  std::vector<ListedShift> shifts;  ///< the ways to it
  bool is_limited = false;          ///< the exact value is shown to be within 3.14 of 0
  bool is_of_any_base = false;      ///< x - T*rint(x*(1/T)): the ways follow from the size of the base
};

/// A number that a program is given in its format.
struct ListedNumber {
  Ball exact;
  double value = 0.0;
};

/// A register whose exact value is shown to stay between two others, which are made of numbers.
struct ListedLimit {
  int place = -1;
  int low = -1;
  int high = -1;
};

/// The ranges that wraps keep angles in; and what else is known of formulas that are written.
struct ListedAngles {
  std::map<int, ListedWrap> wraps;      ///< by register
  std::map<int, Ball> states;           ///< by the register of an angle
  std::map<int, ListedNumber> numbers;  ///< by register, which is an input
  std::vector<ListedLimit> limits;
  std::map<int, Ball> arcs;  ///< where exact angles of samples that are turned back are shown to be
  std::vector<std::pair<int, int>> ordered;  ///< limits of clamps: the first has to be less
  Ball least_sample;                         ///< the vector of two samples is at least as long
};

/// At least |computed - exact| of each next state, of an angle modulo turns; then of the frequency.
/// Operations are rounded to nearest, products and sums fused or not, results below the normal range kept or
/// flushed to 0; sinf and cosf within 1.5 * 2^-24 for arguments up to 8, other functions of the library
/// within two units in the last place. Nothing where no bound is certain. `states`: those that are no angles,
/// by their number.
std::optional<std::vector<Ball>> listing_rounding(const CodeListing& listing, const ListedAngles& angles,
                                                  const std::vector<Ball>& states, const Ball& sample);

}  // namespace veritrack::checker
