// The versions of the program and of the libraries that it uses.
#pragma once

#include <string>

namespace veritrack::cli {

/// "veritrack 0.1.0", and a line for each library: the version that runs, and the one that the program was
/// compiled with where that is another.
[[nodiscard]] std::string version_text();

}  // namespace veritrack::cli
