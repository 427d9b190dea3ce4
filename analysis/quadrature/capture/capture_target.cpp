#include "analysis/quadrature/capture/capture_target.hpp"

#include <cmath>

#include "analysis/quadrature/capture/capture_polar_image.hpp"
#include "analysis/quadrature/rounding/set_rounding.hpp"
#include "analysis/rigor/definiteness.hpp"
#include "analysis/rigor/elementary.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"

namespace veritrack::quadrature {

using rigor::Interval;
using rigor::IntervalMatrix;

std::optional<Settled> CertifiedSetTarget::settled(const StateEnclosure& states) const {
  const double middle = states.center[trackers::kFrequencyError];
  const double turns = periodic_ ? std::round(middle / 6.283185307179586) : 0.0;
  const rigor::Vector<3> near(0.0, 0.0, 6.283185307179586 * turns);
  if (!(std::fabs(turns) <= kMostTurns) || !(metric_of_middle(set_.metric, near, states) < set_.radius)) {
    return std::nullopt;
  }
  rigor::IntervalVector<3> origin;
  origin << Interval(0.0), Interval(0.0), Interval(2.0 * turns) * rigor::pi();
  const auto [norm, covariance] = polar_image(set_.metric, origin, states);
  const IntervalMatrix<3> above = covariance - rigor::to_interval(set_.covariance_lower);
  const IntervalMatrix<3> below = rigor::to_interval(set_.covariance_upper) - covariance;
  const bool inside = certainly_less_equal(norm, Interval(set_.radius)) &&
                      rigor::is_positive_definite(above) == rigor::Verdict::proved &&
                      rigor::is_positive_definite(below) == rigor::Verdict::proved;
  return inside ? std::optional(Settled{static_cast<int>(turns), norm.upper()}) : std::nullopt;
}

}  // namespace veritrack::quadrature
