// The libraries that the arithmetic uses, for a certificate's list of software.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace veritrack::rigor {

/// (name, version) of the compiler and of every library that interval results depend on.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> arithmetic_versions();

}  // namespace veritrack::rigor
