// Functions of two variables over a cell: polynomials of degree two with balls as coefficients.
#pragma once

#include <array>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// A function f over x, y in [-1, 1]: at every point f is in the ball that the polynomial has there. What is
/// of a higher degree goes into the radius of the constant coefficient.
class CellSeries {
 public:
  CellSeries() = default;
  CellSeries(const Ball& constant) { c_[0] = constant; }  // NOLINT(google-explicit-constructor)
  /// constant + by_x x + by_y y.
  CellSeries(const Ball& constant, const Ball& by_x, const Ball& by_y) : c_{constant, by_x, by_y} {}

  [[nodiscard]] const Ball& constant() const { return c_[0]; }
  /// All values over the cell.
  [[nodiscard]] Ball range() const { return c_[0] + Ball::within(deviation()); }
  /// Makes the coefficients exact; returns how far the function may be from the polynomial that is left.
  Ball take_remainder();

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
