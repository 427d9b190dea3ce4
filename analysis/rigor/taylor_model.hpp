// Taylor models: a polynomial in a few variables on [-1, 1] with a bound on its error.
//
// The promise. A TaylorModel f represents a set of functions on [-1, 1]^Variables: all those that stay within
// `remainder()` of its polynomial. An operation on Taylor models gives one that contains the result of the
// operation on all functions in its operands. The remainder includes truncation (terms above Degree),
// rounding errors, and the width of interval constants. Where that cannot be
// bounded (a divisor whose range contains zero) the remainder is NaN, which means "nothing is known", and
// stays NaN. A NaN or infinite remainder gives an empty or unbounded range(), which never certifies.
//
// Why plain floating point is sound here. Each sum or product of doubles is within a relative error of 2^-52
// (and an absolute error of 2^-1074) of the exact one in *every* rounding mode, fused or not. The errors of
// the coefficients are bounded by that, and the bounds, sums of few non-negative terms, are enlarged by more
// than their own relative error. So only the conversions from and to Interval need the upward rounding mode.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <utility>

#include "analysis/rigor/eigen_scalar.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/monomials.hpp"

namespace veritrack::rigor {

template <int Variables, int Degree>
class TaylorModel {
 public:
  using Monomials = detail::Monomials<Variables, Degree>;
  static constexpr std::size_t kTerms = Monomials::kTerms;
  using Coefficients = std::array<double, kTerms>;

  /// Must be assigned before use: nothing is known of it.
  TaylorModel() noexcept : remainder_(std::numeric_limits<double>::quiet_NaN()) { coefficients_.fill(0.0); }
  /// The constant that this double is.
  explicit TaylorModel(double constant) noexcept : remainder_(0.0) {
    coefficients_.fill(0.0);
    coefficients_[0] = constant;
  }
  explicit TaylorModel(int constant) noexcept : TaylorModel(static_cast<double>(constant)) {}
  /// A function known only by its range; nothing is known about it unless the range is finite.
  explicit TaylorModel(const Interval& constant)
      : TaylorModel(is_finite(constant) ? midpoint(constant) : 0.0) {
    remainder_ = is_finite(constant) ? radius_around(constant, coefficients_[0])
                                     : std::numeric_limits<double>::quiet_NaN();
  }
  /// The variable number `index`, stretched to run over `range` (a little further when the ends of that are
  /// not a whole number of roundings apart). Nothing is known of it unless `range` is finite.
  [[nodiscard]] static TaylorModel variable(const Interval& range, int index) {
    TaylorModel result;
    if (is_finite(range)) {
      result.coefficients_[0] = midpoint(range);
      result.coefficients_[1 + static_cast<std::size_t>(index)] =
          radius_around(range, result.coefficients_[0]);
      result.remainder_ = 0.0;
    }
    return result;
  }

  /// The coefficients in the order of Monomials: the constant, then the linear ones, and so on.
  [[nodiscard]] const Coefficients& coefficients() const noexcept { return coefficients_; }
  [[nodiscard]] double constant() const noexcept { return coefficients_[0]; }
  [[nodiscard]] double linear(int index) const noexcept {
    return coefficients_[1 + static_cast<std::size_t>(index)];
  }
  /// At least 0; NaN when nothing is known.
  [[nodiscard]] double remainder() const noexcept { return remainder_; }

  /// The same polynomial with a zero remainder.
  [[nodiscard]] TaylorModel polynomial() const {
    TaylorModel result = *this;
    result.remainder_ = 0.0;
    return result;
  }

  /// The same functions in terms of fewer monomials: those of higher degree are added to the remainder.
  template <int LowerDegree>
  [[nodiscard]] TaylorModel<Variables, LowerDegree> lowered() const {
    static_assert(LowerDegree <= Degree);
    using Lower = TaylorModel<Variables, LowerDegree>;
    Lower result(0.0);
    double cut_off = remainder_;
    for (std::size_t i = 0; i < kTerms; ++i) {
      if (i < Lower::kTerms) {
        result.coefficients_[i] = coefficients_[i];
      } else {
        cut_off += std::fabs(coefficients_[i]);
      }
    }
    result.remainder_ = enlarged(cut_off);
    return result;
  }
  /// The same functions, and all others within `distance` (>= 0) of one of them.
  [[nodiscard]] TaylorModel widened(double distance) const {
    TaylorModel result = *this;
    result.remainder_ = enlarged(remainder_ + distance);
    return result;
  }

  /// Encloses all values on [-1, 1]^Variables. Not finite when nothing is known.
  [[nodiscard]] Interval range() const { return range_from(1) + Interval(coefficients_[0]); }
  /// Encloses the values of everything beyond the linear terms, the remainder included.
  [[nodiscard]] Interval nonlinear_range() const { return range_from(1 + Variables); }

  TaylorModel operator-() const {
    TaylorModel result = *this;
    for (double& coefficient : result.coefficients_) {
      coefficient = -coefficient;
    }
    return result;
  }
  TaylorModel& operator+=(const TaylorModel& other) {
    double size = 0.0;
    for (std::size_t i = 0; i < kTerms; ++i) {
      coefficients_[i] += other.coefficients_[i];
      size += std::fabs(coefficients_[i]);
    }
    remainder_ = enlarged(remainder_ + other.remainder_ + kRoundingOfSum * size);
    return *this;
  }
  TaylorModel& operator-=(const TaylorModel& other) { return *this += -other; }
  TaylorModel& operator*=(const TaylorModel& other) { return *this = *this * other; }
  TaylorModel& operator/=(const TaylorModel& other) { return *this = *this / other; }
  friend TaylorModel operator+(TaylorModel a, const TaylorModel& b) { return a += b; }
  friend TaylorModel operator-(TaylorModel a, const TaylorModel& b) { return a -= b; }

  friend TaylorModel operator*(const TaylorModel& a, const TaylorModel& b) {
    TaylorModel result(0.0);
    for (std::size_t i = 0; i < kTerms; ++i) {
      const double factor = a.coefficients_[i];
      if (factor == 0.0) {
        continue;
      }
      const std::size_t partners = Monomials::kCountUpTo[Degree - Monomials::kDegrees[i]];
      for (std::size_t j = 0; j < partners; ++j) {
        result.coefficients_[Monomials::kProducts[i][j]] += factor * b.coefficients_[j];
      }
    }
    // The size of the terms of each degree bounds the terms above Degree, since |monomial| <= 1.
    const auto sizes_a = a.sizes_by_degree();
    const auto sizes_b = b.sizes_by_degree();
    double cut_off = 0.0;
    double size_a = 0.0;
    double size_b = 0.0;
    for (std::size_t i = 0; i <= Degree; ++i) {
      size_a += sizes_a[i];
      size_b += sizes_b[i];
      for (std::size_t j = static_cast<std::size_t>(Degree) + 1 - i; j <= Degree; ++j) {
        cut_off += sizes_a[i] * sizes_b[j];
      }
    }
    result.remainder_ = enlarged(cut_off + kRoundingOfProduct * size_a * size_b + size_a * b.remainder_ +
                                 size_b * a.remainder_ + a.remainder_ * b.remainder_);
    return result;
  }
  friend TaylorModel operator/(const TaylorModel& a, const TaylorModel& b) { return a * reciprocal(b); }

  /// 1/x. Nothing is known of it when the range of x contains zero.
  friend TaylorModel reciprocal(const TaylorModel& x) {
    const double deviation = x.deviation();
    const double distance = below(std::fabs(x.constant()) - deviation);
    if (!(distance > 0.0)) {
      return TaylorModel();
    }
    // With x = c + h: sum_k (-h)^k / c^(k+1), and a rest of (-h/c)^(Degree+1) / x, |x| >= distance.
    std::array<Interval, kSlopes> slopes;
    const Interval inverse = Interval(1.0) / Interval(x.constant());
    slopes[0] = inverse;
    for (std::size_t k = 1; k < kSlopes; ++k) {
      slopes[k] = -(slopes[k - 1] * inverse);
    }
    const Interval ratio = Interval(deviation) * abs(inverse);
    const Interval rest = pow(ratio, Degree + 1) / Interval(distance);
    return x.composed(slopes, rest.upper());
  }

  // Dual's requirements on its scalar.
  [[nodiscard]] friend bool is_known(const TaylorModel& x) noexcept { return !std::isnan(x.remainder_); }
  friend void make_unknown(TaylorModel& x) noexcept { x = TaylorModel(); }

  friend TaylorModel square(const TaylorModel& x) { return x * x; }

  /// (sin x, cos x), x in rad.
  friend std::pair<TaylorModel, TaylorModel> sin_cos(const TaylorModel& x) {
    // The derivatives of sin are sin, cos, -sin, -cos; all are at most 1.
    const auto [sine, cosine] = sin_cos(Interval(x.constant()));
    const std::array<Interval, 4> derivatives = {sine, cosine, -sine, -cosine};
    std::array<Interval, kSlopes> sine_slopes;
    std::array<Interval, kSlopes> cosine_slopes;
    Interval factorial(1.0);
    for (std::size_t k = 0; k < kSlopes; ++k) {
      sine_slopes[k] = derivatives[k % 4] / factorial;
      cosine_slopes[k] = derivatives[(k + 1) % 4] / factorial;
      factorial *= Interval(static_cast<double>(k + 1));
    }
    const Interval rest = pow(Interval(x.deviation()), Degree + 1) / factorial;
    return {x.composed(sine_slopes, rest.upper()), x.composed(cosine_slopes, rest.upper())};
  }

 private:
  template <int, int>
  friend class TaylorModel;
  static constexpr std::size_t kSlopes = static_cast<std::size_t>(Degree) + 1;
  static constexpr double kRoundingOfSum = 0x1p-51;      // one rounding, in terms of the rounded result
  static constexpr double kRoundingOfProduct = 0x1p-43;  // up to kTerms roundings, in terms of the operands
  static_assert(kTerms <= 256, "kRoundingOfProduct and `enlarged` count on it");

  /// An upper bound on the exact value of a sum of up to 1000 non-negative terms whose computed value is
  /// `bound`, for every rounding and underflow.
  static double enlarged(double bound) { return bound * (1.0 + 0x1p-40) + 1e-300; }
  /// A lower bound on the exact value of one difference.
  static double below(double difference) { return difference - std::fabs(difference) * 0x1p-50 - 1e-300; }

  static double radius_around(const Interval& range, double center) {
    return magnitude(range - Interval(center));
  }

  [[nodiscard]] std::array<double, kSlopes> sizes_by_degree() const {
    std::array<double, kSlopes> sizes{};
    for (std::size_t i = 0; i < kTerms; ++i) {
      sizes[Monomials::kDegrees[i]] += std::fabs(coefficients_[i]);
    }
    return sizes;
  }

  /// A bound on the distance of all values from constant(); NaN when nothing is known.
  [[nodiscard]] double deviation() const {
    double size = 0.0;
    for (std::size_t i = 1; i < kTerms; ++i) {
      size += std::fabs(coefficients_[i]);
    }
    return enlarged(size + remainder_);
  }

  /// The range of the terms from number `first` on, with the remainder; even powers are never negative.
  [[nodiscard]] Interval range_from(std::size_t first) const {
    double above = 0.0;
    double beneath = 0.0;
    for (std::size_t i = first; i < kTerms; ++i) {
      const double size = std::fabs(coefficients_[i]);
      const bool one_sided = Monomials::kIsSquare[i];
      above += one_sided && coefficients_[i] < 0.0 ? 0.0 : size;
      beneath += one_sided && coefficients_[i] > 0.0 ? 0.0 : size;
    }
    return Interval::from_bounds(-enlarged(beneath + remainder_), enlarged(above + remainder_));
  }

  /// sum_k slopes[k] h^k within +-rest, where h is this without its constant.
  [[nodiscard]] TaylorModel composed(const std::array<Interval, kSlopes>& slopes, double rest) const {
    TaylorModel h = *this;
    h.coefficients_[0] = 0.0;
    TaylorModel result(slopes[kSlopes - 1]);
    for (std::size_t k = kSlopes - 1; k > 0; --k) {
      result = h * result + TaylorModel(slopes[k - 1]);
    }
    result.remainder_ = enlarged(result.remainder_ + rest);
    return result;
  }

  Coefficients coefficients_;
  double remainder_;
};

}  // namespace veritrack::rigor

namespace Eigen {

template <int Variables, int Degree>
struct NumTraits<veritrack::rigor::TaylorModel<Variables, Degree>>
    : veritrack::rigor::CostlyEigenScalar<veritrack::rigor::TaylorModel<Variables, Degree>> {};

}  // namespace Eigen
