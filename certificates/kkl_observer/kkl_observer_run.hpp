// The KKL observer run on samples.
#pragma once

#include "certificates/design/design.hpp"
#include "certificates/document/tracker_run.hpp"

namespace veritrack::certificates {

/// Throws NotTrackable for a design without a sampling interval, or without an ell that is proved or given.
[[nodiscard]] TrackerOnSamples kkl_observer_on_samples(const Design& design);

}  // namespace veritrack::certificates
