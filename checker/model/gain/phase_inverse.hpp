// Linear equations whose coefficients are functions over a cell of phases and frequencies.
#pragma once

#include <vector>

#include "checker/model/ball_polynomial.hpp"

namespace veritrack::checker {

/// By entry.
using PolynomialRow = std::vector<BallPolynomial>;
using PolynomialMatrix = std::vector<PolynomialRow>;

/// matrix^-1 sides, by Gaussian elimination on the sides themselves: the product with an inverse would add up
/// errors that cancel here. Throws NotCovered where no pivot certainly differs from 0.
PolynomialMatrix solution_of(PolynomialMatrix matrix, PolynomialMatrix sides);

}  // namespace veritrack::checker
