#include "reports/page/latex_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "reports/page/markdown_tree.hpp"

namespace veritrack::reports::page {

namespace {

/// Characters of our documents that pdflatex does not know by themselves.
constexpr std::array<std::pair<std::string_view, std::string_view>, 42> kSymbols{{
    {"∈", "\\in"},    {"≈", "\\approx"}, {"≤", "\\le"},     {"≥", "\\ge"},    {"≠", "\\ne"},
    {"∞", "\\infty"}, {"·", "\\cdot"},   {"×", "\\times"},  {"±", "\\pm"},    {"√", "\\surd"},
    {"²", "^2"},      {"³", "^3"},       {"⁻", "^-"},       {"¹", "^1"},      {"°", "^\\circ"},
    {"α", "\\alpha"}, {"β", "\\beta"},   {"γ", "\\gamma"},  {"δ", "\\delta"}, {"ε", "\\varepsilon"},
    {"ζ", "\\zeta"},  {"η", "\\eta"},    {"θ", "\\theta"},  {"κ", "\\kappa"}, {"λ", "\\lambda"},
    {"μ", "\\mu"},    {"ν", "\\nu"},     {"ξ", "\\xi"},     {"π", "\\pi"},    {"ρ", "\\rho"},
    {"σ", "\\sigma"}, {"τ", "\\tau"},    {"φ", "\\varphi"}, {"χ", "\\chi"},   {"ψ", "\\psi"},
    {"ω", "\\omega"}, {"Δ", "\\Delta"},  {"Σ", "\\Sigma"},  {"Ω", "\\Omega"}, {"ℓ", "\\ell"},
    {"−", "-"},       {"→", "\\to"},
}};

std::string with_symbols(std::string text) {
  for (const auto& [character, command] : kSymbols) {
    const std::string replacement = fmt::format("\\ensuremath{{{}}}", command);
    for (std::size_t at = text.find(character); at != std::string::npos;
         at = text.find(character, at + replacement.size())) {
      text.replace(at, character.size(), replacement);
    }
  }
  return text;
}

cmark_node* inline_latex(const std::string& text) {
  cmark_node* node = cmark_node_new(CMARK_NODE_CUSTOM_INLINE);
  cmark_node_set_on_enter(node, text.c_str());
  return node;
}

/// The words of a cell or heading as LaTeX on one line. Takes them out of the node.
std::string words_latex(cmark_node* cell) {
  const std::unique_ptr<cmark_node, decltype(&cmark_node_free)> document(cmark_node_new(CMARK_NODE_DOCUMENT),
                                                                         &cmark_node_free);
  cmark_node* paragraph = cmark_node_new(CMARK_NODE_PARAGRAPH);
  cmark_node_append_child(document.get(), paragraph);
  move_children(cell, paragraph);
  replace_formulas(paragraph, [](std::string_view latex, bool /*is_block*/) {
    return inline_latex(fmt::format("${}$", latex));
  });
  // A paper has no links to files beside a certificate.
  for (cmark_node* link : nodes_of_type(paragraph, "link")) {
    replace_keeping_children(link, inline_latex(""));
  }
  char* text = cmark_render_latex(document.get(), CMARK_OPT_NOBREAKS, 0);
  std::string latex = text;
  std::free(text);  // NOLINT(cppcoreguidelines-no-malloc): as cmark says
  while (!latex.empty() && latex.back() == '\n') {
    latex.pop_back();
  }
  std::replace(latex.begin(), latex.end(), '\n', ' ');
  return with_symbols(latex);
}

/// How much room a column needs, in letters.
struct Width {
  std::size_t longest = 0;    ///< cell
  std::size_t breakable = 0;  ///< cell with a space in it, where a line can end
};

struct Table {
  std::vector<std::vector<std::string>> rows;  ///< the first is the header
  std::vector<Width> widths;
};

Table read_table(cmark_node* node) {
  Table table;
  for (cmark_node* row : children_of(node)) {
    std::vector<std::string> cells;
    for (cmark_node* cell : children_of(row)) {
      const std::string text = plain_text(cell);
      if (cells.size() >= table.widths.size()) {
        table.widths.emplace_back();
      }
      Width& width = table.widths[cells.size()];
      width.longest = std::max(width.longest, text.size());
      width.breakable = std::max(width.breakable, text.find(' ') == std::string::npos ? 0 : text.size());
      cells.push_back(words_latex(cell));
    }
    table.rows.push_back(std::move(cells));
  }
  return table;
}

/// "lp{0.42\linewidth}": what the columns of short cells leave of the line, those of long cells share.
std::string columns_of(const Table& table) {
  constexpr std::size_t kShort = 22;    // letters that need no breaking
  constexpr std::size_t kLongest = 80;  // what is longer than that is broken anyway
  constexpr double kLine = 95.0;        // letters on a line
  constexpr double kBetween = 3.0;      // letters that the space between two columns takes
  double fixed = kBetween * static_cast<double>(table.widths.size() - 1);
  double all = 0.0;
  for (const Width& width : table.widths) {
    const auto letters = static_cast<double>(std::min(width.longest, kLongest));
    (width.breakable <= kShort ? fixed : all) += letters;
  }
  std::string columns;
  for (const Width& width : table.widths) {
    const double share = static_cast<double>(std::min(width.longest, kLongest)) / all;
    columns += width.breakable <= kShort || fixed + all <= kLine
                   ? "l"
                   : fmt::format(">{{\\raggedright\\arraybackslash}}p{{{:.2f}\\linewidth}}",
                                 std::max(0.1, share * (kLine - fixed) / kLine));
  }
  return columns;
}

std::string row_latex(const std::vector<std::string>& cells) {
  std::string row;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    row += (i == 0 ? "" : " & ") + cells[i];
  }
  return row + " \\\\\n";
}

std::string table_latex(const Table& table, const std::string& caption, const std::string& label) {
  std::string text = fmt::format(
      "\\begin{{table}}\n\\centering\\small\n\\caption{{{}}}\n\\label{{tab:{}}}\n"
      "\\begin{{tabular}}{{@{{}}{}@{{}}}}\n\\toprule\n",
      caption, label, columns_of(table));
  text += row_latex(table.rows.front()) + "\\midrule\n";
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    text += row_latex(table.rows[i]);
  }
  return text + "\\bottomrule\n\\end{tabular}\n\\end{table}\n";
}

}  // namespace

std::string latex_tables(std::string_view markdown, std::string_view file) {
  const MarkdownTree tree(markdown);
  std::string text = fmt::format(
      "% The tables of {}, for \\input in a paper.\n% \\usepackage{{amsmath,array,booktabs}}\n", file);
  std::map<std::string, int> seen;
  std::string label = "table";
  std::string caption = "Table";
  for (cmark_node* node : children_of(tree.root())) {
    if (cmark_node_get_type(node) == CMARK_NODE_HEADING) {
      label = slug(plain_text(node));
      caption = words_latex(node);
    } else if (std::string_view(cmark_node_get_type_string(node)) == "table") {
      const int before = seen[label]++;
      text += "\n" + table_latex(read_table(node), caption,
                                 label + (before > 0 ? fmt::format("-{}", before + 1) : ""));
    }
  }
  return text;
}

}  // namespace veritrack::reports::page
