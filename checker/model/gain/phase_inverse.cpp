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

PolynomialMatrix solution_of(PolynomialMatrix matrix, PolynomialMatrix sides) {
  const std::size_t n = matrix.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t pivot = best_pivot(matrix, i);
    std::swap(matrix[i], matrix[pivot]);
    std::swap(sides[i], sides[pivot]);
    const BallPolynomial inverse = reciprocal(matrix[i][i]);
    const auto scale = [&inverse](PolynomialRow& entries, std::size_t from) {
      for (std::size_t j = from; j < entries.size(); ++j) {
        entries[j] = inverse * entries[j];
      }
    };
    scale(matrix[i], i);
    scale(sides[i], 0);
    for (std::size_t row = 0; row < n; ++row) {
      const BallPolynomial factor = matrix[row][i];
      for (std::size_t j = i; j < n && row != i; ++j) {
        matrix[row][j] -= factor * matrix[i][j];
      }
      for (std::size_t j = 0; j < sides[row].size() && row != i; ++j) {
        sides[row][j] -= factor * sides[i][j];
      }
    }
  }
  return sides;
}

}  // namespace veritrack::checker
