// The largest response of a weighted sum of first-order filters to sinusoids.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "analysis/rigor/interval.hpp"

namespace veritrack::kkl_observer {

/// Upper bounds on sup |sum_i c_i e_i| over the steady states of the filters e_i' = -lambda_i e_i + sin(W t +
/// p) for all phases p and all W from the lowest frequency up: the largest |sum_i c_i / (lambda_i + jW)|.
///
/// The periods r = 1 / W are cut into cells, from 0 on; on each the real and the imaginary part are enclosed
/// by the mean-value form. For four to eight filters.
template <int M>
class ResponseNorm {
 public:
  static constexpr std::size_t kFilters = M;
  using Coefficients = std::array<rigor::Interval, kFilters>;

  /// `lambda`: filter rates, 1/s, certainly positive. `frequency`: the lowest, rad/s, certainly positive.
  /// Needs the upward mode.
  ResponseNorm(const Coefficients& lambda, const rigor::Interval& frequency);

  /// For every choice of coefficients in the intervals, s. Needs the upward mode.
  [[nodiscard]] rigor::Interval upper_bound(const Coefficients& coefficients) const;

 private:
  /// 1 / (lambda + j / r) = lambda r^2 / (1 + lambda^2 r^2) - j r / (1 + lambda^2 r^2): minus the imaginary
  /// part.
  struct Parts {
    Coefficients real, imaginary;
  };
  struct Cell {
    rigor::Interval half_width;  ///< symmetric
    Parts at_middle, slope;
  };
  std::vector<Cell> cells_;
};

}  // namespace veritrack::kkl_observer
