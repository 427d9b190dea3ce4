// Capture of the assumed starts, when they exceed the certified set.
#pragma once

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// When a set is certified and the assumed starts are not in it: adds the derivation "capture", the starts
/// that were followed, and the claim "ekf/capture". When that stays UNDECIDED under the assumed noise and
/// slew, also the derivation "capture/noise-free" and the claim "ekf/capture-noise-free"; and when that is
/// PROVED, for the largest share of noise and slew that was found to work, the derivation
/// "capture/reduced-noise" and the claim "ekf/capture-at-reduced-noise". Call after add_contraction and
/// before add_required_claims. Needs the upward mode.
void add_capture(Certificate& certificate, const CertifyProgress& progress);

}  // namespace veritrack::certificates
