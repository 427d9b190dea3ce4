#include "analysis/rigor/elementary.hpp"

#include "analysis/rigor/mpfr_reference.hpp"
#include "analysis/rigor/quarter_turns.hpp"

namespace veritrack::rigor {

Interval pi() {
  return Interval::from_bounds(0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1);
}

Interval exp(const Interval& x) {
  if (is_empty(x)) {
    return x;
  }
  return Interval::from_bounds(detail::reference_exp(x.lower(), Direction::down),
                               detail::reference_exp(x.upper(), Direction::up));
}

Interval log(const Interval& x) {
  const bool defined = x.lower() > 0.0 && x.lower() <= x.upper();
  if (!defined) {
    return Interval::empty();
  }
  return Interval::from_bounds(detail::reference_log(x.lower(), Direction::down),
                               detail::reference_log(x.upper(), Direction::up));
}

Interval atan(const Interval& x) {
  if (is_empty(x)) {
    return x;
  }
  return Interval::from_bounds(detail::reference_atan(x.lower(), Direction::down),
                               detail::reference_atan(x.upper(), Direction::up));
}

Interval tan(const Interval& x) {
  require_upward_rounding();
  if (!is_finite(x)) {
    return Interval::empty();  // empty, or a half-line, which contains poles
  }
  const double lower = detail::reference_tan(x.lower(), Direction::down);
  const double upper = detail::reference_tan(x.upper(), Direction::up);
  // No double is a pole, so a point never contains one. Were there one pole inside [a, b] with b - a < pi,
  // then b - pi < a on the same branch, and tan b < tan a. Hence tan a <= tan b with b - a < pi excludes
  // poles; it decides the narrow intervals, down to one unit in the last place, and the count of quarter
  // turns decides the others.
  const bool is_point = x.lower() == x.upper();
  const bool is_rising = width(x) <= pi().lower() && detail::reference_tan(x.lower(), Direction::up) <=
                                                         detail::reference_tan(x.upper(), Direction::down);
  if (is_point || is_rising || !detail::may_contain_quarter_turn(x, 1, 2)) {
    return Interval::from_bounds(lower, upper);
  }
  return Interval::empty();
}

namespace {

/// atan2 over a box with y >= 0 that does not contain the origin. There the angle decreases with x; with y it
/// increases where x > 0 and decreases where x < 0: its extremes are at corners, none of which is infinite in
/// both coordinates.
Interval upper_half_plane_angle(const Interval& y, const Interval& x) {
  const double y_of_smallest = x.upper() >= 0.0 ? y.lower() : y.upper();
  const double y_of_largest = x.lower() >= 0.0 ? y.upper() : y.lower();
  // std::fabs: a lower bound of -0.0 is the number zero, not the other side of the branch cut.
  return Interval::from_bounds(detail::reference_atan2(std::fabs(y_of_smallest), x.upper(), Direction::down),
                               detail::reference_atan2(std::fabs(y_of_largest), x.lower(), Direction::up));
}

}  // namespace

Interval atan2(const Interval& y, const Interval& x) {
  if (is_empty(y) || is_empty(x)) {
    return Interval::empty();
  }
  if (x.lower() > 0.0 && contains(y, 0.0)) {
    return Interval::from_bounds(detail::reference_atan2(y.lower(), x.lower(), Direction::down),
                                 detail::reference_atan2(y.upper(), x.lower(), Direction::up));
  }
  if (y.upper() < 0.0) {
    return -upper_half_plane_angle(-y, x);
  }
  if (y.lower() > 0.0 || (y.lower() == 0.0 && x.upper() < 0.0)) {
    return upper_half_plane_angle(y, x);
  }
  return Interval::empty();
}

namespace {

bool lies_in_unit_interval(const Interval& x) {
  return certainly_less_equal(Interval(-1.0), x) && certainly_less_equal(x, Interval(1.0));
}

/// sqrt(1 - x^2), which does not cancel where x is near 1 or -1.
Interval cosine_of_arc_sine(const Interval& x) {
  return sqrt((Interval(1.0) - x) * (Interval(1.0) + x));
}

}  // namespace

// Both are monotone, and arcs of points on the unit circle.
Interval asin(const Interval& x) {
  if (!lies_in_unit_interval(x)) {
    return Interval::empty();
  }
  const Interval lower(x.lower());
  const Interval upper(x.upper());
  return Interval::from_bounds(atan2(lower, cosine_of_arc_sine(lower)).lower(),
                               atan2(upper, cosine_of_arc_sine(upper)).upper());
}

Interval acos(const Interval& x) {
  if (!lies_in_unit_interval(x)) {
    return Interval::empty();
  }
  const Interval lower(x.lower());
  const Interval upper(x.upper());
  return Interval::from_bounds(atan2(cosine_of_arc_sine(upper), upper).lower(),
                               atan2(cosine_of_arc_sine(lower), lower).upper());
}

Interval stays_within(const Interval& x, const Interval& low, const Interval& high) {
  return certainly_less(low, x) && certainly_less(x, high) ? x : Interval::empty();
}

}  // namespace veritrack::rigor
