// The frequency error of the single-channel tracker to first order: an estimate in floating point, with which
// a proved bound is compared.
#pragma once

#include "trackers/tone_model.hpp"

namespace veritrack::single_channel {

/// The largest frequency error in the long run, rad/sample, without a leak, on a tone of amplitude 1 under
/// |noise| and |slew|, rad/sample per sample, of at most these: the sum of what each earlier sample of noise
/// and each step of the frequency adds to the estimate, by the derivatives of single_channel_map along the
/// steady state, at the worst of 48 phases. Nonlinear terms are left out: not a bound. `frequency` in
/// rad/sample; the design at unit amplitude. Holds round-to-nearest.
[[nodiscard]] double first_order_error(const trackers::ToneModel<double>& design, double frequency,
                                       double noise, double slew);

}  // namespace veritrack::single_channel
