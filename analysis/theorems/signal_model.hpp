// The quadrature signal model f(x) = (e^{i x3} z, (1 - epsilon) x3), z = x1 + i x2 (thesis, (3.1)): exact
// norms of its derivatives and eigenvalues of its observability Gramian. By rotation they depend on x only
// through m = |z|.
//
// Norms are induced by the Euclidean norm (thesis, definitions 2.5 and 2.6). All functions are exact formulas
// evaluated in intervals and need the upward rounding mode; empty operands give empty results.
#pragma once

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"

namespace veritrack::theorems {

/// |z| of a state.
[[nodiscard]] rigor::Interval signal_magnitude(const rigor::IntervalVector<3>& state);

/// The Euclidean norm of a vector.
template <int Size>
[[nodiscard]] rigor::Interval euclidean_norm(const rigor::IntervalVector<Size>& vector) {
  rigor::Interval sum(0.0);
  for (int i = 0; i < Size; ++i) {
    sum += square(vector(i));
  }
  return sqrt(sum);
}

/// f(x).
[[nodiscard]] rigor::IntervalVector<3> transition(const rigor::IntervalVector<3>& state,
                                                  const rigor::Interval& epsilon);

/// ||df/dx|| for 0 <= epsilon <= 1.
[[nodiscard]] rigor::Interval first_derivative_norm(const rigor::Interval& m, const rigor::Interval& epsilon);
/// ||d^2 f/dx^2||.
[[nodiscard]] rigor::Interval second_derivative_norm(const rigor::Interval& m);
/// ||d^3 f/dx^3||.
[[nodiscard]] rigor::Interval third_derivative_norm(const rigor::Interval& m);

/// ||df/dx(x) - df/dx(y)||, without cancellation when x and y are close.
[[nodiscard]] rigor::Interval first_derivative_distance(const rigor::IntervalVector<3>& x,
                                                        const rigor::IntervalVector<3>& y);

/// The smallest and the largest eigenvalue of the observability Gramian O(k, 1) of (2.22).
struct GramianEigenvalues {
  rigor::Interval smallest, largest;
};
/// m = |z| of the state at which F(k-1) is evaluated. Empty when epsilon may be 1.
[[nodiscard]] GramianEigenvalues observability_eigenvalues(const rigor::Interval& m, const rigor::Interval& r,
                                                           const rigor::Interval& epsilon);

}  // namespace veritrack::theorems
