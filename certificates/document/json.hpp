// certificate.json: the certificate for machines. The schema is certificate.schema.json beside this file.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// The whole file, ending in a newline: every endpoint as a hexadecimal float, and as an outward-rounded
/// decimal for the reader. Same certificate, same bytes.
[[nodiscard]] std::string to_json(const Certificate& certificate);

}  // namespace veritrack::certificates
