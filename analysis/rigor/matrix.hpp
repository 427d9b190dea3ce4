// Vectors and matrices of intervals: Eigen for storage, sums and products, whose results inherit the promise
// of interval.hpp because every scalar operation in them is an interval operation. Eigen's decompositions are
// not valid for intervals (they pivot on comparisons and stop on tolerances); the verified ones are in the
// other headers of this folder.
#pragma once

#include <Eigen/Core>

#include "analysis/rigor/eigen_scalar.hpp"
#include "analysis/rigor/interval.hpp"

namespace Eigen {

template <>
struct NumTraits<veritrack::rigor::Interval>
    : veritrack::rigor::EigenScalar<veritrack::rigor::Interval, 2, 4, 12> {};

}  // namespace Eigen

namespace veritrack::rigor {

template <int Rows, int Columns = Rows>
using Matrix = Eigen::Matrix<double, Rows, Columns>;
template <int Rows, int Columns = Rows>
using IntervalMatrix = Eigen::Matrix<Interval, Rows, Columns>;
template <int Size>
using Vector = Eigen::Matrix<double, Size, 1>;
template <int Size>
using IntervalVector = Eigen::Matrix<Interval, Size, 1>;
using DynamicMatrix = Matrix<Eigen::Dynamic>;
using DynamicIntervalMatrix = IntervalMatrix<Eigen::Dynamic>;

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

/// Entry by entry, see radius(Interval). Together with a midpoint that was computed elsewhere use
/// radius_around: the midpoint of an interval depends on the rounding mode by a unit in the last place.
template <typename Derived>
[[nodiscard]] auto radius(const Eigen::MatrixBase<Derived>& matrix) {
  return matrix.unaryExpr([](const Interval& entry) { return radius(entry); }).eval();
}

/// Entry by entry, see magnitude(Interval).
template <typename Derived>
[[nodiscard]] auto magnitude(const Eigen::MatrixBase<Derived>& matrix) {
  return matrix.unaryExpr([](const Interval& entry) { return magnitude(entry); }).eval();
}

/// Entry by entry, an upper bound on the distance from the double in `center` to the points of the interval;
/// NaN where that is empty.
template <typename DerivedA, typename DerivedB>
[[nodiscard]] auto radius_around(const Eigen::MatrixBase<DerivedA>& matrix,
                                 const Eigen::MatrixBase<DerivedB>& center) {
  return magnitude(matrix - to_interval(center));
}

/// Entry by entry, see hull(Interval, Interval).
template <typename DerivedA, typename DerivedB>
[[nodiscard]] auto hull(const Eigen::MatrixBase<DerivedA>& a, const Eigen::MatrixBase<DerivedB>& b) {
  return a.binaryExpr(b, [](const Interval& x, const Interval& y) { return hull(x, y); }).eval();
}

/// Entry by entry, see intersection(Interval, Interval). The symmetric matrices in a are those in
/// intersection(a, a.transpose()).
template <typename DerivedA, typename DerivedB>
[[nodiscard]] auto intersection(const Eigen::MatrixBase<DerivedA>& a, const Eigen::MatrixBase<DerivedB>& b) {
  return a.binaryExpr(b, [](const Interval& x, const Interval& y) { return intersection(x, y); }).eval();
}

namespace detail {

/// True when both have the same non-empty shape and the predicate is true for each pair of entries.
template <typename DerivedA, typename DerivedB, typename Predicate>
[[nodiscard]] bool all_entries(const Eigen::MatrixBase<DerivedA>& a, const Eigen::MatrixBase<DerivedB>& b,
                               Predicate predicate) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) {
    return false;
  }
  for (Eigen::Index column = 0; column < a.cols(); ++column) {
    for (Eigen::Index row = 0; row < a.rows(); ++row) {
      if (!predicate(a.derived().coeff(row, column), b.derived().coeff(row, column))) {
        return false;
      }
    }
  }
  return a.size() > 0;
}

}  // namespace detail

/// True when every entry of `points`, a matrix of doubles, lies in the same entry of `matrix`.
template <typename DerivedA, typename DerivedB>
[[nodiscard]] bool contains(const Eigen::MatrixBase<DerivedA>& matrix,
                            const Eigen::MatrixBase<DerivedB>& points) {
  return detail::all_entries(matrix, points,
                             [](const Interval& x, double point) { return contains(x, point); });
}

/// True when every entry of `inner` is a non-empty part of the same entry of `outer`.
template <typename DerivedA, typename DerivedB>
[[nodiscard]] bool is_subset(const Eigen::MatrixBase<DerivedA>& inner,
                             const Eigen::MatrixBase<DerivedB>& outer VERITRACK_CALL_SITE) {
  VERITRACK_MUTANT_RETURNS(true)
  return detail::all_entries(inner, outer,
                             [](const Interval& x, const Interval& y) { return is_subset(x, y); });
}

/// True when every entry of `inner` is non-empty and lies in the interior of the same entry of `outer`.
template <typename DerivedA, typename DerivedB>
[[nodiscard]] bool is_interior(const Eigen::MatrixBase<DerivedA>& inner,
                               const Eigen::MatrixBase<DerivedB>& outer VERITRACK_CALL_SITE) {
  VERITRACK_MUTANT_RETURNS(true)
  return detail::all_entries(inner, outer,
                             [](const Interval& x, const Interval& y) { return is_interior(x, y); });
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
