// The quadrature tracker in certificate.json.
#pragma once

#include "certificates/document/certificate.hpp"
#include "certificates/document/number_json.hpp"

namespace veritrack::certificates {

/// The tables of the design, one member for each.
[[nodiscard]] Json quadrature_design_json(const Design& read);

/// certified_sets, audits and comparison.
[[nodiscard]] Json quadrature_evidence_json(const Certificate& certificate);

/// Audits, the comparison and the settings of the simulated run.
[[nodiscard]] Json quadrature_report_json(const Certificate& certificate);

}  // namespace veritrack::certificates
