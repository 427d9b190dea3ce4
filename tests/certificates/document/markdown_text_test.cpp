#include "certificates/document/markdown_text.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "analysis/rigor/decimal.hpp"

namespace {

namespace markdown = veritrack::certificates::markdown;
using veritrack::rigor::Interval;
using veritrack::rigor::Verdict;

TEST_CASE("mathematics has no bar that would end a table cell") {
  CHECK(markdown::math("|x| \\le 1") == "$`\\vert x\\vert  \\le 1`$");
  CHECK(markdown::math("\\|A\\|") == "$`\\Vert A\\Vert `$");
}

TEST_CASE("enclosures are rounded outward, and exact points say so") {
  CHECK(markdown::enclosure(Interval(7.0)) == "= 7");
  CHECK(markdown::enclosure(Interval(0.5), 1) == "= 0.5");
  CHECK(markdown::enclosure(veritrack::rigor::parse_decimal("0.1"), 3) == "∈ [0.0999, 0.101]");
  CHECK(markdown::enclosure(Interval::from_bounds(1.0, 2.0)) == "∈ [1, 2]");
  CHECK(markdown::enclosure(Interval::empty()) == "unknown");
  CHECK(markdown::enclosure(Interval::from_bounds(1.0, std::numeric_limits<double>::infinity())) ==
        "∈ [1, inf]");
}

TEST_CASE("verdicts are words in capitals") {
  CHECK(markdown::verdict(Verdict::proved) == "**PROVED**");
  CHECK(markdown::verdict(Verdict::refuted) == "**REFUTED**");
  CHECK(markdown::verdict(Verdict()) == "**UNDECIDED**");
}

TEST_CASE("text from the user cannot become mark-up") {
  CHECK(markdown::escaped("a_b*c|d") == "a\\_b\\*c\\|d");
  CHECK(markdown::escaped("<b>[x](y)") == "\\<b\\>\\[x\\](y)");
  CHECK(markdown::escaped("two\nlines") == "two lines");
}

TEST_CASE("a bar within a cell is escaped once") {
  CHECK(markdown::table({"a"}, {{"|x|"}}) == "| a |\n| --- |\n| \\|x\\| |\n");
  CHECK(markdown::table({"a"}, {{"\\|"}}) == "| a |\n| --- |\n| \\| |\n");
}

TEST_CASE("a fence is longer than any fence in the text") {
  CHECK(markdown::fenced("x = 1", "toml") == "```toml\nx = 1\n```\n");
  CHECK(markdown::fenced("```\n", "") == "````\n```\n````\n");
}

TEST_CASE("a document inside another one has lower headings, and what is fenced as it was") {
  CHECK(markdown::with_lower_headings("# A\ntext\n```\n# a comment\n```\n## B\n") ==
        "## A\ntext\n```\n# a comment\n```\n### B\n");
  CHECK(markdown::with_lower_headings("````c\n```\n# in\n````\n# out") == "````c\n```\n# in\n````\n## out");
  CHECK(markdown::with_lower_headings("").empty());
}

}  // namespace
