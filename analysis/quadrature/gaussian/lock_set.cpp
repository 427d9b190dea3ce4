#include "analysis/quadrature/gaussian/lock_set.hpp"

#include "analysis/rigor/elementary.hpp"

namespace veritrack::quadrature {

rigor::Interval largest_frequency_error(const LockSet& set) {
  return rigor::sqrt(rigor::Interval(2.0) * rigor::Interval(set.level)) /
         rigor::Interval(set.metric.frequency);
}

}  // namespace veritrack::quadrature
