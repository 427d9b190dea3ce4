#include "analysis/rigor/lyapunov.hpp"

#include <algorithm>
#include <stdexcept>

#include "analysis/rigor/linear_solve.hpp"

namespace veritrack::rigor::detail {

namespace {

/// The place of entry (i, j) = (j, i) of a symmetric matrix in the list of its entries on and below the
/// diagonal.
Eigen::Index place(Eigen::Index i, Eigen::Index j) {
  const Eigen::Index row = std::max(i, j);
  return row * (row + 1) / 2 + std::min(i, j);
}

Eigen::Index places(Eigen::Index size) {
  return size * (size + 1) / 2;
}

/// The symmetric members of q, listed.
std::optional<DynamicIntervalMatrix> list_entries(const DynamicIntervalMatrix& q) {
  DynamicIntervalMatrix list(places(q.rows()), 1);
  for (Eigen::Index i = 0; i < q.rows(); ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      list(place(i, j)) = intersection(q(i, j), q(j, i));
    }
  }
  return is_finite(list) ? std::optional(list) : std::nullopt;
}

/// Solves system * entries(X) = entries(q) and folds the list into a matrix.
std::optional<DynamicIntervalMatrix> solve_for_entries(const DynamicIntervalMatrix& system,
                                                       const DynamicIntervalMatrix& q) {
  const std::optional<DynamicIntervalMatrix> right = list_entries(q);
  if (!right) {
    return std::nullopt;
  }
  const std::optional<DynamicIntervalMatrix> list = solve(system, *right);
  if (!list) {
    return std::nullopt;
  }
  DynamicIntervalMatrix solution(q.rows(), q.cols());
  for (Eigen::Index i = 0; i < q.rows(); ++i) {
    for (Eigen::Index j = 0; j < q.cols(); ++j) {
      solution(i, j) = (*list)(place(i, j));
    }
  }
  return solution;
}

void require_equal_squares(const DynamicIntervalMatrix& a, const DynamicIntervalMatrix& q) {
  if (a.rows() != a.cols() || q.rows() != a.rows() || q.cols() != a.cols()) {
    throw std::invalid_argument("Lyapunov equation: square matrices of equal size are needed");
  }
}

}  // namespace

std::optional<DynamicIntervalMatrix> solve_discrete_lyapunov(const DynamicIntervalMatrix& a,
                                                             const DynamicIntervalMatrix& q) {
  require_equal_squares(a, q);
  const Eigen::Index size = a.rows();
  // x_ij - sum_kl a_ik a_jl x_kl = q_ij.
  DynamicIntervalMatrix system = DynamicIntervalMatrix::Identity(places(size), places(size));
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      for (Eigen::Index k = 0; k < size; ++k) {
        for (Eigen::Index l = 0; l < size; ++l) {
          // The same factor twice is a square, which an interval product would not know.
          const Interval product = i == j && k == l ? square(a(i, k)) : a(i, k) * a(j, l);
          system(place(i, j), place(k, l)) -= product;
        }
      }
    }
  }
  return solve_for_entries(system, q);
}

std::optional<DynamicIntervalMatrix> solve_continuous_lyapunov(const DynamicIntervalMatrix& a,
                                                               const DynamicIntervalMatrix& q) {
  require_equal_squares(a, q);
  const Eigen::Index size = a.rows();
  // -sum_k (a_ik x_kj + a_jk x_ik) = q_ij.
  DynamicIntervalMatrix system = DynamicIntervalMatrix::Zero(places(size), places(size));
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      for (Eigen::Index k = 0; k < size; ++k) {
        system(place(i, j), place(k, j)) -= a(i, k);
        system(place(i, j), place(i, k)) -= a(j, k);
      }
    }
  }
  return solve_for_entries(system, q);
}

}  // namespace veritrack::rigor::detail
