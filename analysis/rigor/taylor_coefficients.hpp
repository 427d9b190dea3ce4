// Taylor coefficients of elementary functions.
#pragma once

#include <array>
#include <cstddef>

#include "analysis/rigor/interval.hpp"

namespace veritrack::rigor {

/// f^(k)(t)/k! for k = 0, ..., 5.
using TaylorCoefficients = std::array<Interval, 6>;

// Enclosures for all points of t; entries are empty where the function is not smooth on t. Need the upward
// mode.
[[nodiscard]] TaylorCoefficients taylor_of_reciprocal(const Interval& t);
[[nodiscard]] TaylorCoefficients taylor_of_sqrt(const Interval& t);
[[nodiscard]] TaylorCoefficients taylor_of_exp(const Interval& t);
[[nodiscard]] TaylorCoefficients taylor_of_log(const Interval& t);
[[nodiscard]] TaylorCoefficients taylor_of_sin(const Interval& t);
[[nodiscard]] TaylorCoefficients taylor_of_cos(const Interval& t);
[[nodiscard]] TaylorCoefficients taylor_of_tan(const Interval& t);
[[nodiscard]] TaylorCoefficients taylor_of_asin(const Interval& t);
[[nodiscard]] TaylorCoefficients taylor_of_acos(const Interval& t);
[[nodiscard]] TaylorCoefficients taylor_of_atan(const Interval& t);

}  // namespace veritrack::rigor
