// The largest response of a weighted sum of first-order filters to a bounded input.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "analysis/rigor/interval.hpp"

namespace veritrack::kkl_observer {

/// Upper bounds on sup |sum_i c_i e_i| over all inputs |d| <= 1 of the filters e_i' = -lambda_i e_i + d,
/// which were at rest long ago: the integral of |k|, k(t) = sum_i c_i exp(-lambda_i t), t > 0.
///
/// The time axis is cut into cells. Where k certainly has one sign on a cell the integral of |k| is |sum_i
/// c_i (integral of exp(-lambda_i t))|; elsewhere it is at most the cell's width times the largest |k| there,
/// by the mean-value form; behind the last cell the terms are bounded one by one. For four to eight filters.
template <int M = 4>
class KernelNorm {
 public:
  static constexpr std::size_t kFilters = M;
  using Coefficients = std::array<rigor::Interval, kFilters>;

  /// `lambda`: filter rates, certainly positive. `cells`: their number; more are tighter. Needs the upward
  /// mode.
  KernelNorm(const Coefficients& lambda, std::size_t cells);

  /// For every choice of coefficients in the intervals. Not finite when there is no bound. Needs the upward
  /// mode.
  [[nodiscard]] rigor::Interval upper_bound(const Coefficients& coefficients) const;

 private:
  struct Cell {
    rigor::Interval half_width;  ///< symmetric
    double width;
    Coefficients at_middle;  ///< exp(-lambda_i t) there
    Coefficients slope;      ///< its derivative over the cell
    Coefficients integral;
  };
  std::vector<Cell> cells_;
  Coefficients tail_;  ///< integrals from the end of the last cell on
};

}  // namespace veritrack::kkl_observer
