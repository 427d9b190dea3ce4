// A Markdown document as a tree, as GitHub reads it: with tables and formulas.
#pragma once

#include <cmark-gfm.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace veritrack::reports::page {

/// The tree of a document. HTML has no effect in it: a tag is text, which a reader sees as written. Only
/// relative addresses and those that begin with https are links; of other links only the words remain.
class MarkdownTree {
 public:
  explicit MarkdownTree(std::string_view markdown);

  [[nodiscard]] cmark_node* root() const { return root_.get(); }
  /// The document as HTML, with the HTML of nodes that were put into it.
  [[nodiscard]] std::string html() const;

 private:
  std::unique_ptr<cmark_parser, decltype(&cmark_parser_free)> parser_;
  std::unique_ptr<cmark_node, decltype(&cmark_node_free)> root_;
};

/// The nodes of that type in the order of the document, e.g. "heading" or "table".
[[nodiscard]] std::vector<cmark_node*> nodes_of_type(cmark_node* root, std::string_view type);

/// The children, first to last.
[[nodiscard]] std::vector<cmark_node*> children_of(cmark_node* node);

/// The visible text of the node and everything in it, without marks.
[[nodiscard]] std::string plain_text(cmark_node* node);

/// Letters, digits and hyphens, for an id: "What was required" is "what-was-required".
[[nodiscard]] std::string slug(std::string_view title);

/// The replacement of a formula: from its LaTeX, and whether it is a line of its own.
using FormulaWriter = std::function<cmark_node*(std::string_view latex, bool is_block)>;

/// Replaces each formula below the node by the output of the writer: $`...`$, and blocks of the language
/// `math`.
void replace_formulas(cmark_node* root, const FormulaWriter& formula);

/// A node that is written as this HTML, in a line.
[[nodiscard]] cmark_node* html_node(const std::string& html);
/// A block that is written as `before`, its children, and `after`.
[[nodiscard]] cmark_node* block_node(const std::string& before, const std::string& after = {});

/// The node replaces `old`, which is removed.
void replace_node(cmark_node* old, cmark_node* node);

/// Moves the children to the end of those of another node.
void move_children(cmark_node* from, cmark_node* to);

/// The node takes the place of `old`, whose children become its own.
void replace_keeping_children(cmark_node* old, cmark_node* node);

}  // namespace veritrack::reports::page
