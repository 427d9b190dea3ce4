// certificate.json: what is proved or refuted, with the evidence from which it can be verified, and nothing
// else.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"
#include "certificates/document/number_json.hpp"

namespace veritrack::certificates {

/// The format that certificate.schema.json and docs/certificate-format.md describe. Every member is read by
/// the checker, which composes all sentences itself; sampled, undecided and explanatory data are in
/// report.json.
[[nodiscard]] std::string to_json(const Certificate& certificate);

/// The certificate of a design inside another one's file, as a member of that one's certificate: without a
/// format, a name and a hash of its own.
[[nodiscard]] Json inner_certificate_json(const Certificate& certificate);

}  // namespace veritrack::certificates
