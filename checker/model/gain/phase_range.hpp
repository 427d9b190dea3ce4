// Ranges of functions over a cell of phases and frequencies, nearly as small as they are.
#pragma once

#include "checker/model/ball_polynomial.hpp"

namespace veritrack::checker {

/// The least and the largest value, outward; infinite where it is not known.
struct DoubleRange {
  double low = 0.0, high = 0.0;
};

/// The range of a function of the place alone.
DoubleRange range_over_cell(const BallPolynomial& x);
/// Not below |x|.
double largest_in(const DoubleRange& range);
inline double largest_over_cell(const BallPolynomial& x) {
  return largest_in(range_over_cell(x));
}

}  // namespace veritrack::checker
