// Functions of two variables over a cell: polynomials of degree two with balls as coefficients.
#pragma once

#include <array>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// A function f over x, y in [-1, 1]: at every point f is in the ball that the polynomial has there. Terms of
/// higher degree go into the radius of the constant coefficient.
class CellSeries {
 public:
  CellSeries() = default;
  CellSeries(const Ball& constant) { c_[0] = constant; }  // NOLINT(google-explicit-constructor)
  /// constant + by_x x + by_y y.
  CellSeries(const Ball& constant, const Ball& by_x, const Ball& by_y) : c_{constant, by_x, by_y} {}

  [[nodiscard]] const Ball& constant() const { return c_[0]; }
  /// All values over the cell.
  [[nodiscard]] Ball range() const { return c_[0] + Ball::within(deviation()); }
  /// The linear part at x = 1 or -1, y = 1 or -1.
  [[nodiscard]] Ball corner(int x, int y) const {
    const Ball by_x = x > 0 ? c_[0] + c_[1] : c_[0] - c_[1];
    return y > 0 ? by_x + c_[2] : by_x - c_[2];
  }
  /// A bound on the quadratic part.
  [[nodiscard]] Ball bend() const { return abs(c_[3]) + abs(c_[4]) + abs(c_[5]); }
  /// A bound on the distance of the function from the polynomial with the middles of the coefficients; and
  /// that polynomial.
  [[nodiscard]] Ball remainder() const;
  void drop_remainder();

  CellSeries& operator+=(const CellSeries& other);
  CellSeries& operator-=(const CellSeries& other);
  CellSeries& operator*=(const Ball& factor);
  friend CellSeries operator*(const CellSeries& a, const CellSeries& b);
  friend CellSeries reciprocal(const CellSeries& a);
  friend struct SineCosine;

 private:
  /// The function without its constant.
  [[nodiscard]] CellSeries varying() const;
  /// A bound on that.
  [[nodiscard]] Ball deviation() const;

  std::array<Ball, 6> c_;  ///< of 1, x, y, x^2, x y, y^2
};

inline CellSeries operator+(CellSeries a, const CellSeries& b) {
  return a += b;
}
inline CellSeries operator-(CellSeries a, const CellSeries& b) {
  return a -= b;
}
inline CellSeries operator-(CellSeries a) {
  return a *= Ball(-1.0);
}
inline CellSeries operator*(const Ball& factor, CellSeries a) {
  return a *= factor;
}

/// sin and cos of a function.
struct SineCosine {
  CellSeries sine, cosine;
  explicit SineCosine(const CellSeries& argument);
};

}  // namespace veritrack::checker
