// certificate.json: what is proved or refuted, with the evidence from which it can be verified, and nothing
// else.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// The format that certificate.schema.json and docs/certificate-format.md describe. Every member is read by
/// the checker, which composes all sentences itself; what is sampled, undecided or for people stands in
/// report.json.
[[nodiscard]] std::string to_json(const Certificate& certificate);

}  // namespace veritrack::certificates
