#include "reports/page/document_html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>

#include "reports/page/inline_svg.hpp"
#include "reports/page/markdown_tree.hpp"

namespace veritrack::reports::page {

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kVerdicts{
    {{"PROVED", "proved"}, {"REFUTED", "refuted"}, {"UNDECIDED", "undecided"}}};

class Renderer {
 public:
  Renderer(const std::vector<PageFigure>& figures, std::string_view prefix)
      : figures_(figures), prefix_(prefix) {}

  DocumentHtml render(std::string_view markdown) {
    const MarkdownTree tree(markdown);
    cmark_node* root = tree.root();
    replace_formulas(root, [](std::string_view latex, bool is_block) {
      return is_block ? block_node(fmt::format("<div class=\"math block\">{}</div>\n", html_escaped(latex)))
                      : html_node(fmt::format("<span class=\"math\">{}</span>", html_escaped(latex)));
    });
    mark_verdicts(root);
    lead_to_the_appendix(root);
    draw_figures(root);
    arrange(root);
    result_.html = tree.html();
    return std::move(result_);
  }

 private:
  /// A verdict in bold is one of ours: what comes from a design is escaped, and has no bold words.
  static void mark_verdicts(cmark_node* root) {
    for (cmark_node* strong : nodes_of_type(root, "strong")) {
      const std::string word = plain_text(strong);
      for (const auto& [verdict, name] : kVerdicts) {
        if (word == verdict) {
          replace_node(strong,
                       html_node(fmt::format("<strong class=\"verdict {}\">{}</strong>", name, verdict)));
          break;
        }
      }
    }
  }

  static void lead_to_the_appendix(cmark_node* root) {
    for (cmark_node* link : nodes_of_type(root, "link")) {
      const std::string_view address = cmark_node_get_url(link);
      if (address == "published-theorems.md") {
        cmark_node_set_url(link, "#published-theorems");
      } else if (address == "certificate.md") {
        cmark_node_set_url(link, "#");
      }
    }
  }

  /// A paragraph with nothing but an image, and one with nothing but emphasised words after it, its caption.
  void draw_figures(cmark_node* root) {
    for (cmark_node* image : nodes_of_type(root, "image")) {
      cmark_node* paragraph = cmark_node_parent(image);
      const std::string path = cmark_node_get_url(image);
      const auto found = std::find_if(figures_.begin(), figures_.end(),
                                      [&](const PageFigure& figure) { return figure.path == path; });
      if (found == figures_.end() || children_of(paragraph).size() != 1) {
        throw std::invalid_argument("the document refers to a figure that is not there: " + path);
      }
      ++drawn_;
      const std::string begin = fmt::format(
          "<figure{}>\n{}\n",
          found->values.empty() ? ""
                                : fmt::format(" class=\"map\" data-values=\"{}\"", result_.values.size()),
          inline_svg(found->svg, fmt::format("{}f{}-", prefix_, drawn_), plain_text(image)));
      if (!found->values.empty()) {
        result_.values.push_back(found->values);
      }
      cmark_node* next = cmark_node_next(paragraph);
      const bool has_caption = is_emphasised(next);
      cmark_node* figure = block_node(begin + (has_caption ? "<figcaption>\n" : ""),
                                      has_caption ? "</figcaption>\n</figure>\n" : "</figure>\n");
      replace_node(paragraph, figure);
      if (has_caption) {
        cmark_node* words = cmark_node_new(CMARK_NODE_PARAGRAPH);
        move_children(cmark_node_first_child(next), words);
        cmark_node_unlink(next);
        cmark_node_free(next);
        cmark_node_append_child(figure, words);
      }
    }
  }

  static bool is_emphasised(cmark_node* paragraph) {
    if (paragraph == nullptr || cmark_node_get_type(paragraph) != CMARK_NODE_PARAGRAPH) {
      return false;
    }
    const std::vector<cmark_node*> children = children_of(paragraph);
    return children.size() == 1 && cmark_node_get_type(children.front()) == CMARK_NODE_EMPH;
  }

  /// Headings get ids, tables a frame in which they scroll, named after the heading above.
  void arrange(cmark_node* root) {
    std::string above = "Table";
    for (cmark_node* node : children_of(root)) {
      if (cmark_node_get_type(node) == CMARK_NODE_HEADING) {
        above = plain_text(node);
        give_id(node, above);
      } else if (std::string_view(cmark_node_get_type_string(node)) == "table") {
        cmark_node* frame =
            block_node(fmt::format("<div class=\"table\" role=\"region\" tabindex=\"0\" aria-label=\"{}\">\n",
                                   html_escaped(above)),
                       "</div>\n");
        cmark_node_insert_before(node, frame);
        cmark_node_append_child(frame, node);
      }
    }
  }

  void give_id(cmark_node* heading, const std::string& title) {
    const int level = cmark_node_get_heading_level(heading);
    if (level == 1 && result_.title.empty()) {
      result_.title = title;
    }
    std::string id = std::string(prefix_) + slug(title);
    const int before = seen_[id]++;
    if (before > 0) {
      id += fmt::format("-{}", before);
    }
    if (level == 2) {
      result_.sections.push_back({id, title});
    }
    replace_keeping_children(
        heading, block_node(fmt::format("<h{} id=\"{}\">", level, id), fmt::format("</h{}>\n", level)));
  }

  const std::vector<PageFigure>& figures_;
  std::string_view prefix_;
  int drawn_ = 0;
  std::map<std::string, int> seen_;
  DocumentHtml result_;
};

}  // namespace

DocumentHtml document_html(std::string_view markdown, const std::vector<PageFigure>& figures,
                           std::string_view prefix) {
  return Renderer(figures, prefix).render(markdown);
}

std::string html_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace veritrack::reports::page
