#include "reports/page/markdown_tree.hpp"

#include <cmark-gfm-core-extensions.h>

#include <cstdlib>
#include <stdexcept>

namespace veritrack::reports::page {

namespace {

std::string literal(cmark_node* node) {
  const char* text = cmark_node_get_literal(node);
  return text == nullptr ? "" : text;
}

/// Tags become text: what is written is what is seen.
void show_tags(cmark_node* root) {
  for (cmark_node* node : nodes_of_type(root, "html_inline")) {
    cmark_node* text = cmark_node_new(CMARK_NODE_TEXT);
    cmark_node_set_literal(text, literal(node).c_str());
    replace_node(node, text);
  }
  for (cmark_node* node : nodes_of_type(root, "html_block")) {
    cmark_node* text = cmark_node_new(CMARK_NODE_TEXT);
    cmark_node_set_literal(text, literal(node).c_str());
    cmark_node* paragraph = cmark_node_new(CMARK_NODE_PARAGRAPH);
    cmark_node_append_child(paragraph, text);
    replace_node(node, paragraph);
  }
}

/// Whether it is a text node that ends (or begins) with a dollar.
bool has_dollar(cmark_node* node, bool at_the_end) {
  if (node == nullptr || cmark_node_get_type(node) != CMARK_NODE_TEXT) {
    return false;
  }
  const std::string text = literal(node);
  return !text.empty() && (at_the_end ? text.back() : text.front()) == '$';
}

void drop_dollar(cmark_node* node, bool at_the_end) {
  std::string text = literal(node);
  text.erase(at_the_end ? text.size() - 1 : 0, 1);
  cmark_node_set_literal(node, text.c_str());
}

/// Whether a page may refer to the address: beside it, in it, or by https.
bool is_allowed(std::string_view address) {
  const bool has_scheme = address.substr(0, address.find_first_of("/?#")).find(':') != std::string_view::npos;
  return address.starts_with("https://") || (!has_scheme && !address.starts_with("//"));
}

void drop_addresses(cmark_node* root) {
  for (const char* type : {"link", "image"}) {
    for (cmark_node* node : nodes_of_type(root, type)) {
      if (!is_allowed(cmark_node_get_url(node))) {
        cmark_node* words = cmark_node_new(CMARK_NODE_TEXT);
        cmark_node_set_literal(words, plain_text(node).c_str());
        replace_node(node, words);
      }
    }
  }
}

}  // namespace

MarkdownTree::MarkdownTree(std::string_view markdown)
    : parser_(nullptr, &cmark_parser_free), root_(nullptr, &cmark_node_free) {
  cmark_gfm_core_extensions_ensure_registered();
  parser_.reset(cmark_parser_new(CMARK_OPT_VALIDATE_UTF8));
  cmark_syntax_extension* table = cmark_find_syntax_extension("table");
  if (table == nullptr || cmark_parser_attach_syntax_extension(parser_.get(), table) == 0) {
    throw std::logic_error("this cmark-gfm has no tables");
  }
  cmark_parser_feed(parser_.get(), markdown.data(), markdown.size());
  root_.reset(cmark_parser_finish(parser_.get()));
  cmark_consolidate_text_nodes(root_.get());
  show_tags(root_.get());
  drop_addresses(root_.get());
}

std::string MarkdownTree::html() const {
  // "Unsafe" are tags and addresses of the document, of which the constructor has left none.
  char* text =
      cmark_render_html(root_.get(), CMARK_OPT_UNSAFE, cmark_parser_get_syntax_extensions(parser_.get()));
  std::string html = text;
  std::free(text);  // NOLINT(cppcoreguidelines-no-malloc): as cmark says
  return html;
}

std::vector<cmark_node*> nodes_of_type(cmark_node* root, std::string_view type) {
  std::vector<cmark_node*> found;
  const std::unique_ptr<cmark_iter, decltype(&cmark_iter_free)> iterator(cmark_iter_new(root),
                                                                         &cmark_iter_free);
  while (cmark_iter_next(iterator.get()) != CMARK_EVENT_DONE) {
    cmark_node* node = cmark_iter_get_node(iterator.get());
    const bool entered = cmark_iter_get_event_type(iterator.get()) == CMARK_EVENT_ENTER;
    if (entered && cmark_node_get_type_string(node) == type) {
      found.push_back(node);
    }
  }
  return found;
}

std::vector<cmark_node*> children_of(cmark_node* node) {
  std::vector<cmark_node*> children;
  for (cmark_node* child = cmark_node_first_child(node); child != nullptr; child = cmark_node_next(child)) {
    children.push_back(child);
  }
  return children;
}

std::string plain_text(cmark_node* node) {
  const cmark_node_type type = cmark_node_get_type(node);
  if (type == CMARK_NODE_TEXT || type == CMARK_NODE_CODE) {
    return literal(node);
  }
  std::string text = type == CMARK_NODE_SOFTBREAK || type == CMARK_NODE_LINEBREAK ? " " : "";
  for (cmark_node* child : children_of(node)) {
    text += plain_text(child);
  }
  return text;
}

std::string slug(std::string_view title) {
  std::string id;
  for (const char c : title) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (is_letter) {
      id += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    } else if (!id.empty() && id.back() != '-') {
      id += '-';
    }
  }
  return id.substr(0, id.find_last_not_of('-') + 1);
}

void replace_formulas(cmark_node* root, const FormulaWriter& formula) {
  for (cmark_node* node : nodes_of_type(root, "code")) {
    cmark_node* before = cmark_node_previous(node);
    cmark_node* after = cmark_node_next(node);
    if (has_dollar(before, true) && has_dollar(after, false)) {
      drop_dollar(before, true);
      drop_dollar(after, false);
      replace_node(node, formula(literal(node), false));
    }
  }
  for (cmark_node* node : nodes_of_type(root, "code_block")) {
    if (std::string_view(cmark_node_get_fence_info(node)) == "math") {
      replace_node(node, formula(literal(node), true));
    }
  }
}

cmark_node* html_node(const std::string& html) {
  cmark_node* node = cmark_node_new(CMARK_NODE_HTML_INLINE);
  cmark_node_set_literal(node, html.c_str());
  return node;
}

cmark_node* block_node(const std::string& before, const std::string& after) {
  cmark_node* node = cmark_node_new(CMARK_NODE_CUSTOM_BLOCK);
  cmark_node_set_on_enter(node, before.c_str());
  cmark_node_set_on_exit(node, after.c_str());
  return node;
}

void replace_node(cmark_node* old, cmark_node* node) {
  if (cmark_node_replace(old, node) == 0) {
    cmark_node_free(node);
    throw std::logic_error(std::string("no place for this node in a ") +
                           cmark_node_get_type_string(cmark_node_parent(old)));
  }
  cmark_node_free(old);
}

void move_children(cmark_node* from, cmark_node* to) {
  for (cmark_node* child : children_of(from)) {
    // Reading a text makes it the node's own; until then it is a part of the block that it was parsed in, and
    // goes with it.
    static_cast<void>(plain_text(child));
    cmark_node_append_child(to, child);
  }
}

void replace_keeping_children(cmark_node* old, cmark_node* node) {
  move_children(old, node);
  replace_node(old, node);
}

}  // namespace veritrack::reports::page
