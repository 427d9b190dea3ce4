// Elementary functions of one double, rounded in a direction: MPFR at 53 bits, which rounds correctly. For
// use inside analysis/rigor. The functions work under any rounding mode of the caller, from any thread, and
// allocate nothing that outlives the thread.
#pragma once

#include "analysis/rigor/decimal.hpp"

namespace veritrack::rigor::detail {

// The largest double below (Direction::down), or the smallest above (Direction::up), the function's value at
// x; the value itself where it is a double. Infinite where the value lies outside the range of double in the
// direction asked for. Infinite arguments stand for limits; arguments outside the domain give NaN. Angles in
// rad.

[[nodiscard]] double reference_sin(double x, Direction direction);
[[nodiscard]] double reference_cos(double x, Direction direction);
[[nodiscard]] double reference_tan(double x, Direction direction);
[[nodiscard]] double reference_atan(double x, Direction direction);
/// The angle of (x, y) in [-pi, pi]; y = -0.0 is the lower bank of the branch cut.
[[nodiscard]] double reference_atan2(double y, double x, Direction direction);
[[nodiscard]] double reference_exp(double x, Direction direction);
[[nodiscard]] double reference_log(double x, Direction direction);

}  // namespace veritrack::rigor::detail
