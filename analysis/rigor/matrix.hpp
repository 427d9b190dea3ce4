// Vectors and matrices of intervals: Eigen for storage, sums and products, whose results inherit the promise of
// interval.hpp because every scalar operation in them is an interval operation. Eigen's decompositions are not for
// intervals (they pivot on comparisons and stop on tolerances); the verified ones are in the headers beside this one.
#pragma once

#include <Eigen/Core>

#include "analysis/rigor/interval.hpp"

namespace Eigen {

template <>
struct NumTraits<veritrack::rigor::Interval> : GenericNumTraits<veritrack::rigor::Interval> {
  using Real = veritrack::rigor::Interval;
  using NonInteger = veritrack::rigor::Interval;
  using Nested = veritrack::rigor::Interval;
  using Literal = double;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1, ReadCost = 2, AddCost = 4, MulCost = 12 };
};

}  // namespace Eigen

namespace veritrack::rigor {

template <int Rows, int Columns = Rows>
using Matrix = Eigen::Matrix<double, Rows, Columns>;
template <int Rows, int Columns = Rows>
using IntervalMatrix = Eigen::Matrix<Interval, Rows, Columns>;
template <int Size>
using IntervalVector = Eigen::Matrix<Interval, Size, 1>;

/// The matrix of points with exactly these double entries.
template <typename Derived>
[[nodiscard]] auto to_interval(const Eigen::MatrixBase<Derived>& matrix) {
  return matrix.unaryExpr([](double entry) { return Interval(entry); }).eval();
}

/// Entry by entry, see midpoint(Interval).
template <typename Derived>
[[nodiscard]] auto midpoint(const Eigen::MatrixBase<Derived>& matrix) {
  return matrix.unaryExpr([](const Interval& entry) { return midpoint(entry); }).eval();
}

/// Entry by entry, see radius(Interval).
template <typename Derived>
[[nodiscard]] auto radius(const Eigen::MatrixBase<Derived>& matrix) {
  return matrix.unaryExpr([](const Interval& entry) { return radius(entry); }).eval();
}

/// True when every entry is finite; false for anything that may not enter a proof.
template <typename Derived>
[[nodiscard]] bool is_finite(const Eigen::MatrixBase<Derived>& matrix) {
  for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
      if (!is_finite(Interval(matrix.derived().coeff(row, column)))) {
        return false;
      }
    }
  }
  return matrix.size() > 0;
}

}  // namespace veritrack::rigor
