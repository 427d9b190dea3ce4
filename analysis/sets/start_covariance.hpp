// The covariances with which a filter may be started, for a statement about it to be true.
#pragma once

#include <optional>
#include <string>

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"

namespace veritrack::sets {

/// All P(0|0) with from M <= P(0|0) <= to N in the Loewner order, in the frame of the estimated phase, for a
/// signal of amplitude 1; N = M unless the design gives two matrices.
struct StartCovariance {
  rigor::IntervalMatrix<3> matrix;                   ///< M, symmetric positive definite
  rigor::Interval multiples = rigor::Interval(1.0);  ///< [from, to]
  bool is_given = false;  ///< the design asks for exactly these; else M and its multiples are our choice
  std::optional<rigor::IntervalMatrix<3>> highest = std::nullopt;  ///< N, above M; none: M
  std::string range = {};  ///< a noun for sentences, where the design asks for more than one P(0|0)

  /// The ends from M and to N. Need the upward mode.
  [[nodiscard]] rigor::IntervalMatrix<3> lower_end() const;
  [[nodiscard]] rigor::IntervalMatrix<3> upper_end() const;

  /// An enclosure of all of them, entry by entry: with D = to N - from M, |P_ij - from M_ij| <= sqrt(D_ii
  /// D_jj). Needs the upward mode.
  [[nodiscard]] rigor::IntervalMatrix<3> enclosure() const;
};

/// True only when every one of them is certainly strictly between the two in the Loewner order. Needs the
/// upward mode.
[[nodiscard]] bool certainly_between(const StartCovariance& start, const rigor::Matrix<3>& lower,
                                     const rigor::Matrix<3>& upper);

/// Multiples around those of `start` for which that is true as well, as far out as can be shown, or those of
/// `start` when they are given; nothing when it is not certain of `start` itself. Needs the upward mode.
[[nodiscard]] std::optional<rigor::Interval> multiples_between(const StartCovariance& start,
                                                               const rigor::Matrix<3>& lower,
                                                               const rigor::Matrix<3>& upper);

}  // namespace veritrack::sets
