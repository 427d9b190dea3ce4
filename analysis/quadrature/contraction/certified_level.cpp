#include "analysis/quadrature/contraction/certified_level.hpp"

#include <algorithm>
#include <limits>

namespace veritrack::quadrature {

using rigor::Interval;

CertifiedLevel::CertifiedLevel(const CertifiedSet& set, const Interval& level, const Interval& noise,
                               const Interval& slew)
    : set_(set), level_(level), noise_(noise), slew_(slew), ultimate_(ultimate_level(set, noise, slew)) {}

double CertifiedLevel::largest_frequency_error() const {
  return frequency_error_at(max(level_, Interval(ultimate_.upper())));
}

double CertifiedLevel::frequency_error_at(const Interval& level) const {
  const Interval bound = error_bounds(set_, level)[2];
  return is_finite(bound) ? bound.upper() : std::numeric_limits<double>::infinity();
}

void CertifiedLevel::step() {
  level_ = Interval(next_level(set_, level_, noise_, slew_).upper());
}

}  // namespace veritrack::quadrature
