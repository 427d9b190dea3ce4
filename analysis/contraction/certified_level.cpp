#include "analysis/contraction/certified_level.hpp"

#include <algorithm>
#include <limits>

namespace veritrack::contraction {

using rigor::Interval;

CertifiedLevel::CertifiedLevel(const CertifiedSet& set, const Interval& level, const Interval& noise,
                               const Interval& slew)
    : set_(set),
      level_(level),
      ultimate_((Interval(set.noise_gain) * noise + Interval(set.slew_gain) * slew) /
                (Interval(1.0) - Interval(set.rate))) {}

double CertifiedLevel::largest_frequency_error() const {
  return frequency_error_at(max(level_, Interval(ultimate_.upper())));
}

double CertifiedLevel::frequency_error_at(const Interval& level) const {
  const Interval bound = error_bounds(set_, level)[2];
  return is_finite(bound) ? bound.upper() : std::numeric_limits<double>::infinity();
}

void CertifiedLevel::step() {
  // At most kappa level + (1 - kappa) u, u from above.
  const Interval above(ultimate_.upper());
  level_ = Interval((above + Interval(set_.rate) * (level_ - above)).upper());
}

bool CertifiedLevel::settled() const {
  return can_settle() && certainly_less_equal(level_, Interval(2.0) * Interval(ultimate_.lower()));
}

}  // namespace veritrack::contraction
