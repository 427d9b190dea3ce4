#include "analysis/single_channel/covariance_window.hpp"

#include <cstdlib>

namespace veritrack::single_channel {

using rigor::Interval;

namespace detail {

double phase_drift(int samples, double slew) {
  const int n = std::abs(samples);
  return (Interval(slew) * Interval(0.5 * n * (n + 1))).upper();
}

}  // namespace detail

}  // namespace veritrack::single_channel
