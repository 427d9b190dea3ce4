// Enclosures of followed states in the polar frame, as targets want to see them.
#pragma once

#include "analysis/quadrature/capture/capture_enclosure.hpp"

namespace veritrack::quadrature {

/// Bounds common to all states of an enclosure; not finite when they could not be found.
struct PolarImage {
  rigor::Interval norm;                 ///< |T (e - origin)|
  rigor::IntervalMatrix<3> covariance;  ///< in the frame of the estimated phase
};

/// e = (amplitude, phase, frequency errors), the phase error in (-pi, pi); `metric` is T. By the mean value
/// theorem. Needs the upward mode.
[[nodiscard]] PolarImage polar_image(const rigor::Matrix<3>& metric, const rigor::IntervalVector<3>& origin,
                                     const StateEnclosure& states);

/// |T (e - origin)| at the middle, in floating point: to spare the work above as long as it would be in vain.
[[nodiscard]] double metric_of_middle(const rigor::Matrix<3>& metric, const rigor::Vector<3>& origin,
                                      const StateEnclosure& states);

}  // namespace veritrack::quadrature
