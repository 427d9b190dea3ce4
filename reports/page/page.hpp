// A page: one HTML file that needs nothing else, no network and no other file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reports/page/document_html.hpp"

namespace veritrack::reports::page {

/// The contents.
struct PageContent {
  std::string markdown;             ///< the document
  std::string file;                 ///< its name, e.g. "certificate.md"
  std::string appendix;             ///< a second document, which is folded; empty when there is none
  std::vector<PageFigure> figures;  ///< of both
  std::string how_to_check;         ///< a command; empty when the checker has nothing to do with it
};

/// The page: a rendering of its documents, with KaTeX for the formulas and a content security policy under
/// which no other program runs and nothing is fetched. Same content, same bytes.
[[nodiscard]] std::string to_page(const PageContent& content);

}  // namespace veritrack::reports::page
