// Matrices of three rows of balls, which need not be symmetric: products, inverses near a middle,
// definiteness of blocks.
#pragma once

#include "checker/numbers/matrix3.hpp"

namespace veritrack::checker {

Matrix3 product(const Matrix3& a, const Matrix3& b);
Matrix3 transposed(const Matrix3& a);
/// A B A' without assuming that B is symmetric.
Matrix3 about(const Matrix3& a, const Matrix3& b);
Matrix3 identity(const Ball& scale);
/// The inverse of all matrices in the balls, for narrow ones. Balls of everything where that may fail.
Matrix3 inverse_near(const Matrix3& a);
/// The 6x6 matrix [a, b'; b, c].
bool definite_together(const Matrix3& a, const Matrix3& b, const Matrix3& c);
/// The 9x9 matrix [a, b', d'; b, c, e'; d, e, f].
bool definite_together(const Matrix3& a, const Matrix3& b, const Matrix3& c, const Matrix3& d,
                       const Matrix3& e, const Matrix3& f);

}  // namespace veritrack::checker
