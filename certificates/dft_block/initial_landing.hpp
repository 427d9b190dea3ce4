// The landing of the initialisation (4.35)-(4.36) in Gaussian noise: simulated starts, counted. Nothing here
// is proved.
#pragma once

#include <cstdint>
#include <vector>

#include "certificates/document/certificate.hpp"
#include "certificates/sets/counted_share.hpp"

namespace veritrack::certificates {

/// For one signal-to-noise ratio.
struct InitialLanding {
  double snr_db = 0.0;  ///< amplitude^2 / (2 deviation^2) of the samples
  std::int64_t starts = 0;
  CountedShare near;    ///< within half a bin of the tone
  CountedShare in_set;  ///< with errors in the certified set, once turned to the next block
};

/// For the assumed noise and some louder ones: tones of the lowest assumed amplitude, offsets uniform in the
/// band, any phase. Empty unless the noise is Gaussian and a set is proved. Nearest rounding is opened here.
[[nodiscard]] std::vector<InitialLanding> simulate_initial_landing(const Certificate& certificate);

}  // namespace veritrack::certificates
