#include "analysis/quadrature/contraction/certified_level.hpp"

#include <algorithm>
#include <limits>

namespace veritrack::quadrature {

using rigor::Interval;

CertifiedLevel::CertifiedLevel(const CertifiedSet& set, const Interval& level, const Interval& noise,
                               const Interval& slew)
    : set_(set), level_(level), ultimate_(ultimate_level(set, noise, slew)) {}

double CertifiedLevel::largest_frequency_error() const {
  return frequency_error_at(max(level_, Interval(ultimate_.upper())));
}

double CertifiedLevel::frequency_error_at(const Interval& level) const {
  const Interval bound = error_bounds(set_, level)[2];
  return is_finite(bound) ? bound.upper() : std::numeric_limits<double>::infinity();
}

void CertifiedLevel::step() {
  // The square is at most kappa^2 level^2 + (1 - kappa^2) u^2, u from above.
  const Interval above = rigor::square(Interval(ultimate_.upper()));
  const Interval next = above + rigor::square(Interval(set_.rate)) * (rigor::square(level_) - above);
  level_ = Interval(rigor::sqrt(next).upper());
}

}  // namespace veritrack::quadrature
