// A figure as part of a page.
#pragma once

#include <string>
#include <string_view>

namespace veritrack::reports::page {

/// The SVG document as an element for the inside of an HTML page: as wide as its place, an image for screen
/// readers, with `title` as its text, and with `prefix` before each of its ids, so that ids of two figures
/// differ. Elements that are programs or fetch something are removed. Throws std::invalid_argument for a text
/// that is not SVG.
[[nodiscard]] std::string inline_svg(std::string_view svg, std::string_view prefix, std::string_view title);

}  // namespace veritrack::reports::page
