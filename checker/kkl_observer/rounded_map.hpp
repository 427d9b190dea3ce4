// Bounds on the distance of a KKL observer's estimates in double precision from the exact ones of the same
// filter states (docs/rounding.md, The KKL observer).
#pragma once

#include "checker/kkl_observer/moves.hpp"

namespace veritrack::checker {

/// Facts about filter states xi, at any scale: 2 |M xi|^2 >= largest_ell |xi|^2, and the exact estimates.
struct FilterStates {
  Filters lambda;  ///< 1/s; the program holds a double in each ball
  Ball ell;        ///< in use in (9)
  Ball largest_ell;
  Ball least_square, most_square;  ///< of w_hat, (rad/s)^2
  Ball least_amplitude;            ///< A_hat / |xi|, 1/s
};

struct MapRounding {
  Ball frequency;  ///< rad/s
  Ball amplitude;  ///< over |xi|, 1/s
};

/// Sums the errors of the operations. Balls of everything where there is no bound, and always unless the
/// program computes that mu of (9) is zero.
MapRounding map_rounding(const FilterStates& states);

}  // namespace veritrack::checker
