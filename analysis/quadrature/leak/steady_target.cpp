#include "analysis/quadrature/leak/steady_target.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/quadrature/capture/capture_polar_image.hpp"
#include "analysis/quadrature/leak/steady_start.hpp"

namespace veritrack::quadrature {

using rigor::Interval;
using rigor::IntervalMatrix;
using rigor::IntervalVector;

std::optional<Settled> SteadySetTarget::settled(const StateEnclosure& states) const {
  const IntervalVector<3> center = steady_.head<3>();
  if (!(metric_of_middle(set_.metric, rigor::midpoint(center), states) < level_)) {
    return std::nullopt;
  }
  const PolarImage image = polar_image(set_.metric, center, states);
  IntervalMatrix<3> steady;
  steady << steady_[3], steady_[4], steady_[5], steady_[4], steady_[6], steady_[7], steady_[5], steady_[7],
      steady_[8];
  const auto level = covariance_level(IntervalMatrix<3>(image.covariance - steady), set_);
  const bool inside = level && *level <= level_ && certainly_less_equal(image.norm, Interval(level_));
  return inside ? std::optional(Settled{0, std::max(image.norm.upper(), *level)}) : std::nullopt;
}

}  // namespace veritrack::quadrature
