// Symmetric 3 x 3 matrices of doubles, for proposals that decompose many of them: Eigen's, of fixed size,
// behind plain functions so that each is compiled once. Nothing here is evidence; rounding is the caller's.
// Of a symmetric matrix the lower triangle is read.
#pragma once

#include <optional>

#include "analysis/rigor/matrix.hpp"

namespace veritrack::rigor {

struct ThreeEigensystem {
  Vector<3> values;   ///< ascending
  Matrix<3> vectors;  ///< a column for each
};

/// By a closed formula, whose vectors are of length 1. The result is arbitrary where an entry is not finite.
[[nodiscard]] ThreeEigensystem eigensystem_of_three(const Matrix<3>& symmetric);
/// The eigensystem of A v = t B v, B positive definite; v'B v = 1. NaN where none is found.
[[nodiscard]] ThreeEigensystem pencil_of_three(const Matrix<3>& a, const Matrix<3>& b);

/// The lower triangle L with L L' = S; nothing where S is not positive definite.
[[nodiscard]] std::optional<Matrix<3>> cholesky_of_three(const Matrix<3>& symmetric);
/// The least eigenvalue of S in units of L L', by a closed formula: of L^-1 S L^-T.
[[nodiscard]] double least_eigenvalue_in_units(const Matrix<3>& l, const Matrix<3>& symmetric);

}  // namespace veritrack::rigor
