// Test matrices whose properties are known exactly, because all their entries are small integers.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>

#include "analysis/rigor/matrix.hpp"
#include "tests/support/random.hpp"

namespace veritrack::test {

/// Uniform integers in [-bound, bound].
inline Eigen::MatrixXd random_integers(Random& random, Eigen::Index rows, Eigen::Index columns, int bound) {
  Eigen::MatrixXd result(rows, columns);
  for (Eigen::Index column = 0; column < columns; ++column) {
    for (Eigen::Index row = 0; row < rows; ++row) {
      result(row, column) =
          static_cast<double>(random.below(2 * static_cast<std::uint64_t>(bound) + 1)) - bound;
    }
  }
  return result;
}

/// An integer matrix with determinant 1 and its inverse, also of integers: a product of unit triangular
/// matrices.
struct Unimodular {
  Eigen::MatrixXd matrix;
  Eigen::MatrixXd inverse;
};
inline Unimodular random_unimodular(Random& random, Eigen::Index size, int operations) {
  Unimodular result{Eigen::MatrixXd::Identity(size, size), Eigen::MatrixXd::Identity(size, size)};
  for (int i = 0; i < operations && size > 1; ++i) {
    const auto from = static_cast<Eigen::Index>(random.below(static_cast<std::uint64_t>(size)));
    const auto step = static_cast<Eigen::Index>(random.below(static_cast<std::uint64_t>(size - 1)));
    const Eigen::Index to = (from + 1 + step) % size;
    const double sign = random.below(2) == 0 ? 1.0 : -1.0;
    result.matrix.row(to) += sign * result.matrix.row(from).eval();
    result.inverse.col(from) -= sign * result.inverse.col(to).eval();
  }
  return result;
}

/// Sylvester's Hadamard matrix, entries +-1, H H' = size I; `size` is a power of two.
inline Eigen::MatrixXd hadamard(Eigen::Index size) {
  Eigen::MatrixXd result(size, size);
  for (Eigen::Index row = 0; row < size; ++row) {
    for (Eigen::Index column = 0; column < size; ++column) {
      result(row, column) =
          __builtin_parityll(static_cast<unsigned long long>(row & column)) != 0 ? -1.0 : 1.0;
    }
  }
  return result;
}

/// Intervals around the entries, each end up to `reach` away: not centred, so that `matrix` is not the
/// midpoint.
inline rigor::DynamicIntervalMatrix box_around(Random& random, const Eigen::MatrixXd& matrix, double reach) {
  return matrix.unaryExpr([&](double entry) {
    return rigor::Interval::from_bounds(entry - reach * random.uniform(), entry + reach * random.uniform());
  });
}

/// The same, with mirrored entries identical.
inline rigor::DynamicIntervalMatrix symmetric_box_around(Random& random, const Eigen::MatrixXd& matrix,
                                                         double reach) {
  rigor::DynamicIntervalMatrix box = box_around(random, matrix, reach);
  for (Eigen::Index row = 0; row < box.rows(); ++row) {
    for (Eigen::Index column = 0; column < row; ++column) {
      box(column, row) = box(row, column);
    }
  }
  return box;
}

/// A vertex of the box (each entry one of its ends), mirrored when `symmetric`.
inline Eigen::MatrixXd random_vertex(Random& random, const rigor::DynamicIntervalMatrix& box,
                                     bool symmetric) {
  Eigen::MatrixXd vertex = box.unaryExpr(
      [&](const rigor::Interval& entry) { return random.below(2) == 0 ? entry.lower() : entry.upper(); });
  for (Eigen::Index row = 0; symmetric && row < box.rows(); ++row) {
    for (Eigen::Index column = 0; column < row; ++column) {
      vertex(column, row) = vertex(row, column);
    }
  }
  return vertex;
}

/// The three kinds of entry that no proof may use.
inline const rigor::Interval kPoison[] = {
    rigor::Interval::empty(), rigor::Interval::entire(),
    rigor::Interval::from_bounds(1.0, std::numeric_limits<double>::infinity())};

}  // namespace veritrack::test
