// The proofs by contraction for the quadrature tracker.
#pragma once

#include <string>

#include "analysis/sets/contraction_question.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/sets/assumptions.hpp"
#include "certificates/sets/contraction.hpp"

namespace veritrack::certificates {

/// The values of [design] at amplitude 1: as intervals that contain the decimals (needs the upward mode), and
/// as the doubles nearest to them (needs round-to-nearest).
[[nodiscard]] trackers::ToneModel<rigor::Interval> enclosed_at_unit_amplitude(
    const QuadratureEkfTables& tables);
[[nodiscard]] trackers::ToneModel<double> nearest_at_unit_amplitude(const QuadratureEkfTables& tables);

/// The question for contraction about the quadrature tracker, at amplitude 1. Needs the upward mode.
[[nodiscard]] sets::ContractionQuestion contraction_question(const Design& design);

/// The P(0|0) for which the sentences are true: "and with P(0|0) from ...". Call after add_contraction.
[[nodiscard]] std::string start_covariance_words(const Certificate& certificate);

/// Adds the derivation "contraction" and its certified sets.
void add_contraction(Certificate& certificate);

}  // namespace veritrack::certificates
