// How far out in a lock set the assumed starts lie.
#pragma once

#include "analysis/quadrature/gaussian/lock_set.hpp"
#include "analysis/sets/start_covariance.hpp"

namespace veritrack::quadrature {

/// Starts of a signal of amplitude 1: bounds on absolute values, and the covariances in the frame of the
/// estimated phase.
struct LockStarts {
  rigor::Interval amplitude_error, phase_error, frequency_error;  ///< relative; rad; rad/sample
  sets::StartCovariance covariance;
};

/// An upper bound on the level of all these starts, in the frame of the true phase; empty when one may lie
/// outside the set. Needs the upward mode.
[[nodiscard]] rigor::Interval start_level(const LockSet& set, const LockStarts& starts);

}  // namespace veritrack::quadrature
