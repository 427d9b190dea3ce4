// Power series in one variable, truncated after a number of terms: Arb's polynomials with C++ operators. The
// coefficients of a series about a ball contain those about each of its points; the last of them bounds the
// remainder of the Taylor polynomial (Lagrange).
#pragma once

#include <arb_poly.h>

#include <utility>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

template <slong Terms>
class Series {
 public:
  Series() { arb_poly_init(x_); }
  Series(const Ball& constant) : Series() {  // NOLINT(google-explicit-constructor)
    arb_poly_set_arb(x_, constant.raw());
  }
  Series(const Series& other) : Series() { arb_poly_set(x_, other.x_); }
  Series(Series&& other) noexcept : Series() { arb_poly_swap(x_, other.x_); }
  ~Series() { arb_poly_clear(x_); }
  Series& operator=(const Series& other) {
    arb_poly_set(x_, other.x_);
    return *this;
  }
  Series& operator=(Series&& other) noexcept {
    arb_poly_swap(x_, other.x_);
    return *this;
  }
  Series(double constant) : Series(Ball(constant)) {}  // NOLINT(google-explicit-constructor)
  /// base + slope x.
  static Series linear(const Ball& base, const Ball& slope) {
    Series z(base);
    z.set(1, slope);
    return z;
  }

  [[nodiscard]] Ball operator[](slong power) const {
    Ball z;
    arb_poly_get_coeff_arb(z.raw(), x_, power);
    return z;
  }
  void set(slong power, const Ball& coefficient) { arb_poly_set_coeff_arb(x_, power, coefficient.raw()); }

  friend Series operator+(const Series& x, const Series& y) {
    Series z;
    arb_poly_add(z.x_, x.x_, y.x_, precision());
    return z;
  }
  friend Series operator-(const Series& x, const Series& y) {
    Series z;
    arb_poly_sub(z.x_, x.x_, y.x_, precision());
    return z;
  }
  friend Series operator*(const Series& x, const Series& y) {
    Series z;
    arb_poly_mullow(z.x_, x.x_, y.x_, Terms, precision());
    return z;
  }
  friend Series reciprocal(const Series& x) {
    Series z;
    arb_poly_inv_series(z.x_, x.x_, Terms, precision());
    return z;
  }
  friend std::pair<Series, Series> sine_cosine(const Series& x) {
    std::pair<Series, Series> z;
    arb_poly_sin_cos_series(z.first.x_, z.second.x_, x.x_, Terms, precision());
    return z;
  }

 private:
  arb_poly_t x_;
};

}  // namespace veritrack::checker
