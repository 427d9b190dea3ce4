// The input of the results other than Theorem 2.9: a design of the quadrature tracker and the assumptions on
// signal and start, for a signal of amplitude 1.
#pragma once

#include <optional>

#include "analysis/rigor/matrix.hpp"
#include "analysis/theorems/theorem_2_9_constants.hpp"

namespace veritrack::theorems {

struct TrackerInput {
  /// The design, the noise bounds and the largest initial error, as for Theorem 2.9.
  Theorem29Input theorem_2_9;
  /// P(0|0) in the frame of the estimated phase; none: the steady state of the filter.
  std::optional<rigor::IntervalMatrix<3>> initial_covariance;
  /// Where P(0|0) is any from initial_covariance up to this one.
  std::optional<rigor::IntervalMatrix<3>> largest_initial_covariance = std::nullopt;
  /// P(0|0) is any of a range of multiples, and initial_covariance is none: nothing is shown of these.
  bool starts_from_multiples = false;
};

/// The members of theorem_2_9 as there; nothing is known of those that are not finite.
[[nodiscard]] inline TrackerInput with_finite_members(const TrackerInput& input) {
  return {with_finite_members(input.theorem_2_9), input.initial_covariance, input.largest_initial_covariance,
          input.starts_from_multiples};
}

/// min(q1, q2) and max(q1, q2): Q lies between these multiples of the identity. q1_equals_q2 is honoured.
[[nodiscard]] inline rigor::Interval smallest_process_noise(const Theorem29Input& input) {
  return input.q1_equals_q2 ? input.q2 : min(input.q1, input.q2);
}
[[nodiscard]] inline rigor::Interval largest_process_noise(const Theorem29Input& input) {
  return input.q1_equals_q2 ? input.q2 : max(input.q1, input.q2);
}

}  // namespace veritrack::theorems
