// The whole certificate: every part that claims something is verified, or says why not.
#pragma once

#include "checker/document/parts.hpp"

namespace veritrack::checker {

/// The `schema` of the certificates that this checker reads.
constexpr const char* kFormat = "veritrack/certificate/2";

/// Throws Malformed for what is not a certificate of this format. When there are very many boxes of starts,
/// only a sample is followed unless `all_boxes`, and the certificate is then not verified.
Verification verify(const Tree& certificate, bool all_boxes = false);

}  // namespace veritrack::checker
