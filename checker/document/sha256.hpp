// The SHA-256 of a file, which identifies it.
#pragma once

#include <string>

namespace veritrack::checker {

/// 64 hexadecimal digits (FIPS 180-4).
std::string sha256(const std::string& bytes);

}  // namespace veritrack::checker
