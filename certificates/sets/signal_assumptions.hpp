// [assume] of the extended Kalman filters in doubles, for a comparison with a recording.
#pragma once

#include "certificates/document/tracker_run.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

/// Needs round-to-nearest.
[[nodiscard]] SignalAssumptions signal_assumptions(const Assumptions& assume);

}  // namespace veritrack::certificates
