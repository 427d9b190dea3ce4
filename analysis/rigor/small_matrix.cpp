#include "analysis/rigor/small_matrix.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <stdexcept>
#include <utility>

namespace veritrack::rigor {

namespace {

/// So that nothing is written behind the end: Eigen itself does not look in a release build.
SmallMatrix of_size(Eigen::Index rows, Eigen::Index columns) {
  if (rows > kMostSmallRows || columns > kMostSmallRows) {
    throw std::length_error("a matrix of more than 20 rows or columns is not small");
  }
  return {rows, columns};
}

SmallMatrix small(const MatrixView& a) {
  SmallMatrix copy = of_size(a.rows(), a.cols());
  copy = a;
  return copy;
}

}  // namespace

SmallMatrix identity(Eigen::Index rows) {
  SmallMatrix unit = of_size(rows, rows);
  unit.setIdentity();
  return unit;
}

SmallMatrix transposed(const MatrixView& a) {
  SmallMatrix result = of_size(a.cols(), a.rows());
  result = a.transpose();
  return result;
}

SmallMatrix product(const MatrixView& a, const MatrixView& b) {
  SmallMatrix result = of_size(a.rows(), b.cols());
  result.noalias() = a * b;
  return result;
}

SmallMatrix product_with_transpose(const MatrixView& a, const MatrixView& b) {
  SmallMatrix result = of_size(a.rows(), b.rows());
  result.noalias() = a * b.transpose();
  return result;
}

SmallMatrix congruence(const MatrixView& f, const MatrixView& p) {
  return product_with_transpose(product(f, p), f);
}

SmallMatrix combination(double s, const MatrixView& a, double t, const MatrixView& b) {
  SmallMatrix result = of_size(a.rows(), a.cols());
  result = s * a + t * b;
  return result;
}

SmallMatrix stacked(const MatrixView& a, const MatrixView& b) {
  SmallMatrix both = of_size(a.rows() + b.rows(), a.cols());
  both.topRows(a.rows()) = a;
  both.bottomRows(b.rows()) = b;
  return both;
}

SmallMatrix approximate_inverse(const MatrixView& a) {
  return small(a).inverse();
}

SmallMatrix symmetric_solution(const MatrixView& s, const MatrixView& b) {
  return small(s).ldlt().solve(small(b));
}

std::optional<SmallMatrix> cholesky(const MatrixView& s) {
  const Eigen::LLT<SmallMatrix> root(small(s));
  SmallMatrix lower = root.matrixL();
  // Eigen takes a pivot that is not a number for a positive one.
  return root.info() == Eigen::Success && lower.allFinite() ? std::optional(std::move(lower)) : std::nullopt;
}

SmallMatrix lower_solution(const SmallMatrix& l, const MatrixView& b) {
  SmallMatrix x = small(b);
  l.triangularView<Eigen::Lower>().solveInPlace(x);
  return x;
}

SmallMatrix in_units_of(const SmallMatrix& l, const MatrixView& s) {
  return lower_solution(l, transposed(lower_solution(l, s)));
}

}  // namespace veritrack::rigor
