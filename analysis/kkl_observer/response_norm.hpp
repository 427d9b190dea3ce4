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
/// The periods r = 1 / W are cut into cells, from 0 on. With a and b the sum and its derivative in the middle
/// of a cell, |a + b t| is largest at an end; the second derivatives have a known bound. For four to eight
/// filters.
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
  /// R = 1 / (lambda + j / r) = r / (lambda r + j) has R' = j / (lambda r + j)^2, |R''| = 2 lambda / |lambda
  /// r + j|^3.
  struct Parts {
    Coefficients real, imaginary;
  };
  struct Cell {
    rigor::Interval half_width;
    Parts value, slope;    ///< in the middle
    Coefficients bending;  ///< the largest |R''|, times half of the squared half width
  };
  std::vector<Cell> cells_;
};

}  // namespace veritrack::kkl_observer
