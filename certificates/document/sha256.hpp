// The SHA-256 of a text, which identifies a file.
#pragma once

#include <string>
#include <string_view>

namespace veritrack::certificates {

/// 64 hexadecimal digits (FIPS 180-4).
[[nodiscard]] std::string sha256(std::string_view text);

}  // namespace veritrack::certificates
