// The numbering of the powers of the place (s, z) in a cell.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "checker/model/ball_polynomial.hpp"
#include "checker/model/rounding.hpp"

namespace veritrack::checker {

/// s^l z^m: l and m.
struct Powers {
  int of_s = 0;
  int of_z = 0;
};
/// The powers of the coefficient with this number.
inline Powers powers_at(std::size_t place) {
  int degree = 0;
  while (places_up_to(degree) <= place) {
    ++degree;
  }
  const int of_z = static_cast<int>(place) - degree * (degree + 1) / 2;
  return {degree - of_z, of_z};
}

/// A bound on the root of the sum of squares.
inline double length_of(const std::vector<double>& entries) {
  double sum = 0.0;
  for (const double entry : entries) {
    sum += entry * entry;
  }
  return bound_on(std::sqrt(sum));
}

}  // namespace veritrack::checker
