#include "analysis/quadrature/true_phase/steady_bounds.hpp"

#include <Eigen/Core>

#include "analysis/quadrature/true_phase/ellipsoid_search.hpp"
#include "analysis/rigor/symmetric_eigensystem.hpp"

namespace veritrack::quadrature {

std::optional<SteadyBounds> steady_bounds(const trackers::ToneModel<double>& design,
                                          const Eigen::Matrix3d& lowest, const Eigen::Matrix3d& highest) {
  constexpr double kTheta = 0.999998;  // a little more than theta_Q of steady.v asks
  constexpr int kMostHalvings = 60;
  const ErrorBox no_error{{rigor::Interval(0.0), rigor::Interval(0.0), rigor::Interval(0.0)}};
  SteadyBounds bounds;
  bounds.gain_above = stored(gain_at(design, highest, 0.0, 0.0));
  bounds.gain_beneath = stored(gain_at(design, lowest, 0.0, 0.0));
  ErrorEllipsoid set;
  set.lowest = lowest;
  set.highest = highest;
  CellNumbers cell;
  cell.highest = kTheta * highest;
  cell.lowest = lowest / kTheta;
  cell.gain = bounds.gain_above;
  if (!upper_form_is_positive(design, set, cell, no_error)) {
    return std::nullopt;
  }
  cell.gain = bounds.gain_beneath;
  if (!lower_form_is_positive(design, set, cell, no_error)) {
    return std::nullopt;
  }
  bounds.least_size = stored(0.5 * rigor::least_eigenvalue(highest));
  if (!(bounds.least_size > 0.0)) {
    return std::nullopt;
  }
  set.lowest.setZero();
  bounds.least_share = 1.0;
  for (int k = 0; k < kMostHalvings; ++k) {
    bounds.least_share *= 0.5;
    cell.lowest = 2.0 * bounds.least_share * lowest;
    if (lower_form_is_positive(design, set, cell, no_error)) {
      return bounds;
    }
  }
  return std::nullopt;
}

}  // namespace veritrack::quadrature
