#include "analysis/theorems/covariance_range.hpp"

#include "analysis/theorems/riccati_bounds.hpp"
#include "analysis/theorems/signal_model.hpp"

namespace veritrack::theorems {

using rigor::Interval;

Interval attained_covariance(const Theorem29Input& input, const Interval& m) {
  const Interval mu = m / (Interval(1.0) - input.epsilon);
  const Interval two(2.0);
  const Interval corner = input.r / mu;
  const Interval frequency = (two * input.r + input.q1) / square(mu) + input.q2;
  return (input.r + frequency) / two + sqrt(square((frequency - input.r) / two) + square(corner));
}

Interval largest_covariance(const Theorem29Input& input, const Interval& m) {
  if (!is_finite(m)) {
    return Interval::empty();
  }
  const Interval amplitude = input.r / Interval(2.0) + input.q1 / Interval(4.0);
  return max(attained_covariance(input, Interval(m.lower())), amplitude);
}

Interval largest_information(const Theorem29Input& input) {
  const Interval one(1.0);
  return max(one / input.q1 + one / input.r, one / input.q2);
}

CovarianceRange covariance_range(const TrackerInput& input, const Interval& radius) {
  const Theorem29Input& design = input.theorem_2_9;
  const Interval one(1.0);
  CovarianceRange range{one / largest_information(design), largest_covariance(design, one - radius)};
  if (input.initial_covariance) {
    const SmallMatrix start = *input.initial_covariance;
    const SmallMatrix largest = input.largest_initial_covariance.value_or(*input.initial_covariance);
    const Interval largest_start = largest_eigenvalue(largest);
    const Interval first = square(first_derivative_norm(one + radius, design.epsilon)) * largest_start +
                           largest_process_noise(design);
    range.smallest = min(range.smallest, smallest_eigenvalue(start));
    range.largest = max(range.largest, max(largest_start, first));
  }
  return range;
}

}  // namespace veritrack::theorems
