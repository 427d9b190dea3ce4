// Matrices of three rows in intervals, and the information in the bins of a block over a cell of errors:
// shared by the sets for bounded and for Gaussian noise.
#pragma once

#include <optional>

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"

namespace veritrack::dft_block {

/// The inverse of every symmetric matrix in `a`; empty when one may be singular. Needs the upward mode, as do
/// all of these.
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

/// For the errors z = (first, turn, error) of a prediction, and a tone of that offset.
struct BlockInformation {
  rigor::IntervalMatrix<3> jacobian;  ///< H'R^-1 H at the estimate
  rigor::IntervalMatrix<3> factor;    ///< N with N N' = H'R^-1 H
  rigor::IntervalMatrix<3> secant;    ///< of h between tone and estimate: H'R^-1 (h(tone) - h) = -secant z
  rigor::IntervalMatrix<3> more;      ///< the excess of that over `jacobian`
};

/// `weight` is amplitude^2 / (4 r).
[[nodiscard]] BlockInformation information_over(const rigor::Interval& first, const rigor::Interval& turn,
                                                const rigor::Interval& error, const rigor::Interval& offset,
                                                const rigor::Interval& weight, int half_width);

}  // namespace veritrack::dft_block
