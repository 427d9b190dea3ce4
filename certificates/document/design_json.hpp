// The parts of certificate.json that repeat the design file.
#pragma once

#include <nlohmann/json.hpp>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// "lo" and "hi" as hexadecimal floats, "decimal" outward rounded for the reader.
[[nodiscard]] nlohmann::ordered_json enclosure_json(const rigor::Interval& value);

/// The design as read, every number with its text, its enclosure and its line.
[[nodiscard]] nlohmann::ordered_json design_json(const Certificate& certificate);

}  // namespace veritrack::certificates
