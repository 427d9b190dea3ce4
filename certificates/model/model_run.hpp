// A tracker that a user has written, run on samples.
#pragma once

#include "certificates/design/design.hpp"
#include "certificates/document/tracker_run.hpp"

namespace veritrack::certificates {

[[nodiscard]] TrackerOnSamples model_on_samples(const Design& design);

}  // namespace veritrack::certificates
