// What contraction proves of the quadrature tracker.
#pragma once

#include "analysis/sets/contraction_question.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/sets/assumptions.hpp"
#include "certificates/sets/contraction.hpp"

namespace veritrack::certificates {

/// What is asked of contraction for the quadrature tracker, at amplitude 1. Needs the upward mode.
[[nodiscard]] sets::ContractionQuestion contraction_question(const Design& design);

/// Adds the derivation "contraction" and its certified sets.
void add_contraction(Certificate& certificate);

}  // namespace veritrack::certificates
