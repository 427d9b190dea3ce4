// Matrices of three rows in intervals, and what the bins of a block say over a cell of errors: shared by the
// sets of bounded and of Gaussian noise.
#pragma once

#include <optional>

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"

namespace veritrack::dft_block {

/// The inverse of every symmetric matrix in `a`; none when one may be singular. Needs the upward mode, as all
/// of these.
[[nodiscard]] std::optional<rigor::IntervalMatrix<3>> inverse_of(const rigor::IntervalMatrix<3>& a);

[[nodiscard]] rigor::IntervalMatrix<3> scaled_identity(const rigor::Interval& scale);

/// True only when the symmetric matrices in `a` are all positive definite; those [a, b'; b, c]; those
/// [a, b', d'; b, c, e'; d, e, f].
[[nodiscard]] bool is_definite(const rigor::IntervalMatrix<3>& a);
[[nodiscard]] bool is_definite(const rigor::IntervalMatrix<3>& a, const rigor::IntervalMatrix<3>& b,
                               const rigor::IntervalMatrix<3>& c);
[[nodiscard]] bool is_definite(const rigor::IntervalMatrix<3>& a, const rigor::IntervalMatrix<3>& b,
                               const rigor::IntervalMatrix<3>& c, const rigor::IntervalMatrix<3>& d,
                               const rigor::IntervalMatrix<3>& e, const rigor::IntervalMatrix<3>& f);

/// Of the errors z = (first, turn, error) of a prediction, and a tone of that offset.
struct BlockInformation {
  rigor::IntervalMatrix<3> jacobian;  ///< H'R^-1 H at the estimate
  rigor::IntervalMatrix<3> factor;    ///< N with N N' = H'R^-1 H
  rigor::IntervalMatrix<3> secant;    ///< of h between tone and estimate: H'R^-1 (h(tone) - h) = -secant z
  rigor::IntervalMatrix<3> more;      ///< by how much that is more than the first
};

/// `weight` is amplitude^2 / (4 r).
[[nodiscard]] BlockInformation information_over(const rigor::Interval& first, const rigor::Interval& turn,
                                                const rigor::Interval& error, const rigor::Interval& offset,
                                                const rigor::Interval& weight, int half_width);

}  // namespace veritrack::dft_block
