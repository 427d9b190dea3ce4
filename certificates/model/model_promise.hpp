// The bounds that the certificate of a model proves on its frequency error, for a system that runs on the
// estimate.
#pragma once

#include "certificates/document/certificate.hpp"
#include "certificates/sets/frequency_promise.hpp"

namespace veritrack::certificates {

/// The claim "model/guarantee", where it is about the whole band, in rad/sample, and about tones as they are.
/// Needs the upward mode.
[[nodiscard]] FrequencyPromise model_frequency_promise(const Certificate& certificate);

}  // namespace veritrack::certificates
