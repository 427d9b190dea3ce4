// report.json: everything that is reported about a design, verified or not.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// Every quantity with symbol, formula, source and decimals, every condition and claim with its words and
/// ground, sampled and undecided ones too, and what simulations showed (report.schema.json). The checker
/// never reads it.
[[nodiscard]] std::string to_report_json(const Certificate& certificate);

}  // namespace veritrack::certificates
