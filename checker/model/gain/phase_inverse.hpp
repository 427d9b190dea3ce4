// The inverse of a matrix of functions over a cell of phases and frequencies.
#pragma once

#include <vector>

#include "checker/model/ball_polynomial.hpp"

namespace veritrack::checker {

/// By entry.
using PolynomialRow = std::vector<BallPolynomial>;
using PolynomialMatrix = std::vector<PolynomialRow>;

/// By Gaussian elimination. Throws NotCovered where no pivot certainly differs from 0.
PolynomialMatrix inverse_of(PolynomialMatrix matrix);

}  // namespace veritrack::checker
