// Elementary functions of intervals. The promise of interval.hpp applies: a function that is undefined or
// discontinuous somewhere on its argument gives the empty interval.
//
// sin and cos have a fast path (see elementary.cpp for the proof of its error); the others, and sin and cos
// of large arguments, evaluate MPFR with directed rounding at the endpoints.
#pragma once

#include <utility>

#include "analysis/rigor/interval.hpp"

namespace veritrack::rigor {

/// The tightest enclosure of the circle constant.
[[nodiscard]] Interval pi();

[[nodiscard]] Interval sin(const Interval& x);  ///< x in rad
[[nodiscard]] Interval cos(const Interval& x);  ///< x in rad
/// (sin x, cos x) with one argument reduction; the same enclosures as sin and cos.
[[nodiscard]] std::pair<Interval, Interval> sin_cos(const Interval& x);
/// Empty when x contains a pole.
[[nodiscard]] Interval tan(const Interval& x);
[[nodiscard]] Interval atan(const Interval& x);
/// The angle of (x, y) in (-pi, pi], rad. Empty when the box contains the origin or touches the branch cut
/// {x < 0, y = 0} from below, across which the angle jumps.
[[nodiscard]] Interval atan2(const Interval& y, const Interval& x);
/// In [-pi/2, pi/2] and [0, pi], rad. Empty unless x lies in [-1, 1].
[[nodiscard]] Interval asin(const Interval& x);
[[nodiscard]] Interval acos(const Interval& x);
[[nodiscard]] Interval exp(const Interval& x);
/// Empty unless x lies above zero.
[[nodiscard]] Interval log(const Interval& x);
/// x. Empty unless x certainly lies above low and below high.
[[nodiscard]] Interval stays_within(const Interval& x, const Interval& low, const Interval& high);

}  // namespace veritrack::rigor
