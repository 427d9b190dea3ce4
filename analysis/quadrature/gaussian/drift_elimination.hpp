// Is the matrix of drift_form.hpp positive definite over a cell, less the logarithm of the noise's
// determinant?
#pragma once

#include <array>

#include "analysis/quadrature/gaussian/drift_form.hpp"
#include "analysis/quadrature/gaussian/level_cell.hpp"

namespace veritrack::quadrature {

/// A multiplier mu, and what elimination leaves of l with it, the determinant taken off.
struct MultiplierChoice {
  double multiplier = 0.0;
  double left = 0.0;
};
/// The multiplier away from all limits, as a cell needs it. In floating point: for proposals. `next` has the
/// metric in which the next error is measured.
[[nodiscard]] MultiplierChoice choose_multiplier(const LockSetting<double>& next,
                                                 const LevelImages<double>& images, double left);

/// l of drift_form.hpp without -d, at the two ends of s: in the middle of u, and over the cell. Between the
/// ends it must be no less than what joins them.
struct CellLeft {
  std::array<rigor::Interval, 2> at;
  std::array<CellDerivatives, 2> over;
};

/// True only when, S being the metric of `next`,
///     E exp(|S e+|^2/(2(1 - eta))) <= exp(l/2)
/// everywhere in the cell, for every covariance of level s or less. How far each variable moves the matrix is
/// added to `influence`. Needs the upward mode.
[[nodiscard]] bool certainly_left_over(const LockSettings& next, const CellStep& step, const CellLeft& left,
                                       std::array<double, 3>& influence);

}  // namespace veritrack::quadrature
