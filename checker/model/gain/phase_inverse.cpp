#include "checker/model/gain/phase_inverse.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "checker/model/gain/exact_number.hpp"
#include "checker/model/gain/phase_range.hpp"

namespace veritrack::checker {

namespace {

/// The place, from `first` on in both directions, of the entry that is certainly farthest from 0: states and
/// modes are of different sizes, so each row is seen in units of its largest entry, then each column.
std::pair<std::size_t, std::size_t> best_pivot(const PolynomialMatrix& matrix, std::size_t first) {
  const std::size_t n = matrix.size();
  std::vector<double> rows(n, 0.0);
  std::vector<double> columns(n, 0.0);
  for (std::size_t i = first; i < n; ++i) {
    for (std::size_t j = first; j < n; ++j) {
      rows[i] = std::max(rows[i], largest_over_cell(matrix[i][j]));
    }
    for (std::size_t j = first; j < n; ++j) {
      columns[j] = std::max(columns[j], largest_over_cell(matrix[i][j]) / rows[i]);
    }
  }
  std::pair<std::size_t, std::size_t> best{first, first};
  double farthest = 0.0;
  for (std::size_t i = first; i < n; ++i) {
    for (std::size_t j = first; j < n; ++j) {
      const DoubleRange entry = range_over_cell(matrix[i][j]);
      const double share = std::max(entry.low, -entry.high) / (rows[i] * columns[j]);
      if (share > farthest) {
        farthest = share;
        best = {i, j};
      }
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
  std::vector<std::size_t> unknowns(n);  // of the columns, which trade places
  std::iota(unknowns.begin(), unknowns.end(), std::size_t{0});
  for (std::size_t i = 0; i < n; ++i) {
    const auto [pivot, column] = best_pivot(matrix, i);
    std::swap(matrix[i], matrix[pivot]);
    std::swap(sides[i], sides[pivot]);
    std::swap(unknowns[i], unknowns[column]);
    for (PolynomialRow& row : matrix) {
      std::swap(row[i], row[column]);
    }
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
  PolynomialMatrix solution(n);
  for (std::size_t i = 0; i < n; ++i) {
    solution[unknowns[i]] = std::move(sides[i]);
  }
  return solution;
}

}  // namespace veritrack::checker
