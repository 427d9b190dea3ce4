#include "reports/page/inline_svg.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

namespace veritrack::reports::page {
namespace {

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

TEST_CASE("ids get a prefix, colours none, and the picture a name for screen readers") {
  const std::string svg = inline_svg(
      "<?xml version=\"1.0\"?><!DOCTYPE svg><svg xmlns='http://www.w3.org/2000/svg' width='8' height='4' "
      "viewBox='0 0 8 4'>"
      "<title>old</title><desc>by somebody</desc><g id='a'><title>a line</title><rect fill='#ffffff'/></g>"
      "<use xlink:href='#a' clip-path='url(#c)'/><text> x &lt; 1</text></svg>",
      "f2-", "one & two");
  CHECK(contains(svg, "id=\"f2-a\""));
  CHECK(contains(svg, "xlink:href=\"#f2-a\""));
  CHECK(contains(svg, "clip-path=\"url(#f2-c)\""));
  CHECK(contains(svg, "fill=\"#ffffff\""));
  CHECK(contains(svg, "role=\"img\" aria-labelledby=\"f2-title\""));
  CHECK(contains(svg, "<title id=\"f2-title\">one &amp; two</title>"));
  CHECK(contains(svg, "<title>a line</title>"));
  CHECK(contains(svg, "> x &lt; 1<"));
  for (const char* gone : {"<?xml", "<!DOCTYPE", "width=", "old", "by somebody"}) {
    CAPTURE(gone);
    CHECK_FALSE(contains(svg, gone));
  }
}

TEST_CASE("nothing in it runs or fetches") {
  const std::string svg = inline_svg(
      "<svg><script>a</script><a href='https://x'>b</a><g onclick='c'><image href='https://x'/></g>"
      "<foreignObject/><style>d</style></svg>",
      "", "t");
  CHECK(svg ==
        "<svg role=\"img\" aria-labelledby=\"title\"><title id=\"title\">t</title><g><image/></g></svg>");
}

TEST_CASE("what is no SVG is refused") {
  for (const char* text : {"", "x", "<html/>", "<svg>"}) {
    CHECK_THROWS_AS(static_cast<void>(inline_svg(text, "", "")), std::invalid_argument);
  }
}

}  // namespace
}  // namespace veritrack::reports::page
