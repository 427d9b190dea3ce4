#include "reports/page/latex_tables.hpp"

#include <doctest/doctest.h>

#include <string>

namespace veritrack::reports::page {
namespace {

TEST_CASE("a table in the style of booktabs, with the heading above as its caption") {
  CHECK(latex_tables(
            "# A\n\n## The design, 100 %\n\n| Value | Unit |\n| --- | --- |\n| $`q_1`$ = `0.1_2` | rad² |\n",
            "certificate.md") ==
        "% The tables of certificate.md, for \\input in a paper.\n% \\usepackage{amsmath,array,booktabs}\n\n"
        "\\begin{table}\n\\centering\\small\n\\caption{The design, 100 \\%}\n\\label{tab:the-design-100}\n"
        "\\begin{tabular}{@{}ll@{}}\n\\toprule\nValue & Unit \\\\\n\\midrule\n"
        "$q_1$ = \\texttt{0.1\\_2} & rad\\ensuremath{^2} \\\\\n\\bottomrule\n\\end{tabular}\n\\end{table}\n");
}

TEST_CASE("what LaTeX would interpret is escaped, numbers stay as they are") {
  const std::string text = latex_tables(
      "| a |\n| --- |\n| \\[0.1, 0.2\\] \\\\input{x} 5% & #1 ~ ^ \\$ \\_ <b> |\n| ∈ [0.30000001, 0.4] |\n",
      "x");
  for (const char* part : {"{[}0.1, 0.2{]}", "\\textbackslash{}input\\{x\\}", "5\\%", "\\&", "\\#1", "\\$",
                           "\\_", "\\ensuremath{\\in} {[}0.30000001, 0.4{]}"}) {
    CAPTURE(part);
    CHECK(text.find(part) != std::string::npos);
  }
}

TEST_CASE("two tables below one heading have two labels; long cells are broken, but not words") {
  std::string sentence = "x";
  for (int i = 0; i < 40; ++i) {
    sentence += " x";
  }
  const std::string text =
      latex_tables("## T\n\n| a |\n| - |\n| 1 |\n\n| a | b | c |\n| - | - | - |\n| " + sentence + " | " +
                       std::string(30, 'y') + " | " + sentence + " |\n",
                   "x");
  CHECK(text.find("\\label{tab:t}") != std::string::npos);
  CHECK(text.find("\\label{tab:t-2}") != std::string::npos);
  const std::string broken = ">{\\raggedright\\arraybackslash}p{0.31\\linewidth}";
  CHECK(text.find("{@{}" + broken + "l" + broken + "@{}}") != std::string::npos);
}

}  // namespace
}  // namespace veritrack::reports::page
