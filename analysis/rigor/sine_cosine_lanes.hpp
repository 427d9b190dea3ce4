// sin_cos for several intervals side by side: the operations of sine_cosine.cpp, which has the proof, in the
// same order, so that each lane has the same bounds. Part of interval_lanes.hpp.
//
// Where one lane needs more than the fast path, all go one after the other.
#pragma once

#include <array>
#include <utility>

#include "analysis/rigor/interval_lanes.hpp"
#include "analysis/rigor/sine_cosine_constants.hpp"

namespace veritrack::rigor {

namespace detail {

/// flags[r][i] is false only when lane i certainly contains (r + 4 j) pi/2 for no integer j.
void quarter_turns_of_lanes(int count, const LaneBounds& x, double (*flags)[LaneBounds::kMost]);
void sin_cos_of_lanes(int count, const LaneBounds& x, LaneBounds& sine, LaneBounds& cosine);

template <int Lanes>
class SineCosineLanes {
 public:
  using R = Registers<Lanes>;
  using Numbers = typename R::Numbers;
  using Mask = typename R::Mask;
  using Set = IntervalLanes<Lanes>;
  using Pair = std::pair<Set, Set>;

  /// False in `fast` where sin_cos_of_point of sine_cosine.cpp asks MPFR.
  static Pair at_points(const Numbers& x, Mask& fast) {
    const Numbers angle = R::absolute(x);
    fast = R::both(fast, R::less_equal(angle, R::all(0x1p+20)));
    const Numbers k = R::truncated(times(angle, R::all(kTwoOverPi.high)) + R::all(0.5));
    // Bounds on angle - k pi/2.
    const Numbers minus_k = R::negative(k);
    const auto less_turns = [&](const Numbers& from, const Numbers& turns, double third) {
      const Numbers first = plus(from, times(turns, R::all(kHalfPi1)));
      return plus(plus(first, times(turns, R::all(kHalfPi2))), times(turns, R::all(third)));
    };
    const Numbers low = R::negative(less_turns(R::negative(angle), k, kHalfPi3.high));
    const Numbers high = less_turns(angle, minus_k, kHalfPi3.low);
    const Numbers largest = R::max(R::negative(low), high);
    fast = R::both(fast, R::both(R::less_equal(low, high), R::less_equal(largest, R::all(0.8125))));
    const Numbers smallest = R::max(R::max(low, R::negative(high)), R::all(0.0));
    const Numbers u_low = R::negative(times(R::negative(smallest), smallest));
    const Numbers u_high = times(largest, largest);
    const Set sine = diminished(low, high, u_low, u_high, kSineCoefficients);
    const Set cosine = diminished(R::all(1.0), R::all(1.0), u_low, u_high, kCosineCoefficients);
    // Turned by k quarters, and the sine by the sign of x.
    const Numbers quarter = k - R::all(4.0) * R::truncated(k * R::all(0.25));
    const auto is = [&](double value) { return R::equal(quarter, R::all(value)); };
    const Mask odd = R::either(is(1.0), is(3.0));
    const Set first = chosen(odd, cosine, sine);
    const Set second = chosen(odd, sine, cosine);
    const Set turned_sine = chosen(R::either(is(2.0), is(3.0)), -first, first);
    return {chosen(R::less(x, R::all(0.0)), -turned_sine, turned_sine),
            chosen(R::either(is(1.0), is(2.0)), -second, second)};
  }

  /// As `moved` of sine_cosine.cpp.
  static Set moved(const Set& value, const Set& slope, const Set& displacement) {
    const Numbers rho = magnitude(displacement);
    const Numbers fall = times(R::all(0.5), times(rho, rho));
    const auto bent = [&](const Numbers& bound) { return times(R::max(bound, R::all(0.0)), fall); };
    const Set bend = Set::from_bounds(R::negative(bent(value.upper())), bent(value.minus_lower()));
    const Set sum = value + slope * displacement + bend;
    return Set::from_bounds(R::max(sum.lower(), R::all(-1.0)), R::min(sum.upper(), R::all(1.0)));
  }

  /// `inside` where the lane of `where` is set, `outside` elsewhere.
  static Set chosen(const Mask& where, const Set& inside, const Set& outside) {
    return Set::from_bounds(R::select(where, inside.lower(), outside.lower()),
                            R::select(where, inside.upper(), outside.upper()));
  }

 private:
  static Numbers plus(const Numbers& a, const Numbers& b) { return R::opaque(R::opaque(a) + b); }
  static Numbers times(const Numbers& a, const Numbers& b) { return R::opaque(R::opaque(a) * b); }

  /// r - r w for r in [low, high] and w = u (c1 - u (c2 - ...)), u in [u_low, u_high]: alternating_series and
  /// `diminished` of sine_cosine.cpp.
  static Set diminished(const Numbers& low, const Numbers& high, const Numbers& u_low, const Numbers& u_high,
                        const Coefficients& coefficients) {
    Numbers minus_lower = R::all(0.0);
    Numbers upper = R::all(coefficients.back().high);
    for (int term = kTerms - 2; term >= 0; --term) {
      const Bounds& coefficient = coefficients[static_cast<std::size_t>(term)];
      const Numbers next = plus(R::all(-coefficient.low), times(u_high, upper));
      upper = plus(R::all(coefficient.high), times(u_low, minus_lower));
      minus_lower = next;
    }
    const Numbers w_low = R::negative(times(u_low, minus_lower));
    const Numbers w_high = times(u_high, upper);
    const Numbers zero = R::all(0.0);
    const Numbers of_low = R::select(R::less_equal(zero, low), w_high, w_low);
    const Numbers of_high = R::select(R::less_equal(zero, high), w_low, w_high);
    return Set::from_bounds(R::negative(plus(R::negative(low), times(low, of_low))),
                            plus(high, times(R::negative(high), of_high)));
  }
};

}  // namespace detail

/// (sin x, cos x) in each lane, as sin_cos of an Interval.
template <int Lanes>
[[nodiscard]] std::pair<IntervalLanes<Lanes>, IntervalLanes<Lanes>> sin_cos(const IntervalLanes<Lanes>& x) {
  using R = Registers<Lanes>;
  using Set = IntervalLanes<Lanes>;
  using Fast = detail::SineCosineLanes<Lanes>;
  using Mask = typename R::Mask;
  constexpr unsigned kAll = (1U << static_cast<unsigned>(Lanes)) - 1U;
  Mask fast = is_finite(x);
  if (R::bits(fast) == kAll) {
    const auto middle = midpoint(x);
    const Set displacement = x - Set::at(middle);
    const Mask is_point = R::equal(x.lower(), x.upper());
    const Mask narrow = R::either(is_point, R::less(magnitude(displacement), R::all(0x1p-10)));
    const auto [sine, cosine] = Fast::at_points(R::select(narrow, middle, x.lower()), fast);
    std::pair<Set, Set> result{Fast::chosen(is_point, sine, Fast::moved(sine, cosine, displacement)),
                               Fast::chosen(is_point, cosine, Fast::moved(cosine, -sine, displacement))};
    if (R::bits(narrow) != kAll) {
      const auto [last_sine, last_cosine] = Fast::at_points(x.upper(), fast);
      detail::LaneBounds angles;
      double may_reach[4][detail::LaneBounds::kMost];  // NOLINT: plain
      x.store(angles.lower, angles.upper);
      detail::quarter_turns_of_lanes(Lanes, angles, may_reach);
      const auto between = [&](const Set& a, const Set& b, int top, int bottom) {
        const Set ends = hull(a, b);
        const auto reaches = [&](int turn) { return R::less(R::all(0.0), R::load(may_reach[turn])); };
        return Set::from_bounds(R::select(reaches(bottom), R::all(-1.0), ends.lower()),
                                R::select(reaches(top), R::all(1.0), ends.upper()));
      };
      result = {Fast::chosen(narrow, result.first, between(sine, last_sine, 1, 3)),
                Fast::chosen(narrow, result.second, between(cosine, last_cosine, 0, 2))};
    }
    if (R::bits(fast) == kAll) {
      return result;
    }
  }
  detail::LaneBounds operand;
  detail::LaneBounds sine;
  detail::LaneBounds cosine;
  x.store(operand.lower, operand.upper);
  detail::sin_cos_of_lanes(Lanes, operand, sine, cosine);
  return {Set::load(sine.lower, sine.upper), Set::load(cosine.lower, cosine.upper)};
}

}  // namespace veritrack::rigor
