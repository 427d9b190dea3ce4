// sin, cos and sin_cos.
//
// Points with |x| <= 2^20. For every integer k the pair (sin x, cos x) is that of r = x - k pi/2 turned by k
// quarters. r is enclosed with directed operations, pi/2 represented as P1 + P2 + P3 where P1 and P2 are
// doubles of 33 bits (so that their products with k < 2^20 are exact, which is good for the width and not
// needed for the proof) and P3 lies between two neighbouring doubles. Nothing depends on how k was chosen:
// |r| <= kLargestReduced is checked, and MPFR is used where the check fails. With u = r^2 < 1 the Taylor
// series are
//     sin r = r S(u),  S = 1 - u (1/3! - u (1/5! - ...)),      cos r = C(u) = 1 - u (1/2! - u (1/4! - ...)).
// Their terms alternate and decrease, so that everything after the factor 1/n! of the last term kept, divided
// by that term's power of u, lies between 0 and the next factor, and each parenthesis is positive. Replacing
// the last parenthesis by [0, next factor] gives an enclosure; the others are evaluated from the inside
// outward, all quantities being non-negative, lower bounds from lower and upper ones.
//
// Narrow intervals. With a point m of x, its middle, and the displacements d in D = x - m, all |d| <= rho <
// 2^-10:
//     sin(m + d) = sin m + cos m sin d + sin m (cos d - 1),    sin d in D (which holds 0),
//     cos(m + d) = cos m - sin m sin d + cos m (cos d - 1),    cos d - 1 in [-rho^2/2, 0],
// intersected with [-1, 1].
//
// Wide intervals: between two multiples of pi/2 both functions are monotone, so that their range is the hull
// of the values at the endpoints and of each extremum +-1 in the interval. An extremum that may be in the
// interval is included.
#include <cstdint>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/mpfr_reference.hpp"
#include "analysis/rigor/quarter_turns.hpp"
#include "analysis/rigor/sine_cosine_constants.hpp"

namespace veritrack::rigor {

namespace {

using SineCosine = std::pair<Interval, Interval>;
using detail::Bounds;
using detail::Coefficients;
using detail::kHalfPi1;
using detail::kHalfPi2;
using detail::kHalfPi3;
using detail::kTerms;

constexpr double kLargestArgument = 0x1p+20;
constexpr double kLargestReduced = 0.8125;  // pi/4 and a margin; its square is below 1
constexpr double kNarrowRadius = 0x1p-10;

/// u (c1 - u (c2 - ... - u (c8 - u t))) for 0 <= u < 1 and t in [0, c9].
Bounds alternating_series(const Bounds& u, const Coefficients& coefficients) {
  // As (-low, high), both rounded up: a step is (-c.low + u.high inner.high, c.high + u.low (-inner.low)).
  const __m128d factors = detail::opaque(_mm_set_pd(u.low, u.high));
  __m128d inner = packed::pack(0.0, coefficients.back().high);
  for (int term = kTerms - 2; term >= 0; --term) {
    const Bounds& coefficient = coefficients[static_cast<std::size_t>(term)];
    inner = _mm_add_pd(packed::pack(coefficient.low, coefficient.high),
                       _mm_mul_pd(factors, packed::negated(inner)));
  }
  const __m128d result = detail::opaque(_mm_mul_pd(packed::negated(factors), inner));
  return {packed::lower(result), packed::upper(result)};
}

/// r - r w for r in `r` and w in `w`, where 0 <= w < 1: a bound on r times the largest or the smallest 1 - w,
/// written so that the roundings fall on the smaller term.
Interval diminished(const Bounds& r, const Bounds& w) {
  const double w_of_low = r.low >= 0.0 ? w.high : w.low;
  const double w_of_high = r.high >= 0.0 ? w.low : w.high;
  return Interval::from_bounds(sub_down(r.low, mul_up(r.low, w_of_low)),
                               sub_up(r.high, mul_down(r.high, w_of_high)));
}

/// Bounds on x - k pi/2 for x, k >= 0.
Bounds reduce(double x, double k) {
  const double low = sub_down(sub_down(x, mul_up(k, kHalfPi1)), mul_up(k, kHalfPi2));
  const double high = sub_up(sub_up(x, mul_down(k, kHalfPi1)), mul_down(k, kHalfPi2));
  return {sub_down(low, mul_up(k, kHalfPi3.high)), sub_up(high, mul_down(k, kHalfPi3.low))};
}

SineCosine reference_sin_cos(double x) {
  return {Interval::from_bounds(detail::reference_sin(x, Direction::down),
                                detail::reference_sin(x, Direction::up)),
          Interval::from_bounds(detail::reference_cos(x, Direction::down),
                                detail::reference_cos(x, Direction::up))};
}

/// (sin x, cos x) from those of x - quarters pi/2.
SineCosine turned(const SineCosine& reduced, std::int64_t quarters) {
  const auto& [sine, cosine] = reduced;
  switch (quarters % 4) {
    case 0:
      return reduced;
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

/// (sin x, cos x) of a finite point.
SineCosine sin_cos_of_point(double x) {
  const double angle = std::fabs(x);
  if (angle > kLargestArgument) {
    return reference_sin_cos(x);
  }
  // Any integer near will do. NOLINTNEXTLINE(bugprone-incorrect-roundings)
  const auto quarters = static_cast<std::int64_t>(angle * detail::kTwoOverPi.high + 0.5);
  const Bounds r = reduce(angle, static_cast<double>(quarters));
  const double largest = std::max(-r.low, r.high);
  const bool is_reduced = r.low <= r.high && largest <= kLargestReduced;
  if (!is_reduced) {
    return reference_sin_cos(x);
  }
  const double smallest = std::max(0.0, std::max(r.low, -r.high));
  const Bounds u{mul_down(smallest, smallest), mul_up(largest, largest)};
  const Interval sine = diminished(r, alternating_series(u, detail::kSineCoefficients));
  const Interval cosine = diminished({1.0, 1.0}, alternating_series(u, detail::kCosineCoefficients));
  SineCosine result = turned({sine, cosine}, quarters);
  if (x < 0.0) {
    result.first = -result.first;
  }
  return result;
}

/// The value at a point, `value`, where the derivative is `slope`, over displacements d from that point.
Interval moved(const Interval& value, const Interval& slope, const Interval& displacement) {
  const double rho = magnitude(displacement);
  const double largest_fall = mul_up(0.5, mul_up(rho, rho));  // of cos d below 1
  const Interval bend = Interval::from_bounds(-mul_up(std::max(value.upper(), 0.0), largest_fall),
                                              mul_up(std::max(-value.lower(), 0.0), largest_fall));
  return intersection(value + slope * displacement + bend, symmetric(1.0));
}

/// The hull of the values at the endpoints, reaching 1 and -1 where an extremum may lie between them. The
/// maxima are the quarter turns with residue `maximum` modulo 4.
Interval between(const Interval& at_lower, const Interval& at_upper, const Interval& x, int maximum) {
  const Interval ends = hull(at_lower, at_upper);
  const bool may_reach_top = detail::may_contain_quarter_turn(x, maximum, 4);
  const bool may_reach_bottom = detail::may_contain_quarter_turn(x, (maximum + 2) % 4, 4);
  return Interval::from_bounds(may_reach_bottom ? -1.0 : ends.lower(), may_reach_top ? 1.0 : ends.upper());
}

}  // namespace

SineCosine sin_cos(const Interval& x) {
  require_upward_rounding();
  if (is_empty(x)) {
    return {};
  }
  if (!is_finite(x)) {
    return {symmetric(1.0), symmetric(1.0)};
  }
  if (x.lower() == x.upper()) {
    return sin_cos_of_point(x.lower());
  }
  const double middle = midpoint(x);
  const Interval displacement = Interval::from_bounds(sub_down(x.lower(), middle), sub_up(x.upper(), middle));
  if (magnitude(displacement) < kNarrowRadius) {
    const auto [sine, cosine] = sin_cos_of_point(middle);
    return {moved(sine, cosine, displacement), moved(cosine, -sine, displacement)};
  }
  const SineCosine at_lower = sin_cos_of_point(x.lower());
  const SineCosine at_upper = sin_cos_of_point(x.upper());
  return {between(at_lower.first, at_upper.first, x, 1), between(at_lower.second, at_upper.second, x, 0)};
}

Interval sin(const Interval& x) {
  return sin_cos(x).first;
}
Interval cos(const Interval& x) {
  return sin_cos(x).second;
}

}  // namespace veritrack::rigor
