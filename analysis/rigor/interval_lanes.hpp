// Several intervals side by side: the scalar of a computation over as many boxes at once.
//
// Lane by lane each operation gives the bounds that Interval gives, to the bit (a test checks this), so that
// results depend neither on the number of lanes nor on the set of instructions. [a, b] is kept as -a and b,
// as in packed_bounds.hpp, each in a register of its own. In place of a truth value a predicate gives a mask:
// a lane is set only where it is certain. Needs the upward mode, as Interval does.
//
// For units that are compiled for one set of instructions, which they leave through functions on arrays: see
// analysis/quadrature/contraction/cell_lanes.hpp.
#pragma once

#include <limits>
#include <utility>

#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/eigen_scalar.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/registers.hpp"

namespace veritrack::rigor {

/// `Lanes` intervals: 2, 4 or 8. See Interval, lane by lane.
template <int Lanes>
class IntervalLanes {
 public:
  using R = Registers<Lanes>;
  using Numbers = typename R::Numbers;
  using Mask = typename R::Mask;
  static constexpr int kLanes = Lanes;

  /// Empty.
  IntervalLanes() noexcept : minus_lower_(nan()), upper_(nan()) {}
  /// The same real number in every lane: empty when it is none.
  explicit IntervalLanes(double point) noexcept : IntervalLanes(Interval(point)) {}
  explicit IntervalLanes(int point) noexcept : IntervalLanes(Interval(point)) {}
  /// The same interval in every lane.
  explicit IntervalLanes(const Interval& all) noexcept
      : minus_lower_(R::all(-all.lower())), upper_(R::all(all.upper())) {}
  template <typename T>
  explicit IntervalLanes(T) = delete;

  /// A number in each lane: empty where it is none.
  [[nodiscard]] static IntervalLanes at(const Numbers& points) noexcept {
    const Numbers known = R::select(is_real(points), points, nan());
    return IntervalLanes(R::negative(known), known);
  }
  /// Empty in lanes where Interval::from_bounds is.
  [[nodiscard]] static IntervalLanes from_bounds(const Numbers& lower, const Numbers& upper) noexcept {
    const Numbers infinity = R::all(std::numeric_limits<double>::infinity());
    const Mask is_set = R::both(R::less_equal(lower, upper),
                                R::both(R::less(lower, infinity), R::less(R::negative(infinity), upper)));
    return IntervalLanes(R::select(is_set, R::negative(lower), nan()), R::select(is_set, upper, nan()));
  }
  [[nodiscard]] static IntervalLanes from_bounds(double lower, double upper) noexcept {
    return IntervalLanes(Interval::from_bounds(lower, upper));
  }
  /// [-bound, bound]; empty unless bound >= 0.
  [[nodiscard]] static IntervalLanes symmetric(const Numbers& bound) noexcept {
    return from_bounds(R::negative(bound), bound);
  }
  /// Loads bounds from arrays, one of each in a lane.
  [[nodiscard]] static IntervalLanes load(const double* lower, const double* upper) noexcept {
    return from_bounds(R::load(lower), R::load(upper));
  }
  void store(double* lower, double* upper) const noexcept {
    R::store(lower, this->lower());
    R::store(upper, upper_);
  }

  /// NaN where empty.
  [[nodiscard]] Numbers lower() const noexcept { return R::negative(minus_lower_); }
  [[nodiscard]] const Numbers& minus_lower() const noexcept { return minus_lower_; }
  [[nodiscard]] const Numbers& upper() const noexcept { return upper_; }

  IntervalLanes operator-() const noexcept { return IntervalLanes(upper_, minus_lower_); }
  IntervalLanes& operator+=(const IntervalLanes& other) { return *this = *this + other; }
  IntervalLanes& operator-=(const IntervalLanes& other) { return *this = *this - other; }
  IntervalLanes& operator*=(const IntervalLanes& other) { return *this = *this * other; }
  IntervalLanes& operator/=(const IntervalLanes& other) { return *this = *this / other; }

  friend IntervalLanes operator+(const IntervalLanes& x, const IntervalLanes& y) {
    detail::debug_require_upward();
    return IntervalLanes(R::opaque(R::opaque(x.minus_lower_) + y.minus_lower_),
                         R::opaque(R::opaque(x.upper_) + y.upper_));
  }
  friend IntervalLanes operator-(const IntervalLanes& x, const IntervalLanes& y) { return x + -y; }

  /// As packed::product.
  friend IntervalLanes operator*(const IntervalLanes& x, const IntervalLanes& y) {
    detail::debug_require_upward();
    const Products all(x, y);
    if (R::any(R::either(R::unordered(all.ad, all.bd), R::unordered(all.ac, all.bc)))) [[unlikely]] {
      return product_with_infinities(x, y, all);
    }
    return IntervalLanes(
        R::opaque(R::max(R::max(all.minus_bc, all.minus_ad), R::max(all.minus_bd, all.minus_ac))),
        R::opaque(R::max(R::max(all.ac, all.bd), R::max(all.ad, all.bc))));
  }

  /// The product with a real number in each lane, which needs half a product for each bound: its bounds are
  /// those of x * at(points). Empty where a point is none.
  friend IntervalLanes scaled(const IntervalLanes& x, const Numbers& points) {
    detail::debug_require_upward();
    const Mask negative = R::less(points, R::all(0.0));
    const Numbers size = R::opaque(R::absolute(points));
    const Numbers minus_lower = R::opaque(R::select(negative, x.upper_, x.minus_lower_)) * size;
    const Numbers upper = R::opaque(R::select(negative, x.minus_lower_, x.upper_)) * size;
    if (!all_of(R::both(is_real(points), R::less_equal(minus_lower, minus_lower)),
                R::less_equal(upper, upper))) [[unlikely]] {
      return x * at(points);
    }
    return IntervalLanes(R::opaque(minus_lower), R::opaque(upper));
  }

  /// Empty where the divisor contains zero. As packed::quotient.
  friend IntervalLanes operator/(const IntervalLanes& x, const IntervalLanes& y) {
    detail::debug_require_upward();
    const Numbers zero = R::all(0.0);
    const Mask positive = R::less(zero, y.lower());
    const Mask negative = R::less(y.upper_, zero);
    const Numbers minus_a = R::opaque(R::select(negative, x.upper_, x.minus_lower_));
    const Numbers b = R::opaque(R::select(negative, x.minus_lower_, x.upper_));
    const Numbers smallest = R::opaque(R::negative(R::select(negative, y.upper_, y.minus_lower_)));
    const Numbers largest = R::opaque(R::select(negative, y.minus_lower_, y.upper_));
    // A bound that is not negative is largest over the smallest divisor, a negative one over the largest.
    const auto over = [&](const Numbers& bound) {
      return R::opaque(bound / R::select(R::less_equal(zero, bound), smallest, largest));
    };
    const Mask defined = R::either(positive, negative);
    return IntervalLanes(R::select(defined, over(minus_a), nan()), R::select(defined, over(b), nan()));
  }

  friend IntervalLanes square(const IntervalLanes& x) {
    detail::debug_require_upward();
    const Numbers minus_a = R::opaque(x.minus_lower_);
    const Numbers b = R::opaque(x.upper_);
    const Numbers largest = R::max(b, minus_a);
    const Numbers smallest = R::max(R::all(0.0), R::negative(R::min(minus_a, b)));
    return IntervalLanes(R::opaque(R::negative(smallest) * smallest), R::opaque(largest * largest));
  }

  friend IntervalLanes sqrt(const IntervalLanes& x) {
    detail::debug_require_upward();
    const Numbers lower = x.lower();
    const Mask defined = R::both(R::less_equal(R::all(0.0), lower), R::less_equal(lower, x.upper_));
    const Numbers up = R::sqrt(lower);
    const Mask exact = R::equal(R::opaque(up * up), lower);
    const Numbers down = R::select(exact, up, R::predecessor(up));
    return from_bounds(R::select(defined, down, nan()), R::select(defined, R::sqrt(x.upper_), nan()));
  }

  friend IntervalLanes hull(const IntervalLanes& x, const IntervalLanes& y) noexcept {
    const Mask empty = R::either(is_empty(x), is_empty(y));
    return IntervalLanes(R::select(empty, nan(), R::max(x.minus_lower_, y.minus_lower_)),
                         R::select(empty, nan(), R::max(x.upper_, y.upper_)));
  }
  friend IntervalLanes max(const IntervalLanes& x, const IntervalLanes& y) noexcept {
    const Mask empty = R::either(is_empty(x), is_empty(y));
    return IntervalLanes(R::select(empty, nan(), R::min(x.minus_lower_, y.minus_lower_)),
                         R::select(empty, nan(), R::max(x.upper_, y.upper_)));
  }
  friend IntervalLanes abs(const IntervalLanes& x) noexcept {
    const Numbers least = R::max(R::all(0.0), R::negative(R::min(x.minus_lower_, x.upper_)));
    return IntervalLanes(R::select(is_empty(x), nan(), R::negative(least)),
                         R::select(is_empty(x), nan(), magnitude(x)));
  }

  /// The largest |t|; NaN where empty.
  friend Numbers magnitude(const IntervalLanes& x) noexcept {
    return R::max(R::absolute(x.minus_lower_), R::absolute(x.upper_));
  }
  /// As midpoint of an Interval; NaN where not finite.
  friend Numbers midpoint(const IntervalLanes& x) noexcept {
    const Numbers half = R::all(0.5);
    const Numbers lower = x.lower();
    const Numbers middle = R::opaque(R::opaque(half * R::opaque(lower)) + R::opaque(half * x.upper_));
    const Numbers clamped =
        R::select(R::less(middle, lower), lower, R::select(R::less(x.upper_, middle), x.upper_, middle));
    return R::select(is_finite(x), clamped, nan());
  }

  friend Mask is_empty(const IntervalLanes& x) noexcept { return R::unordered(x.minus_lower_, x.upper_); }
  friend Mask is_finite(const IntervalLanes& x) noexcept {
    return R::both(R::both(is_real(x.minus_lower_), is_real(x.upper_)), R::less_equal(x.lower(), x.upper_));
  }
  friend Mask certainly_less(const IntervalLanes& x, const IntervalLanes& y) noexcept {
    return R::both(R::both(is_finite(x), is_finite(y)), R::less(x.upper_, y.lower()));
  }
  friend Mask certainly_positive(const IntervalLanes& x) noexcept {
    return R::both(is_finite(x), R::less(R::all(0.0), x.lower()));
  }

  /// x where the lane of `where` is set, empty elsewhere.
  friend IntervalLanes only(const Mask& where, const IntervalLanes& x) noexcept {
    return IntervalLanes(R::select(where, x.minus_lower_, nan()), R::select(where, x.upper_, nan()));
  }

 private:
  IntervalLanes(const Numbers& minus_lower, const Numbers& upper) noexcept
      : minus_lower_(minus_lower), upper_(upper) {}

  static Numbers nan() noexcept { return R::all(std::numeric_limits<double>::quiet_NaN()); }
  static bool all_of(const Mask& a, const Mask& b) noexcept {
    return R::bits(R::both(a, b)) == (1U << static_cast<unsigned>(Lanes)) - 1U;
  }
  static Mask is_real(const Numbers& x) noexcept {
    return R::less(R::absolute(x), R::all(std::numeric_limits<double>::infinity()));
  }

  /// The products of an end of x and an end of y, each as a candidate for -lower (minus_) or for upper.
  struct Products {
    Numbers minus_ad, minus_ac, minus_bc, minus_bd, ad, ac, bc, bd;
    Products(const IntervalLanes& x, const IntervalLanes& y) {
      const Numbers minus_a = R::opaque(x.minus_lower_);
      const Numbers b = R::opaque(x.upper_);
      const Numbers a = R::opaque(R::negative(minus_a));
      const Numbers minus_b = R::opaque(R::negative(b));
      const Numbers minus_c = R::opaque(y.minus_lower_);
      const Numbers d = R::opaque(y.upper_);
      minus_ad = minus_a * d;
      minus_ac = a * minus_c;
      minus_bc = b * minus_c;
      minus_bd = minus_b * d;
      ad = a * d;
      ac = minus_a * minus_c;
      bc = minus_b * minus_c;
      bd = b * d;
    }
  };

  /// The product where an operand is empty, or unbounded: there zero times infinity, which is NaN, represents
  /// zero times large numbers, which is zero.
  [[gnu::noinline, gnu::cold]] static IntervalLanes product_with_infinities(const IntervalLanes& x,
                                                                            const IntervalLanes& y,
                                                                            const Products& all) {
    const auto known = [](const Numbers& p) { return R::select(R::unordered(p, p), R::all(0.0), p); };
    const Mask empty = R::either(is_empty(x), is_empty(y));
    const Numbers minus_lower = R::max(R::max(known(all.minus_bc), known(all.minus_ad)),
                                       R::max(known(all.minus_bd), known(all.minus_ac)));
    const Numbers upper = R::max(R::max(known(all.ac), known(all.bd)), R::max(known(all.ad), known(all.bc)));
    return IntervalLanes(R::select(empty, nan(), minus_lower), R::select(empty, nan(), upper));
  }

  Numbers minus_lower_, upper_;
};

// ---- elementary functions, one lane after the other

namespace detail {
/// Out of line, in a unit for any processor: `count` intervals [lower[i], upper[i]] to [lower_out[i],
/// upper_out[i]].
struct LaneBounds {
  static constexpr int kMost = 8;
  double lower[kMost], upper[kMost];  // NOLINT: plain, shared by units for different processors
};
void sine_ratio_of_lanes(int count, const LaneBounds& x, LaneBounds& result);
void sine_ratio_slope_of_lanes(int count, const LaneBounds& x, LaneBounds& result);
void arctangent_ratio_of_lanes(int count, const LaneBounds& x, LaneBounds& result);
void arctangent_ratio_slope_of_lanes(int count, const LaneBounds& x, LaneBounds& result);

template <int Lanes, typename Function>
[[nodiscard]] IntervalLanes<Lanes> lane_by_lane(const IntervalLanes<Lanes>& x, const Function& function) {
  LaneBounds operand;
  LaneBounds result;
  x.store(operand.lower, operand.upper);
  function(Lanes, operand, result);
  return IntervalLanes<Lanes>::load(result.lower, result.upper);
}

/// `derivative` in lanes where `value` is known, empty elsewhere.
template <int Lanes>
[[nodiscard]] IntervalLanes<Lanes> known_lanes(const IntervalLanes<Lanes>& derivative,
                                               const IntervalLanes<Lanes>& value) {
  using R = Registers<Lanes>;
  return only(R::less_equal(value.lower(), value.upper()), derivative);
}
template <>
inline IntervalLanes<2> known_with(IntervalLanes<2> derivative, const IntervalLanes<2>& value) {
  return known_lanes(derivative, value);
}
#if defined(__AVX2__)
template <>
inline IntervalLanes<4> known_with(IntervalLanes<4> derivative, const IntervalLanes<4>& value) {
  return known_lanes(derivative, value);
}
#endif
#if defined(__AVX512F__) && defined(__AVX512DQ__)
template <>
inline IntervalLanes<8> known_with(IntervalLanes<8> derivative, const IntervalLanes<8>& value) {
  return known_lanes(derivative, value);
}
#endif
}  // namespace detail

template <int Lanes>
[[nodiscard]] IntervalLanes<Lanes> sine_ratio(const IntervalLanes<Lanes>& x) {
  return detail::lane_by_lane(x, detail::sine_ratio_of_lanes);
}
template <int Lanes>
[[nodiscard]] IntervalLanes<Lanes> arctangent_ratio(const IntervalLanes<Lanes>& x) {
  return detail::lane_by_lane(x, detail::arctangent_ratio_of_lanes);
}
template <int Lanes, int N>
[[nodiscard]] Dual<IntervalLanes<Lanes>, N> sine_ratio(const Dual<IntervalLanes<Lanes>, N>& x) {
  return x.chain(sine_ratio(x.value()),
                 -(x.value() * detail::lane_by_lane(x.value(), detail::sine_ratio_slope_of_lanes)));
}
template <int Lanes, int N>
[[nodiscard]] Dual<IntervalLanes<Lanes>, N> arctangent_ratio(const Dual<IntervalLanes<Lanes>, N>& x) {
  return x.chain(arctangent_ratio(x.value()),
                 -(x.value() * detail::lane_by_lane(x.value(), detail::arctangent_ratio_slope_of_lanes)));
}

}  // namespace veritrack::rigor

namespace Eigen {

template <int Lanes>
struct NumTraits<veritrack::rigor::IntervalLanes<Lanes>>
    : veritrack::rigor::CostlyEigenScalar<veritrack::rigor::IntervalLanes<Lanes>> {};

}  // namespace Eigen

#include "analysis/rigor/sine_cosine_lanes.hpp"  // IWYU pragma: export
