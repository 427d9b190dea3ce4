#include "reports/page/inline_svg.hpp"

#include <array>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>

namespace veritrack::reports::page {

namespace {

/// The value with the prefix before each id that it refers to as url(#id).
std::string prefixed(std::string value, const std::string& prefix) {
  constexpr std::string_view kUrl = "url(#";
  for (std::size_t at = value.find(kUrl); at != std::string::npos; at = value.find(kUrl, at + 1)) {
    value.insert(at + kUrl.size(), prefix);
  }
  return value;
}

/// Elements that gnuplot never writes, and that a page must not have.
bool is_unwanted(std::string_view element) {
  constexpr std::array<std::string_view, 4> kUnwanted{"script", "style", "foreignObject", "a"};
  for (const std::string_view one : kUnwanted) {
    if (element == one) {
      return true;
    }
  }
  return false;
}

void adapt(pugi::xml_node node, const std::string& prefix) {
  for (pugi::xml_attribute attribute = node.first_attribute(); attribute;) {
    const pugi::xml_attribute next = attribute.next_attribute();
    const std::string_view name = attribute.name();
    const std::string value = attribute.value();
    const bool is_reference = name == "href" || name == "xlink:href";
    if (name.starts_with("on") || (is_reference && !value.starts_with('#'))) {
      node.remove_attribute(attribute);
    } else if (is_reference) {
      attribute.set_value(("#" + prefix + value.substr(1)).c_str());
    } else {
      attribute.set_value((name == "id" ? prefix + value : prefixed(value, prefix)).c_str());
    }
    attribute = next;
  }
  for (pugi::xml_node child = node.first_child(); child;) {
    const pugi::xml_node next = child.next_sibling();
    if (is_unwanted(child.name()) || child.type() == pugi::node_comment) {
      node.remove_child(child);
    } else {
      adapt(child, prefix);
    }
    child = next;
  }
}

}  // namespace

std::string inline_svg(std::string_view svg, std::string_view prefix, std::string_view title) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed =
      document.load_buffer(svg.data(), svg.size(), pugi::parse_default | pugi::parse_ws_pcdata_single);
  pugi::xml_node root = document.document_element();
  if (!parsed || std::string_view(root.name()) != "svg") {
    throw std::invalid_argument(std::string("no SVG: ") + parsed.description());
  }
  const std::string before(prefix);
  adapt(root, before);
  root.remove_attribute("width");
  root.remove_attribute("height");
  root.remove_attribute("id");
  root.remove_child("title");
  root.remove_child("desc");
  root.append_attribute("role") = "img";
  root.append_attribute("aria-labelledby") = (before + "title").c_str();
  pugi::xml_node words = root.prepend_child("title");
  words.append_attribute("id") = (before + "title").c_str();
  words.text() = std::string(title).c_str();
  std::ostringstream text;
  root.print(text, "", pugi::format_raw);
  return text.str();
}

}  // namespace veritrack::reports::page
