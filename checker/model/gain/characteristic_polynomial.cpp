#include "checker/model/gain/characteristic_polynomial.hpp"

#include <arb_mat.h>
#include <arb_poly.h>

namespace veritrack::checker {

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

ComplexBall exponential(const Ball& real, const Ball& imaginary) {
  const Ball size = exp(real);
  return {size * cos(imaginary), size * sin(imaginary)};
}

Ball length(const ComplexBall& x) {
  return root_of_non_negative(square(x.real) + square(x.imaginary));
}

ValuesInDisc values_in_disc(const std::vector<Ball>& polynomial, const ComplexBall& centre,
                            const Ball& radius) {
  std::vector<ComplexBall> taylor;
  taylor.reserve(polynomial.size());
  for (const Ball& coefficient : polynomial) {
    taylor.push_back({coefficient, zero});
  }
  // Divided by z - centre again and again: the remainders are the coefficients about the centre.
  for (std::size_t done = 0; done + 1 < taylor.size(); ++done) {
    for (std::size_t i = taylor.size() - 1; i-- > done;) {
      taylor[i] = taylor[i] + centre * taylor[i + 1];
    }
  }
  Ball spread;
  for (std::size_t i = taylor.size(); i-- > 1;) {
    spread = (spread + length(taylor[i])) * radius;
  }
  return {taylor.front(), spread};
}

}  // namespace veritrack::checker
