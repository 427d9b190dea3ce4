// A model in certificate.json.
#pragma once

#include "analysis/model/set/tube_set.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/document/number_json.hpp"

namespace veritrack::certificates {

/// The tables of the design.
[[nodiscard]] Json model_design_json(const Design& design);

/// A tube with its levels, all numbers as hexadecimal floats.
[[nodiscard]] Json tube_json(const model::ProvedTube& proved);

/// The member "tubes": the sets that cover the band (docs/certificate-format.md).
[[nodiscard]] Json model_evidence_json(const Certificate& certificate);

/// For report.json: "linear_worst_case", the estimate to first order beside the proved bound, where it was
/// made.
[[nodiscard]] Json model_report_json(const Certificate& certificate);

}  // namespace veritrack::certificates
