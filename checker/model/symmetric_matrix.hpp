// Bounds on the eigenvalues of small symmetric matrices of doubles: proposed by rotations, proved by a
// Cholesky factorisation whose rounding is accounted for.
#pragma once

#include <cstddef>
#include <vector>

#include "checker/numbers/call_site.hpp"

namespace veritrack::checker {

/// Zeros at first.
class SymmetricMatrix {
 public:
  explicit SymmetricMatrix(std::size_t size) : size_(size), entries_(size * size, 0.0) {}

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] double operator()(std::size_t i, std::size_t j) const { return entries_[i * size_ + j]; }
  /// Adds to an entry of the lower triangle, i >= j, and to its mirror image.
  void add(std::size_t i, std::size_t j, double value) {
    entries_[i * size_ + j] += value;
    if (i != j) {
      entries_[j * size_ + i] += value;
    }
  }
  void add(const SymmetricMatrix& other, double factor) {
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      entries_[k] += factor * other.entries_[k];
    }
  }
  /// An upper bound of the square root of the sum of all squares, apart from rounding.
  [[nodiscard]] double length() const;
  [[nodiscard]] double trace() const;

 private:
  std::size_t size_;
  std::vector<double> entries_;
};

/// True only when no eigenvalue of the matrix exceeds `bound`; also false when anything is not finite.
bool certainly_bounded(const SymmetricMatrix& matrix, double bound CHECKER_PLACE);

/// Approximately the largest eigenvalue: a proposal.
double near_largest_eigenvalue(const SymmetricMatrix& matrix);

/// At least the largest eigenvalue of a matrix that is positive semidefinite apart from rounding; infinite
/// when nothing is known.
double eigenvalue_bound(const SymmetricMatrix& matrix);

}  // namespace veritrack::checker
