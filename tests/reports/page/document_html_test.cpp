#include "reports/page/document_html.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

#include "certificates/document/markdown_text.hpp"
#include "tests/support/random.hpp"

namespace veritrack::reports::page {
namespace {

const std::string kSvg =
    "<?xml version=\"1.0\"?><svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 8 4\"><path "
    "d=\"M0,0\"/></svg>";

std::string html(const std::string& markdown, const std::vector<PageFigure>& figures = {}) {
  return document_html(markdown, figures, "").html;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_CASE("headings, verdicts, formulas and tables") {
  const DocumentHtml document = document_html(
      "# PROVED: it is\n\n**PROVED**: a.\n\n## What was required\n\n| a | b |\n| --- | --- |\n"
      "| $`x < 1`$ | **REFUTED** |\n\n```math\nx^2 & y\n```\n\n## What was required\n",
      {}, "");
  CHECK(document.title == "PROVED: it is");
  REQUIRE(document.sections.size() == 2);
  CHECK(document.sections[0].id == "what-was-required");
  CHECK(document.sections[1].id == "what-was-required-1");
  CHECK(has(document.html, "<h2 id=\"what-was-required\">\nWhat was required\n</h2>"));
  CHECK(has(document.html, "<strong class=\"verdict proved\">PROVED</strong>: a."));
  CHECK(has(document.html, "<td><strong class=\"verdict refuted\">REFUTED</strong></td>"));
  CHECK(has(document.html, "<td><span class=\"math\">x &lt; 1</span></td>"));
  CHECK(has(document.html, "<div class=\"math block\">x^2 &amp; y\n</div>"));
  CHECK(has(document.html, "role=\"region\" tabindex=\"0\" aria-label=\"What was required\""));
}

TEST_CASE("dollars around code are a formula, others are not") {
  CHECK(has(html("costs $ `a` $ and $5"), "costs $ <code>a</code> $ and $5"));
  CHECK(has(html("$`a`$, $`b`$ $`c`$"),
            "<span class=\"math\">a</span>, <span class=\"math\">b</span> <span class=\"math\">c</span>"));
}

TEST_CASE("tags are text") {
  const std::string page =
      html("a <b>bold</b> <!-- hidden --> c\n\n<script>alert(1)</script>\n\n<div\nonclick=x>\n");
  CHECK_FALSE(has(page, "<script"));
  CHECK_FALSE(has(page, "<b>"));
  CHECK_FALSE(has(page, "<!--"));
  CHECK_FALSE(has(page, "<div"));
  CHECK(has(page, "&lt;script&gt;alert(1)&lt;/script&gt;"));
  CHECK(has(page, "&lt;!-- hidden --&gt;"));
}

TEST_CASE("addresses are relative, or begin with https") {
  const std::string page = html(
      "[a](javascript:alert) [b](JAVASCRIPT:x) [c](data:text/html,x) [d](//host/x) [e](http://x) "
      "[f](https://x) "
      "[g](certificate.json) [h](published-theorems.md) ![i](data:image/png,x)");
  for (const char* none : {"javascript:", "JAVASCRIPT:", "data:", "//host", "http:", "<img"}) {
    CAPTURE(none);
    CHECK_FALSE(has(page, none));
  }
  CHECK(has(page, "a b c d e <a href=\"https://x\">f</a> <a href=\"certificate.json\">g</a>"));
  CHECK(has(page, "<a href=\"#published-theorems\">h</a>"));
}

TEST_CASE("a figure is drawn in the page, with its caption, and must be there") {
  const std::string text = "![what it shows](figures/a.svg)\n\n*A caption of `code`.*\n\nnext\n";
  const std::string page = html(text, {{"figures/a.svg", kSvg, ""}});
  CHECK(has(page, "<figure>\n<svg"));
  CHECK(has(page, "<title id=\"f1-title\">what it shows</title>"));
  CHECK(has(page, "<figcaption>\n<p>A caption of <code>code</code>.</p>\n</figcaption>\n</figure>"));
  CHECK(has(page, "<p>next</p>"));
  CHECK_THROWS_AS(html(text), std::invalid_argument);
  const DocumentHtml map = document_html("![m](region.svg)\n", {{"region.svg", kSvg, "{\"cells\":[]}"}}, "");
  CHECK(has(map.html, "<figure class=\"map\" data-values=\"0\">"));
  CHECK(map.values == std::vector<std::string>{"{\"cells\":[]}"});
}

TEST_CASE("what is escaped for Markdown comes out as it was, and is nothing but text") {
  const std::string alphabet = "<>&\"'`*_[]()#!|$~\\-+.{}:/=; ab1";
  test::Random random(20);
  for (int i = 0; i < test::effort(300); ++i) {
    std::string text = "x";
    for (int j = 0; j < 40; ++j) {
      text += alphabet[random.below(alphabet.size())];
    }
    text += "x";
    CAPTURE(text);
    CHECK(html("of " + certificates::markdown::escaped(text) + ".") ==
          "<p>of " + html_escaped(text) + ".</p>\n");
  }
}

}  // namespace
}  // namespace veritrack::reports::page
