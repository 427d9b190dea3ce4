#include "reports/page/page.hpp"

#include <fmt/format.h>
#include <nettle/base64.h>
#include <nettle/sha2.h>

#include <array>
#include <kainjow/mustache.hpp>
#include <stdexcept>
#include <utility>

#include "certificates/document/sha256.hpp"
#include "reports/page/assets.hpp"

namespace veritrack::reports::page {

namespace {

namespace mustache = kainjow::mustache;

/// 'sha256-...', by which a policy names a program.
std::string source_of(std::string_view program) {
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, program.size(),
                reinterpret_cast<const std::uint8_t*>(program.data()));  // NOLINT: bytes, as nettle has them
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
  sha256_digest(&context, digest.size(), digest.data());
  std::string text(BASE64_ENCODE_RAW_LENGTH(SHA256_DIGEST_SIZE), '\0');
  base64_encode_raw(text.data(), digest.size(), digest.data());
  return "'sha256-" + text + "'";
}

/// JSON that cannot end the element it is in.
std::string inside_script(std::string json) {
  for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at)) {
    json.replace(at, 1, "\\u003c");
  }
  return json;
}

mustache::data list_of_sections(const std::vector<Section>& sections) {
  mustache::data list{mustache::data::type::list};
  for (const Section& section : sections) {
    mustache::data item;
    item.set("id", section.id);
    item.set("title", section.title);
    list.push_back(item);
  }
  return list;
}

}  // namespace

std::string to_page(const PageContent& content) {
  const DocumentHtml document = document_html(content.markdown, content.figures, "");
  std::vector<std::string> programs{std::string(asset("katex.js")), std::string(asset("page.js"))};
  if (!document.values.empty()) {
    programs.emplace_back(asset("map.js"));
  }
  mustache::data page;
  mustache::data scripts{mustache::data::type::list};
  std::string policy =
      "default-src 'none'; style-src 'unsafe-inline'; font-src data:; base-uri 'none'; "
      "form-action 'none'; script-src";
  for (const std::string& program : programs) {
    policy += " " + source_of(program);
    scripts.push_back({"text", program});
  }
  mustache::data values{mustache::data::type::list};
  for (std::size_t i = 0; i < document.values.size(); ++i) {
    mustache::data one;
    one.set("id", fmt::format("values-{}", i));
    one.set("json", inside_script(document.values[i]));
    values.push_back(one);
  }
  page.set("policy", policy);
  page.set("version", VERITRACK_VERSION);
  page.set("title", document.title);
  page.set("katex_licence", std::string(asset("katex-licence.txt")));
  page.set("katex_style", std::string(asset("katex.css")));
  page.set("style", std::string(asset("page.css")));
  page.set("sections", list_of_sections(document.sections));
  page.set("document", document.html);
  if (!content.appendix.empty()) {
    const DocumentHtml appendix = document_html(content.appendix, content.figures, "published-");
    mustache::data folded;
    folded.set("title", appendix.title);
    folded.set("html", appendix.html);
    page.set("appendix", folded);
  }
  page.set("file", content.file);
  page.set("sha256", certificates::sha256(content.markdown));
  if (!content.how_to_check.empty()) {
    page.set("how_to_check", content.how_to_check);
  }
  page.set("values", values);
  page.set("scripts", scripts);
  mustache::mustache form{std::string(asset("page.mustache"))};
  std::string text = form.render(page);
  if (!form.is_valid()) {
    throw std::logic_error("page.mustache: " + form.error_message());
  }
  return text;
}

}  // namespace veritrack::reports::page
