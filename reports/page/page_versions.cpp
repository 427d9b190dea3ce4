#include <cmark-gfm.h>
#include <fmt/format.h>

#include <pugixml.hpp>

#include "reports/page/assets.hpp"

namespace veritrack::reports::page {

namespace {

/// KaTeX says its version in its program: version:"0.16.4".
std::string katex_version() {
  constexpr std::string_view kBefore = "version:\"";
  const std::string_view program = asset("katex.js");
  const std::size_t at = program.find(kBefore);
  if (at == std::string_view::npos) {
    return "of unknown version";
  }
  const std::string_view rest = program.substr(at + kBefore.size());
  return std::string(rest.substr(0, rest.find('"')));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> page_versions() {
  return {{"cmark-gfm", cmark_version_string()},
          {"pugixml", fmt::format("{}.{}", PUGIXML_VERSION / 1000, PUGIXML_VERSION / 10 % 100)},
          {"KaTeX", katex_version()}};
}

}  // namespace veritrack::reports::page
