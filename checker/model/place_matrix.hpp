// Matrices of functions of the place (s, z) in a cell alone.
#pragma once

#include <cstddef>
#include <vector>

#include "checker/model/ball_polynomial.hpp"

namespace veritrack::checker {

/// Rows of ball polynomials without vectors.
using PlaceMatrix = std::vector<std::vector<BallPolynomial>>;

PlaceMatrix place_matrix(std::size_t rows, std::size_t columns);
PlaceMatrix product(const PlaceMatrix& a, const PlaceMatrix& b);
PlaceMatrix sum(const PlaceMatrix& a, const PlaceMatrix& b, const BallPolynomial& factor_of_b);
PlaceMatrix mirrored(const PlaceMatrix& a);
/// The symmetric matrix of a lower triangle, row by row.
PlaceMatrix symmetric_of(const std::vector<BallPolynomial>& triangle, std::size_t rows);
/// A lower triangular L with L L' = A; unknown unless the pivots are certainly positive.
PlaceMatrix root_of(const PlaceMatrix& a);
/// L^-1 b.
std::vector<BallPolynomial> forward(const PlaceMatrix& l, const std::vector<BallPolynomial>& b);
/// The inverse of a symmetric matrix of one or two rows; unknown unless the matrix is certainly positive
/// definite.
PlaceMatrix positive_inverse(const PlaceMatrix& a);

/// Approximately the matrix in the middle of the cell: a proposal.
PlaceMatrix middle_of(const PlaceMatrix& a);
/// Approximately the least eigenvalue of a in the middle of the cell, in units of a positive definite matrix;
/// minus infinity when there is none. Not evidence.
double near_least_eigenvalue(const PlaceMatrix& a, const PlaceMatrix& unit);

/// The inverse of the Cholesky factor in doubles, row by row; without rows when there is none. Not evidence.
std::vector<std::vector<double>> near_inverse_root(const std::vector<std::vector<double>>& a);

/// True only when the symmetric matrix whose lower triangle this is is positive definite for all s and z.
bool certainly_definite(const PlaceMatrix& a);

}  // namespace veritrack::checker
