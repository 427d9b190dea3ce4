// Functions on a box with secant slopes: a value at the centre of the box, a range over it, and how much the
// function changes per unit from the centre.
//
// A Secant represents the functions f of the variables x in a box with centre c for which
//     f(c) in center(),  f(x) in range(),  f(x) = f(c) + sum_k s_k (x_k - c_k) with s_k in slope(k).
// Slopes between x and the centre are about half as wide as derivatives over the box, which a dual number
// would give: R. Krawczyk, A. Neumaier, Interval slopes for rational functions and associated centered forms,
// SIAM J. Numer. Anal. 22 (1985). Slopes that are zero because a function does not depend on a variable are
// not computed with.
//
// As for intervals, a finite result certifies that the expression was defined on all of the box.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/elementary_ratios.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::rigor {

/// See the top of this file. Every operation needs the upward mode.
template <int N>
class Secant {
 public:
  using Interval = rigor::Interval;
  static constexpr std::size_t kSize = static_cast<std::size_t>(N);
  using Slopes = std::array<Interval, kSize>;

  /// Must be assigned before use: empty.
  Secant() = default;
  explicit Secant(const Interval& constant) : center_(constant), range_(constant) {}
  explicit Secant(double constant) : Secant(Interval(constant)) {}
  /// The variable of this index, 0 <= index < N, over `range` with the centre `center`, a point of it.
  [[nodiscard]] static Secant variable(const Interval& range, double center, std::size_t index) {
    return affine(Interval(center), range, Interval(1.0), index);
  }
  /// center + slope (x - c) in the one variable `index`, with this range.
  [[nodiscard]] static Secant affine(const Interval& center, const Interval& range, const Interval& slope,
                                     std::size_t index) {
    Secant result;
    result.center_ = center;
    result.range_ = range;
    result.depends_[index] = true;
    result.slopes_[index] = slope;
    return result;
  }

  [[nodiscard]] const Interval& center() const noexcept { return center_; }
  [[nodiscard]] const Interval& range() const noexcept { return range_; }
  [[nodiscard]] Interval slope(std::size_t index) const {
    return depends_[index] ? slopes_[index] : Interval(0.0);
  }

  /// f(c) + sum_k s_k offset_k for every s in the slopes: with x - c as the offset it contains f(x). Empty
  /// unless the function was defined on all of the box.
  [[nodiscard]] Interval moved_by(const Slopes& offset) const {
    if (!is_finite(range_)) {
      return Interval::empty();
    }
    Interval value = center_;
    for (std::size_t k = 0; k < kSize; ++k) {
      if (depends_[k]) {
        value += slopes_[k] * offset[k];
      }
    }
    return value;
  }

  /// The same function, for which this range is also known.
  [[nodiscard]] Secant within(const Interval& range) const {
    Secant result = *this;
    result.range_ = intersection(range_, range);
    return result;
  }

  /// This function followed by one with these values at the centre and over the box, and this secant slope.
  [[nodiscard]] Secant chain(const Interval& center, const Interval& range, const Interval& slope) const {
    Secant result;
    result.center_ = center;
    result.range_ = range;
    result.depends_ = depends_;
    for (std::size_t k = 0; k < kSize; ++k) {
      if (depends_[k]) {
        result.slopes_[k] = slope * slopes_[k];
      }
    }
    return result;
  }

  Secant operator-() const { return chain(-center_, -range_, Interval(-1.0)); }
  Secant& operator+=(const Secant& other) {
    center_ += other.center_;
    range_ += other.range_;
    for (std::size_t k = 0; k < kSize; ++k) {
      if (other.depends_[k]) {
        slopes_[k] = depends_[k] ? slopes_[k] + other.slopes_[k] : other.slopes_[k];
        depends_[k] = true;
      }
    }
    return *this;
  }
  Secant& operator-=(const Secant& other) {
    center_ -= other.center_;
    range_ -= other.range_;
    for (std::size_t k = 0; k < kSize; ++k) {
      if (other.depends_[k]) {
        slopes_[k] = depends_[k] ? slopes_[k] - other.slopes_[k] : -other.slopes_[k];
        depends_[k] = true;
      }
    }
    return *this;
  }
  Secant& operator*=(const Secant& other) { return *this = *this * other; }
  friend Secant operator+(Secant a, const Secant& b) { return a += b; }
  friend Secant operator-(Secant a, const Secant& b) { return a -= b; }

  /// f g - f(c) g(c) = (f + f(c))/2 (g - g(c)) + (g + g(c))/2 (f - f(c)).
  friend Secant operator*(const Secant& a, const Secant& b) {
    Secant result;
    result.center_ = a.center_ * b.center_;
    result.range_ = a.range_ * b.range_;
    const Interval of_a = a.mean();
    const Interval of_b = b.mean();
    for (std::size_t k = 0; k < kSize; ++k) {
      if (a.depends_[k]) {
        result.slopes_[k] = of_b * a.slopes_[k];
        if (b.depends_[k]) {
          result.slopes_[k] += of_a * b.slopes_[k];
        }
      } else if (b.depends_[k]) {
        result.slopes_[k] = of_a * b.slopes_[k];
      }
      result.depends_[k] = a.depends_[k] || b.depends_[k];
    }
    return result;
  }
  /// f/g - f(c)/g(c) = (f - f(c) - f(c)/g(c) (g - g(c)))/g. Empty when the range of g contains zero.
  friend Secant operator/(const Secant& a, const Secant& b) {
    Secant result;
    result.center_ = a.center_ / b.center_;
    result.range_ = a.range_ / b.range_;
    const Interval reciprocal = Interval(1.0) / b.range_;
    for (std::size_t k = 0; k < kSize; ++k) {
      result.depends_[k] = a.depends_[k] || b.depends_[k];
      if (result.depends_[k]) {
        result.slopes_[k] = (a.slope(k) - result.center_ * b.slope(k)) * reciprocal;
      }
    }
    return result;
  }

  /// Contains (f(x) + f(c))/2 for every x of the box.
  [[nodiscard]] Interval mean() const { return Interval(0.5) * (center_ + range_); }

 private:
  Interval center_, range_;
  Slopes slopes_;
  std::array<bool, kSize> depends_{};
};

/// f^2 - f(c)^2 = (f + f(c)) (f - f(c)).
template <int N>
[[nodiscard]] Secant<N> square(const Secant<N>& x) {
  return x.chain(rigor::square(x.center()), rigor::square(x.range()), x.center() + x.range());
}

/// Empty when the range reaches below zero.
template <int N>
[[nodiscard]] Secant<N> sqrt(const Secant<N>& x) {
  const rigor::Interval center = rigor::sqrt(x.center());
  const rigor::Interval range = rigor::sqrt(x.range());
  return x.chain(center, range, rigor::Interval(1.0) / (center + range));
}

/// sin a - sin b = 2 cos((a + b)/2) sin((a - b)/2), and the same for the cosine. Empty where x may be more
/// than 6 from the centre.
template <int N>
[[nodiscard]] std::pair<Secant<N>, Secant<N>> sin_cos(const Secant<N>& x) {
  const auto center = rigor::sin_cos(x.center());
  const auto range = rigor::sin_cos(x.range());
  const auto mean = rigor::sin_cos(x.mean());
  const rigor::Interval ratio = sine_ratio(rigor::Interval(0.5) * (x.range() - x.center()));
  return {x.chain(center.first, range.first, mean.second * ratio),
          x.chain(center.second, range.second, -(mean.first * ratio))};
}

template <int N>
[[nodiscard]] Secant<N> sine_ratio(const Secant<N>& x) {
  return x.chain(sine_ratio(x.center()), sine_ratio(x.range()), -(x.range() * sine_ratio_slope(x.range())));
}

template <int N>
[[nodiscard]] Secant<N> arctangent_ratio(const Secant<N>& t) {
  return t.chain(arctangent_ratio(t.center()), arctangent_ratio(t.range()),
                 -(t.range() * arctangent_ratio_slope(t.range())));
}

}  // namespace veritrack::rigor
