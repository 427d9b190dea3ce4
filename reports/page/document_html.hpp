// The HTML of a Markdown document: what stands in the middle of a page.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace veritrack::reports::page {

/// A figure that the document refers to.
struct PageFigure {
  std::string path;    ///< as the document has it, e.g. "figures/error.svg"
  std::string svg;     ///< the file
  std::string values;  ///< for a map, the values under the pointer (map_values.hpp); empty for other figures
};

/// A section, for a list of contents.
struct Section {
  std::string id;
  std::string title;  ///< without marks; not escaped
};

/// A document, rendered.
struct DocumentHtml {
  std::string title;  ///< its first heading, without marks; not escaped
  std::string html;
  std::vector<Section> sections;    ///< those of the second level
  std::vector<std::string> values;  ///< of its maps, JSON, by the attribute data-values of the figure
};

/// Renders the document: figures as inline SVG with their captions, formulas as elements of the class `math`
/// with their LaTeX as text, tables that can be scrolled, verdicts marked with a class, links to
/// published-theorems.md as links to the anchor `published-theorems`. Ids begin with `prefix`. Everything
/// that comes from a design is text there. Throws std::invalid_argument when it refers to a figure that is
/// not among these.
[[nodiscard]] DocumentHtml document_html(std::string_view markdown, const std::vector<PageFigure>& figures,
                                         std::string_view prefix);

/// The text with &, <, > and quotes as HTML has them.
[[nodiscard]] std::string html_escaped(std::string_view text);

}  // namespace veritrack::reports::page
