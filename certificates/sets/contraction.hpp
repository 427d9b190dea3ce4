// What is asked of contraction for the assumptions of a design, and what its claims rest on.
#pragma once

#include <optional>

#include "analysis/sets/contraction_question.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

/// What is asked for a model at amplitude 1 under what is assumed. Needs the upward mode.
[[nodiscard]] sets::ContractionQuestion contraction_question(
    const trackers::ToneModel<rigor::Interval>& model, const Assumptions& assume);

/// What decides about the assumed starts: "capture" when they had to be followed, else "contraction"; null
/// when there is neither.
[[nodiscard]] const theorems::Derivation* deciding_derivation(const Certificate& certificate);

/// The proved bound on |frequency error|, rad/sample, at every sample from the start on; none when the
/// contraction certificate does not cover the assumed start, noise and slew.
[[nodiscard]] std::optional<rigor::Interval> proved_frequency_bound(const Certificate& certificate);

}  // namespace veritrack::certificates
