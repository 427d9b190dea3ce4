// The tables of a Markdown document for a paper.
#pragma once

#include <string>
#include <string_view>

namespace veritrack::reports::page {

/// All tables of the document, each as a `table` of LaTeX in the style of booktabs: its caption is the
/// heading above it, its label tab:<heading>. The cells are those of the document, so that numbers are
/// rounded as there; what LaTeX would interpret is escaped. The text is for \input, and says which packages
/// it needs. `file` is the document's name, for that comment.
[[nodiscard]] std::string latex_tables(std::string_view markdown, std::string_view file);

}  // namespace veritrack::reports::page
