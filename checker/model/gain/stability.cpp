#include "checker/model/gain/stability.hpp"

#include <arb_mat.h>
#include <arb_poly.h>

namespace veritrack::checker {

namespace {

/// det(z - A), coefficients from the constant one on.
std::vector<Ball> characteristic_polynomial(const BallRows& matrix) {
  const auto n = static_cast<slong>(matrix.size());
  arb_mat_t entries;
  arb_poly_t polynomial;
  arb_mat_init(entries, n, n);
  arb_poly_init(polynomial);
  for (slong i = 0; i < n; ++i) {
    for (slong j = 0; j < n; ++j) {
      arb_set(arb_mat_entry(entries, i, j),
              matrix[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].raw());
    }
  }
  arb_mat_charpoly(polynomial, entries, precision());
  std::vector<Ball> coefficients(matrix.size() + 1);
  for (slong i = 0; i <= n; ++i) {
    arb_poly_get_coeff_arb(coefficients[static_cast<std::size_t>(i)].raw(), polynomial, i);
  }
  arb_mat_clear(entries);
  arb_poly_clear(polynomial);
  return coefficients;
}

enum class Roots { all_inside, one_outside, unknown };

/// Of p(radius z), about the unit circle: step by step to (p_n p(z) - p_0 z^n p(1/z)) / z, which has one root
/// fewer inside and as many outside, while |p_0| < |p_n|. Where |p_0| > |p_n| the product of the roots is
/// larger than 1.
Roots roots_about(const BallRows& matrix, const Ball& radius) {
  std::vector<Ball> p = characteristic_polynomial(matrix);
  Ball power = one;
  for (Ball& coefficient : p) {
    coefficient = coefficient * power;
    power = power * radius;
  }
  while (p.size() > 1) {
    const Ball first = abs(p.front());
    const Ball last = abs(p.back());
    if (certainly_less(last, first)) {
      return Roots::one_outside;
    }
    if (!certainly_less(first, last)) {
      return Roots::unknown;
    }
    std::vector<Ball> reduced;
    for (std::size_t i = 1; i < p.size(); ++i) {
      reduced.push_back(p.back() * p[i] - p.front() * p[p.size() - 1 - i]);
    }
    p = reduced;
  }
  return Roots::all_inside;
}

}  // namespace

bool all_eigenvalues_within(const BallRows& matrix, const Ball& radius) {
  return !matrix.empty() && certainly_positive(radius) && roots_about(matrix, radius) == Roots::all_inside;
}

bool an_eigenvalue_beyond(const BallRows& matrix, const Ball& radius) {
  return !matrix.empty() && certainly_positive(radius) && roots_about(matrix, radius) == Roots::one_outside;
}

}  // namespace veritrack::checker
