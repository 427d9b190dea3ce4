// The single-channel tracker in certificate.json.
#pragma once

#include "certificates/document/certificate.hpp"
#include "certificates/document/number_json.hpp"

namespace veritrack::certificates {

/// The tables of the design, one member for each.
[[nodiscard]] Json single_channel_design_json(const Design& read);

/// The certificate of the same filter as a recursion, where something is proved about it.
[[nodiscard]] Json single_channel_evidence_json(const Certificate& certificate);

/// The settings of the simulated run.
[[nodiscard]] Json single_channel_report_json(const Certificate& certificate);

}  // namespace veritrack::certificates
