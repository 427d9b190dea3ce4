#include "checker/model/gain/phase_inverse.hpp"

#include <algorithm>
#include <utility>

#include "checker/model/gain/exact_number.hpp"
#include "checker/model/gain/phase_range.hpp"

namespace veritrack::checker {

namespace {

/// The row from `first` on whose entry in that column is certainly farthest from 0, as a share of the row:
/// states are of different sizes.
std::size_t best_pivot(const PolynomialMatrix& matrix, std::size_t first) {
  std::size_t best = first;
  double farthest = 0.0;
  for (std::size_t row = first; row < matrix.size(); ++row) {
    double size = 0.0;
    for (std::size_t j = first; j < matrix.size(); ++j) {
      size = std::max(size, largest_over_cell(matrix[row][j]));
    }
    const DoubleRange entry = range_over_cell(matrix[row][first]);
    const double least = std::max(entry.low, -entry.high);
    if (least > 0.0 && least / size > farthest) {
      farthest = least / size;
      best = row;
    }
  }
  if (!(farthest > 0.0)) {
    throw NotCovered("the basis is not certainly invertible");
  }
  return best;
}

}  // namespace

PolynomialMatrix inverse_of(PolynomialMatrix matrix) {
  const std::size_t n = matrix.size();
  PolynomialMatrix result(n, PolynomialRow(n));
  for (std::size_t i = 0; i < n; ++i) {
    result[i][i] = BallPolynomial(1.0);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t pivot = best_pivot(matrix, i);
    std::swap(matrix[i], matrix[pivot]);
    std::swap(result[i], result[pivot]);
    const BallPolynomial inverse = reciprocal(matrix[i][i]);
    for (std::size_t j = 0; j < n; ++j) {
      matrix[i][j] = inverse * matrix[i][j];
      result[i][j] = inverse * result[i][j];
    }
    for (std::size_t row = 0; row < n; ++row) {
      const BallPolynomial factor = matrix[row][i];
      for (std::size_t j = 0; j < n && row != i; ++j) {
        matrix[row][j] -= factor * matrix[i][j];
        result[row][j] -= factor * result[i][j];
      }
    }
  }
  return result;
}

}  // namespace veritrack::checker
