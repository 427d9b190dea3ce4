// The linear loop about its phase detector: noise bandwidth and gain margin (docs/gain-proof.md, section 7).
#pragma once

#include <optional>
#include <vector>

#include "checker/model/gain/characteristic_polynomial.hpp"
#include "checker/model/gain/gain_network.hpp"

namespace veritrack::checker {

/// x+ = A x + b p, where the detector compares the phase p of the samples with c x.
struct DetectorLoop {
  BallRows matrix;             ///< A, the loop closed
  std::vector<Ball> effect;    ///< b
  std::vector<Ball> compared;  ///< c
};

/// Nothing where no angle, or more than one, depends on the phase of the samples, or states keep samples.
std::optional<DetectorLoop> detector_loop(const GainNetwork& network);

/// pi times the sum of squares of c A^k b, rad/sample; everything where that is not known.
Ball noise_bandwidth(const DetectorLoop& loop);

/// All eigenvalues of A - (f - 1) b c are inside the unit circle for every f from 1 to `factor`.
bool is_stable_up_to(const DetectorLoop& loop, const Ball& factor);
/// One of them is outside for f = 1 or for f = `factor`.
bool is_unstable_up_to(const DetectorLoop& loop, const Ball& factor);

}  // namespace veritrack::checker
