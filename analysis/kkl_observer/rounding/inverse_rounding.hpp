// The rounding errors of the KKL observer's static map in double precision: docs/rounding.md, The KKL
// observer.
#pragma once

#include "analysis/rigor/matrix.hpp"

namespace veritrack::kkl_observer {

/// Filter states xi for which a certificate establishes that |M xi|^2 >= largest_ell / 2 |xi|^2 and that the
/// exact map gives an estimate in these ranges. All scales of xi between kSmallestFilters and
/// kLargestFilters.
template <int M>
struct FilterStatesOf {
  rigor::IntervalVector<M> lambda;    ///< filter rates, 1/s; the program holds a double in each
  rigor::Interval ell;                ///< in use in (9)
  rigor::Interval largest_ell;        ///< only its lower end is used
  rigor::Interval squared_frequency;  ///< the exact estimate of w^2, (rad/s)^2; certainly positive
  rigor::Interval least_amplitude;    ///< of the exact estimate, over |xi|, 1/s; not negative
};
using FilterStates = FilterStatesOf<4>;

/// No result is below 2^-480 times a power of |xi| up to the second, so that underflow stays below the
/// allowance of rigor::Rounded, and none above 2^540 times one overflows.
inline constexpr double kSmallestFilters = 0x1p-240;
inline constexpr double kLargestFilters = 0x1p240;

/// Bounds on |computed - exact|; infinite when there is none.
struct InverseRounding {
  double frequency;  ///< rad/s
  double amplitude;  ///< over |xi|, 1/s
};

/// By running error analysis of trackers::kkl_inverse and in_engineering_units as they are, over all such
/// states at |xi| = 1. Finite only when the program computes that mu of (9) is exactly zero. For four to
/// eight filters. Needs the upward mode.
template <int M>
[[nodiscard]] InverseRounding inverse_rounding(const FilterStatesOf<M>& states);

}  // namespace veritrack::kkl_observer
