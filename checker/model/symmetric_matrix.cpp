#include "checker/model/symmetric_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "checker/model/rounding.hpp"
#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

double SymmetricMatrix::length() const {
  double sum = 0.0;
  for (const double entry : entries_) {
    sum += entry * entry;
  }
  return bound_on(std::sqrt(sum));
}

double SymmetricMatrix::trace() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < size_; ++i) {
    sum += entries_[i * size_ + i];
  }
  return sum;
}

// When the factorisation of A in floating point comes to its end, A + E is positive semidefinite for some E
// with |E| <= g/(1 - g) trace A, where g = (n + 2) 2^-52 in any mode of rounding (Demmel; Higham, Accuracy
// and Stability, 10.1). Here A = (bound - shift) I - matrix, and the shift is more than that, and more than
// the losses of the diagonal by rounding and underflow.
bool certainly_bounded(const SymmetricMatrix& matrix, double bound CHECKER_DECLARED_PLACE) {
  CHECKER_IF_FORCED
  const std::size_t n = matrix.size();
  double size = static_cast<double>(n) * std::abs(bound);
  for (std::size_t i = 0; i < n; ++i) {
    size += std::abs(matrix(i, i));
  }
  const bool is_sensible = n > 0 && n <= 1000 && size > 0x1p-400 && size < 0x1p400;
  if (!is_sensible) {
    return false;
  }
  const double shift = size * static_cast<double>(n + 4) * 0x1p-49;
  std::vector<double> rows(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = i == j ? bound - shift - matrix(i, i) : -matrix(i, j);
      for (std::size_t k = 0; k < j; ++k) {
        rest -= rows[i * n + k] * rows[j * n + k];
      }
      if (i != j) {
        rows[i * n + j] = rest / rows[j * n + j];
      } else if (rest > 0x1p-450 && rest < 0x1p450) {
        rows[i * n + i] = std::sqrt(rest);
      } else {
        return false;
      }
    }
  }
  return true;
}

// Jacobi's rotations.
double near_largest_eigenvalue(const SymmetricMatrix& matrix) {
  const std::size_t n = matrix.size();
  spend(1 + static_cast<std::int64_t>(n * n / 2));
  std::vector<double> a(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      a[i * n + j] = matrix(i, j);
    }
  }
  constexpr int kSweeps = 12;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double off = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        (i == j ? all : off) += a[i * n + j] * a[i * n + j];
      }
    }
    if (!(off > 1e-26 * all)) {
      break;
    }
    for (std::size_t p = 0; p < n; ++p) {
      for (std::size_t q = p + 1; q < n; ++q) {
        const double entry = a[p * n + q];
        if (entry == 0.0) {
          continue;
        }
        const double theta = (a[q * n + q] - a[p * n + p]) / (2.0 * entry);
        const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
        const double c = 1.0 / std::sqrt(t * t + 1.0);
        const double s = t * c;
        for (std::size_t k = 0; k < n; ++k) {
          const double first = a[p * n + k];
          const double second = a[q * n + k];
          a[p * n + k] = c * first - s * second;
          a[q * n + k] = s * first + c * second;
        }
        for (std::size_t k = 0; k < n; ++k) {
          const double first = a[k * n + p];
          const double second = a[k * n + q];
          a[k * n + p] = c * first - s * second;
          a[k * n + q] = s * first + c * second;
        }
      }
    }
  }
  double largest = n > 0 ? a[0] : 0.0;
  for (std::size_t i = 1; i < n; ++i) {
    largest = std::max(largest, a[i * n + i]);
  }
  return largest;
}

double eigenvalue_bound(const SymmetricMatrix& matrix) {
  const double proposal = near_largest_eigenvalue(matrix);
  for (const double margin : {0x1p-30, 0x1p-20}) {
    const double bound = proposal * (1.0 + margin);
    if (certainly_bounded(matrix, bound)) {
      return bound;
    }
  }
  const double length = matrix.length();
  return length < std::numeric_limits<double>::infinity() ? length : std::numeric_limits<double>::infinity();
}

}  // namespace veritrack::checker
