// What contraction proves for a design's assumed start, noise and slew, and the claims that rest on it.
#pragma once

#include "analysis/quadrature/contraction/quadrature_certificate.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

/// What is asked of contraction for the quadrature tracker, at amplitude 1. Needs the upward mode.
[[nodiscard]] sets::ContractionQuestion contraction_question(const Design& design);

/// The same for design values at amplitude 1 and what is assumed.
[[nodiscard]] sets::ContractionQuestion contraction_question(
    const trackers::QuadratureEkfDesign<rigor::Interval>& design, const Assumptions& assume);

/// Adds the derivation "contraction" and its certified sets.
void add_contraction(Certificate& certificate);

/// What decides about the assumed starts: "capture" when they had to be followed, else "contraction"; null
/// when there is neither.
[[nodiscard]] const theorems::Derivation* deciding_derivation(const Certificate& certificate);

/// The proved bound on |frequency error|, rad/sample, at every sample from the start on; none when the
/// contraction certificate does not cover the assumed start, noise and slew.
[[nodiscard]] std::optional<rigor::Interval> proved_frequency_bound(const Certificate& certificate);

}  // namespace veritrack::certificates
