// Files that are parts of each page, made a part of the program by CMake.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace veritrack::reports::page {

/// page.mustache, page.css, page.js, map.js, katex-licence.txt of this folder, and of KaTeX katex.js and
/// katex.css, which has its fonts in it. Throws std::out_of_range for another name.
[[nodiscard]] std::string_view asset(std::string_view name);

/// The libraries that make a page or are in it, with their versions.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> page_versions();

}  // namespace veritrack::reports::page
