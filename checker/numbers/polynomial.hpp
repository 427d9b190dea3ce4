// Functions of three variables, each in [-1, 1], as polynomials with balls for coefficients: a polynomial
// represents all functions that are, at each point, the value of a polynomial with coefficients in the balls.
// The radii contain the truncation (terms of a degree above a limit) and everything that is not known
// exactly. Every result contains the exact result for all functions that its operands represent.
#pragma once

#include <arb_poly.h>

#include <cstddef>
#include <vector>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

class Polynomial {
 public:
  static constexpr std::size_t kVariables = 3;
  static constexpr std::size_t kMostDegree = 5;

  /// Zero.
  Polynomial() = default;
  Polynomial(Ball constant) { terms_.push_back(std::move(constant)); }  // NOLINT(google-explicit-constructor)
  /// The variable of this index, stretched to run over all of `range`.
  static Polynomial variable(const Ball& range, std::size_t index);

  [[nodiscard]] bool is_zero() const { return terms_.empty(); }
  [[nodiscard]] Ball constant() const { return terms_.empty() ? zero : terms_[0]; }
  /// All values.
  [[nodiscard]] Ball range() const;
  /// All functions within `distance` of this one; terms above the degree are truncated, here and in
  /// everything computed from it.
  [[nodiscard]] Polynomial lowered(std::size_t degree, const Ball& distance) const;
  /// Takes the midpoints of all coefficients. Returns a bound on the distance of any function that this
  /// represented from the remaining polynomial.
  Ball round();

  friend Polynomial operator+(const Polynomial& x, const Polynomial& y);
  friend Polynomial operator*(const Polynomial& x, const Polynomial& y);
  friend Polynomial operator*(const Ball& x, const Polynomial& y);
  friend Polynomial reciprocal(const Polynomial& x);
  friend Polynomial sqrt(const Polynomial& x);
  friend Polynomial sin(const Polynomial& x);
  friend Polynomial cos(const Polynomial& x);
  friend Polynomial arctangent(const Polynomial& x);

 private:
  /// One of Arb's functions of power series: f(argument), with the given numbers of terms and bits.
  using Series = void (*)(arb_poly_struct*, const arb_poly_struct*, slong, slong);
  [[nodiscard]] Polynomial composed(Series series) const;

  std::size_t limit_ = kMostDegree;
  std::vector<Ball> terms_;  ///< by degree: as many as the polynomial needs
};

inline Polynomial operator-(const Polynomial& x) {
  return Ball(-1.0) * x;
}
inline Polynomial operator-(const Polynomial& x, const Polynomial& y) {
  return x + (-y);
}
inline Polynomial square(const Polynomial& x) {
  return x * x;
}

}  // namespace veritrack::checker
