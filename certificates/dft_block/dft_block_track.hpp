// The block tracker on samples, in double precision.
#pragma once

#include "certificates/design/design.hpp"
#include "certificates/document/tracker_run.hpp"

namespace veritrack::certificates {

/// See TrackerKind. Throws NotTrackable without block_length and centre, or where the bins do not fit.
[[nodiscard]] TrackerOnSamples track_dft_block(const Design& design);

}  // namespace veritrack::certificates
