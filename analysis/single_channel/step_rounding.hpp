// How far one step of the single-channel tracker in double precision can be from the same step in real
// arithmetic (docs/rounding.md, "The single-channel tracker").
//
// Both start from the program's numbers: an estimate, the matrix represented by its covariance factors, and a
// measurement. The bounds are for every orientation of the plane.
#pragma once

#include <limits>

#include "analysis/sets/state_difference.hpp"

namespace veritrack::single_channel {

/// Filtered states, relative to the true amplitude: every orientation of the plane, and every covariance P =
/// [[M + d u u', d u], [d u', d]], with
struct HeldStates {
  rigor::Interval z;            ///< |z|, from above
  rigor::Interval eigenvalues;  ///< of M; its lower end is not below zero
  rigor::Interval u;            ///< |u|, from above
  rigor::Interval d;            ///< positive
};

/// |program's step - exact step| for every such state and every measurement; infinite when it cannot be
/// bounded. Runs trackers/single_channel/single_channel_ekf.hpp, as it stands, on rigor::Rounded. Needs the
/// upward mode.
[[nodiscard]] sets::StateDifference step_difference(const sets::Program& program, const HeldStates& states);

/// The program's step is the exact step, followed by a change of e by at most `error` in the metric P^-1 and
/// one of P by at most `covariance` P, up or down in the Loewner order: P is the exact step's covariance, the
/// metric that of the program's. Upper bounds; infinite when unknown.
struct StepRounding {
  double error = 0.0;
  double covariance = 0.0;

  /// The largest share of P for which anything is said.
  static constexpr double kMostCovariance = 0x1p-8;
  /// True only when both are nonnegative numbers, and the share of P is at most this.
  [[nodiscard]] bool is_bounded() const {
    return error >= 0.0 && error <= 1.0 && covariance >= 0.0 && covariance <= kMostCovariance;
  }
};

inline constexpr StepRounding kUnboundedRounding{std::numeric_limits<double>::infinity(),
                                                 std::numeric_limits<double>::infinity()};

/// diag(floor, floor, q2) is below the covariance after an exact step from any covariance: a measurement
/// leaves at least this of Q. `floor` is q1 r / (q1 + r).
[[nodiscard]] rigor::Interval filtered_floor(const trackers::ToneModel<rigor::Interval>& design);

/// The difference in terms of the covariances, which are all above diag(floor, floor, q2). Needs the upward
/// mode.
[[nodiscard]] StepRounding in_metric(const trackers::ToneModel<rigor::Interval>& design,
                                     const sets::StateDifference& difference);

}  // namespace veritrack::single_channel
