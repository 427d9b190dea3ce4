// The covariances with which a filter may be started, for a statement about it to be true.
#pragma once

#include <optional>

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"

namespace veritrack::sets {

/// All P(0|0) with from M <= P(0|0) <= to M in the Loewner order, in the frame of the estimated phase, for a
/// signal of amplitude 1.
struct StartCovariance {
  rigor::IntervalMatrix<3> matrix;                   ///< M, symmetric positive definite
  rigor::Interval multiples = rigor::Interval(1.0);  ///< [from, to], which contains 1
  bool is_given = false;  ///< the design asks for this M; else it is one of our choice

  /// An enclosure of all of them, entry by entry: |P_ij - from M_ij| <= (to - from) sqrt(M_ii M_jj). Needs
  /// the upward mode.
  [[nodiscard]] rigor::IntervalMatrix<3> enclosure() const;
};

/// True only when every one of them is certainly strictly between the two in the Loewner order. Needs the
/// upward mode.
[[nodiscard]] bool certainly_between(const StartCovariance& start, const rigor::Matrix<3>& lower,
                                     const rigor::Matrix<3>& upper);

/// Multiples around those of `start` for which that is true as well, as far out as can be shown; nothing when
/// it is not certain of `start` itself. Needs the upward mode.
[[nodiscard]] std::optional<rigor::Interval> multiples_between(const StartCovariance& start,
                                                               const rigor::Matrix<3>& lower,
                                                               const rigor::Matrix<3>& upper);

}  // namespace veritrack::sets
