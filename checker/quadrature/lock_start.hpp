// The level at which a tracker may start: the largest over the assumed start errors and covariances.
#pragma once

#include "checker/quadrature/lock_step.hpp"
#include "checker/quadrature/start_covariance.hpp"

namespace veritrack::checker {

/// Start errors: bounds on |amplitude error|, relative to the amplitude, |phase error| in rad and |frequency
/// error| in rad/sample.
struct LockStart {
  Ball amplitude, phase, frequency;
};

/// An upper bound on the level (|T e|^2 + gamma s^2)/2 of all these starts, with every P(0|0) between the two
/// matrices in the frame of the estimated phase. A ball of everything when none is proved.
Ball start_level(const LockSet& set, const LockStart& start, const StartCovariance& covariance);

}  // namespace veritrack::checker
