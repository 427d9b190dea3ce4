// Files that are parts of each page, made a part of the program by CMake.
#pragma once

#include <string_view>

namespace veritrack::reports::page {

/// page.mustache, page.css, page.js, map.js, katex-licence.txt of this folder, and of KaTeX katex.js and
/// katex.css, which has its fonts in it. Throws std::out_of_range for another name.
[[nodiscard]] std::string_view asset(std::string_view name);

}  // namespace veritrack::reports::page
