#include "reports/page/page.hpp"

#include <doctest/doctest.h>

#include <string>

#include "reports/page/assets.hpp"

namespace veritrack::reports::page {
namespace {

const std::string kEmptySvg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 8 4\"/>";

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t number = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++number;
  }
  return number;
}

TEST_CASE("a page has everything in it, names its programs in its policy, and says how to check") {
  const std::string page =
      to_page({"# T <1>\n\n## A\n", "certificate.md", "# P\n\n## A\n", {}, "veritrack-verify <x>"});
  CHECK(page.starts_with("<!doctype html>\n<html lang=\"en\">"));
  CHECK(page.find("<title>T &lt;1&gt;</title>") != std::string::npos);
  CHECK(page.find("default-src &apos;none&apos;") != std::string::npos);
  CHECK(count(page, "sha256-") == 2);
  CHECK(count(page, "<script>") == 2);
  CHECK(page.find("<code>veritrack-verify &lt;x&gt;</code>") != std::string::npos);
  CHECK(page.find("<a href=\"#a\">A</a>") != std::string::npos);
  CHECK(page.find("<h2 id=\"published-a\">") != std::string::npos);
  CHECK(page.find("Khan Academy") != std::string::npos);
  CHECK(page.rfind("{{", page.find("<script>")) == std::string::npos);  // none outside of the programs
  CHECK(page ==
        to_page({"# T <1>\n\n## A\n", "certificate.md", "# P\n\n## A\n", {}, "veritrack-verify <x>"}));
}

TEST_CASE("values of a map cannot end their element, and bring their program") {
  const std::string page =
      to_page({"# T\n\n![m](m.svg)\n", "map.md", "", {{"m.svg", kEmptySvg, "{\"a\":\"</script><b>\"}"}}, ""});
  CHECK(page.find("<script type=\"application/json\" "
                  "id=\"values-0\">{\"a\":\"\\u003c/script>\\u003cb>\"}</script>") != std::string::npos);
  CHECK(count(page, "sha256-") == 3);
  CHECK(page.find("The checker does not") == std::string::npos);
  CHECK(page.find("id=\"published-theorems\"") == std::string::npos);
}

TEST_CASE("the libraries of a page have versions") {
  const auto versions = page_versions();
  REQUIRE(versions.size() == 3);
  for (const auto& [name, version] : versions) {
    CAPTURE(name);
    CHECK(version.find('.') != std::string::npos);
    CHECK((version.front() >= '0' && version.front() <= '9'));
  }
}

TEST_CASE("parts of a page do not end their elements, and fetch nothing") {
  for (const char* name : {"katex.js", "page.js", "map.js"}) {
    CHECK(asset(name).find("</script") == std::string_view::npos);
    CHECK(asset(name).find("<!--") == std::string_view::npos);
  }
  for (const char* name : {"katex.css", "page.css"}) {
    CHECK(asset(name).find("</style") == std::string_view::npos);
    CHECK(asset(name).find("url(fonts") == std::string_view::npos);
    CHECK(asset(name).find("@import") == std::string_view::npos);
  }
  CHECK(asset("katex-licence.txt").find("--") == std::string_view::npos);
  CHECK_THROWS_AS(static_cast<void>(asset("other")), std::out_of_range);
}

}  // namespace
}  // namespace veritrack::reports::page
