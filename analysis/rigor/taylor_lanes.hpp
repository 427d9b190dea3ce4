// Several Taylor models side by side, one in each lane: taylor_model.hpp says what they promise, and why
// plain floating point is sound in them.
//
// Lane by lane the operations are those of TaylorModel in the same order, so that a lane has the same
// coefficients and the same remainder, to the bit (a test checks this). Only sums and products with
// coefficients that are zero in all lanes are omitted. For units that are compiled for one set of
// instructions, as interval_lanes.hpp, and with the lanes last among the parameters, by which such units are
// told apart.
#pragma once

#include <cstddef>
#include <limits>
#include <utility>

#include "analysis/rigor/interval_lanes.hpp"
#include "analysis/rigor/monomials.hpp"

namespace veritrack::rigor {

template <int Variables, int Degree, int Lanes>
class TaylorLanes {
 public:
  using R = Registers<Lanes>;
  using Numbers = typename R::Numbers;
  using Set = IntervalLanes<Lanes>;
  using Monomials = detail::Monomials<Variables, Degree>;
  static constexpr std::size_t kTerms = Monomials::kTerms;

  /// Must be assigned before use: nothing is known of it.
  TaylorLanes() noexcept : TaylorLanes(R::all(0.0), nan()) {}
  /// The constant that this double is.
  explicit TaylorLanes(double constant) noexcept : TaylorLanes(R::all(constant), R::all(0.0)) {}
  /// A function known only by its range; nothing is known about it where the range is not finite.
  explicit TaylorLanes(const Set& constant)
      : TaylorLanes(R::select(is_finite(constant), midpoint(constant), R::all(0.0)),
                    R::select(is_finite(constant), radius_around(constant), nan())) {}
  /// A real number in each lane.
  [[nodiscard]] static TaylorLanes at(const Numbers& constants) noexcept {
    return TaylorLanes(constants, R::all(0.0));
  }
  /// The variable number `index`, stretched to run over `range`. Nothing is known of it unless that is
  /// finite.
  [[nodiscard]] static TaylorLanes variable(const Set& range, int index) {
    TaylorLanes result(range);
    result.coefficients_[1 + static_cast<std::size_t>(index)] = result.remainder_;
    result.remainder_ = R::select(is_finite(range), R::all(0.0), nan());
    result.degree_ = 1;
    return result;
  }

  [[nodiscard]] const Numbers& coefficient(std::size_t i) const noexcept { return coefficients_[i]; }
  [[nodiscard]] const Numbers& constant() const noexcept { return coefficients_[0]; }
  /// At least 0; NaN where nothing is known.
  [[nodiscard]] const Numbers& remainder() const noexcept { return remainder_; }

  /// The same polynomial with a zero remainder.
  [[nodiscard]] TaylorLanes polynomial() const {
    TaylorLanes result = *this;
    result.remainder_ = R::all(0.0);
    return result;
  }

  /// Encloses all values on [-1, 1]^Variables. Not finite where nothing is known.
  [[nodiscard]] Set range() const {
    const Numbers zero = R::all(0.0);
    Numbers above = zero;
    Numbers beneath = zero;
    for_each_of<1, kTerms>([&](auto i) {
      const Numbers size = R::absolute(coefficients_[i]);
      if constexpr (Monomials::kIsSquare[i]) {
        above = above + R::select(R::less(coefficients_[i], zero), zero, size);
        beneath = beneath + R::select(R::less(zero, coefficients_[i]), zero, size);
      } else {
        above = above + size;
        beneath = beneath + size;
      }
    });
    return Set::from_bounds(R::negative(enlarged(beneath + remainder_)), enlarged(above + remainder_)) +
           Set::at(coefficients_[0]);
  }

  TaylorLanes operator-() const {
    TaylorLanes result = *this;
    for_each_of<0, kTerms>([&](auto i) { result.coefficients_[i] = R::negative(coefficients_[i]); });
    return result;
  }
  TaylorLanes& operator+=(const TaylorLanes& other) {
    Numbers size = R::all(0.0);
    for_each_of<0, kTerms>([&](auto i) {
      coefficients_[i] = coefficients_[i] + other.coefficients_[i];
      size = size + R::absolute(coefficients_[i]);
    });
    remainder_ = enlarged(remainder_ + other.remainder_ + R::all(kRoundingOfSum) * size);
    degree_ = degree_ < other.degree_ ? other.degree_ : degree_;
    return *this;
  }
  TaylorLanes& operator-=(const TaylorLanes& other) { return *this += -other; }
  friend TaylorLanes operator+(TaylorLanes a, const TaylorLanes& b) { return a += b; }
  friend TaylorLanes operator-(TaylorLanes a, const TaylorLanes& b) { return a += -b; }

  friend TaylorLanes operator*(const TaylorLanes& a, const TaylorLanes& b) {
    TaylorLanes result(0.0);
    if (a.degree_ == 0) {
      multiply<0>(a, b, result);
    } else if (a.degree_ == 1) {
      multiply<1>(a, b, result);
    } else {
      multiply<Degree>(a, b, result);
    }
    result.degree_ = a.degree_ + b.degree_ < Degree ? a.degree_ + b.degree_ : Degree;
    return result;
  }
  friend TaylorLanes operator/(const TaylorLanes& a, const TaylorLanes& b) { return a * reciprocal(b); }
  friend TaylorLanes square(const TaylorLanes& x) { return x * x; }

  /// 1/x. Nothing is known of it where the range of x contains zero.
  friend TaylorLanes reciprocal(const TaylorLanes& x) {
    const Numbers deviation = x.deviation();
    const Numbers distance = below(R::absolute(x.constant()) - deviation);
    Set slopes[kSlopes];  // NOLINT: lanes lose their attributes in std::array
    const Set inverse = Set(1.0) / Set::at(x.constant());
    slopes[0] = inverse;
    for (std::size_t k = 1; k < kSlopes; ++k) {
      slopes[k] = -(slopes[k - 1] * inverse);
    }
    const Set ratio = Set::at(deviation) * abs(inverse);
    const Set rest = Set::at(power(ratio.upper())) / Set::at(distance);
    TaylorLanes result = x.composed(slopes, rest.upper());
    result.remainder_ = R::select(R::less(R::all(0.0), distance), result.remainder_, nan());
    return result;
  }

  /// (sin x, cos x), x in rad.
  friend std::pair<TaylorLanes, TaylorLanes> sin_cos(const TaylorLanes& x) {
    const auto [sine, cosine] = sin_cos(Set::at(x.constant()));
    const Set derivatives[4] = {sine, cosine, -sine, -cosine};  // NOLINT
    Set sine_slopes[kSlopes];                                   // NOLINT
    Set cosine_slopes[kSlopes];                                 // NOLINT
    double factorial = 1.0;
    for (std::size_t k = 0; k < kSlopes; ++k) {
      sine_slopes[k] = derivatives[k % 4] / Set(factorial);
      cosine_slopes[k] = derivatives[(k + 1) % 4] / Set(factorial);
      factorial *= static_cast<double>(k + 1);  // exact
    }
    const Numbers rest = (Set::at(power(x.deviation())) / Set(factorial)).upper();
    return {x.composed(sine_slopes, rest), x.composed(cosine_slopes, rest)};
  }

 private:
  static constexpr std::size_t kSlopes = static_cast<std::size_t>(Degree) + 1;
  static_assert(kTerms <= 64, "sums and products are written out; more would be long");
  // As in TaylorModel.
  static constexpr double kRoundingOfSum = 0x1p-51;
  static constexpr double kRoundingOfProduct = 0x1p-43;

  TaylorLanes(const Numbers& constant, const Numbers& remainder) noexcept : remainder_(remainder) {
    coefficients_[0] = constant;
    for_each_of<1, kTerms>([&](auto i) { coefficients_[i] = R::all(0.0); });
  }

  /// Calls function(constant i) for First <= i < End, written out.
  template <std::size_t First, std::size_t End, typename Function>
  [[gnu::always_inline]] static void for_each_of(const Function& function) {
    each(function, std::integral_constant<std::size_t, First>(), std::make_index_sequence<End - First>());
  }
  template <typename Function, std::size_t First, std::size_t... kIndices>
  [[gnu::always_inline]] static void each(const Function& function,
                                          std::integral_constant<std::size_t, First> /*first*/,
                                          std::index_sequence<kIndices...> /*indices*/) {
    (function(std::integral_constant<std::size_t, First + kIndices>()), ...);
  }

  static Numbers nan() noexcept { return R::all(std::numeric_limits<double>::quiet_NaN()); }
  static Numbers enlarged(const Numbers& bound) { return bound * R::all(1.0 + 0x1p-40) + R::all(1e-300); }
  static Numbers below(const Numbers& difference) {
    return difference - R::absolute(difference) * R::all(0x1p-50) - R::all(1e-300);
  }
  /// The distance of the points of `range` from its middle.
  static Numbers radius_around(const Set& range) { return magnitude(range - Set::at(midpoint(range))); }
  /// An upper bound on x^(Degree + 1), for x >= 0 or NaN: as pow of an Interval. Needs the upward mode.
  static Numbers power(const Numbers& x) {
    Numbers result = R::all(1.0);
    Numbers factor = x;
    for (unsigned exponent = static_cast<unsigned>(Degree) + 1; exponent != 0; exponent >>= 1U) {
      if ((exponent & 1U) != 0) {
        result = R::opaque(R::opaque(result) * factor);
      }
      factor = R::opaque(R::opaque(factor) * factor);
    }
    return result;
  }

  /// The size of the terms of each degree.
  struct Sizes {
    Numbers of[kSlopes];  // NOLINT
    explicit Sizes(const TaylorLanes& x) {
      for_each_of<0, kSlopes>([&](auto degree) { of[degree] = R::all(0.0); });
      for_each_of<0, kTerms>([&](auto i) {
        of[Monomials::kDegrees[i]] = of[Monomials::kDegrees[i]] + R::absolute(x.coefficients_[i]);
      });
    }
  };

  /// The product where `a` has terms up to that degree.
  template <int DegreeOfA>
  [[gnu::noinline]] static void multiply(const TaylorLanes& a, const TaylorLanes& b, TaylorLanes& result) {
    Numbers sums[kTerms];  // NOLINT
    for_each_of<0, kTerms>([&](auto k) { sums[k] = R::all(0.0); });
    for_each_of<0, Monomials::kCountUpTo[DegreeOfA]>([&](auto i) {
      const Numbers factor = a.coefficients_[i];
      for_each_of<0, Monomials::kCountUpTo[static_cast<std::size_t>(Degree) - Monomials::kDegrees[i]]>(
          [&](auto j) {
            constexpr std::size_t kProduct = Monomials::kProducts[i][j];
            sums[kProduct] = sums[kProduct] + factor * b.coefficients_[j];
          });
    });
    for_each_of<0, kTerms>([&](auto k) { result.coefficients_[k] = sums[k]; });
    const Sizes sizes_a(a);
    const Sizes sizes_b(b);
    Numbers cut_off = R::all(0.0);
    Numbers size_a = R::all(0.0);
    Numbers size_b = R::all(0.0);
    for_each_of<0, kSlopes>([&](auto i) {
      size_a = size_a + sizes_a.of[i];
      size_b = size_b + sizes_b.of[i];
      if constexpr (i <= static_cast<std::size_t>(DegreeOfA)) {
        for_each_of<kSlopes - i, kSlopes>([&](auto j) { cut_off = cut_off + sizes_a.of[i] * sizes_b.of[j]; });
      }
    });
    result.remainder_ = enlarged(cut_off + R::all(kRoundingOfProduct) * size_a * size_b +
                                 size_a * b.remainder_ + size_b * a.remainder_ + a.remainder_ * b.remainder_);
  }

  /// A bound on the distance of all values from constant(); NaN where nothing is known.
  [[nodiscard]] Numbers deviation() const {
    Numbers size = R::all(0.0);
    for_each_of<1, kTerms>([&](auto i) { size = size + R::absolute(coefficients_[i]); });
    return enlarged(size + remainder_);
  }

  /// sum_k slopes[k] h^k within +-rest, where h is this without its constant.
  [[nodiscard]] TaylorLanes composed(const Set* slopes, const Numbers& rest) const {
    TaylorLanes h = *this;
    h.coefficients_[0] = R::all(0.0);
    TaylorLanes result(slopes[kSlopes - 1]);
    for (std::size_t k = kSlopes - 1; k > 0; --k) {
      result = h * result + TaylorLanes(slopes[k - 1]);
    }
    result.remainder_ = enlarged(result.remainder_ + rest);
    return result;
  }

  Numbers coefficients_[kTerms];  // NOLINT
  Numbers remainder_;
  int degree_ = 0;  ///< terms of higher degree are zero
};

}  // namespace veritrack::rigor
