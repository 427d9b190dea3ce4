// The quadrature tracker run on samples.
#pragma once

#include "certificates/design/design.hpp"
#include "certificates/document/tracker_run.hpp"

namespace veritrack::certificates {

[[nodiscard]] TrackerOnSamples quadrature_on_samples(const Design& design);

}  // namespace veritrack::certificates
