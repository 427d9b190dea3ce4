#include "certificates/code/harness/tree_nodes.hpp"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>

namespace veritrack::certificates::code {

std::string type_of_node(const nlohmann::json& node) {
  const auto type = node.find("type");
  if (type == node.end()) {
    return {};
  }
  const std::string spelled = type->value("qualType", "");
  const std::string plain = type->value("desugaredQualType", spelled);
  // A typedef of an array or a function says less when it is written out.
  std::string result =
      plain.find("(*)") == std::string::npos && plain.find('[') == std::string::npos ? plain : spelled;
  constexpr std::string_view kNoName = "(anonymous namespace)::";
  for (std::size_t at = 0; (at = result.find(kNoName)) != std::string::npos;) {
    result.erase(at, kNoName.size());
  }
  return result;
}

DeclarationPlace place_of_node(const nlohmann::json& node) {
  const auto loc = node.find("loc");
  if (loc == node.end()) {
    return {};
  }
  const nlohmann::json& place = loc->contains("expansionLoc") ? loc->at("expansionLoc") : *loc;
  return {place.value("file", ""), place.value("line", 0), place.value("col", 0)};
}

}  // namespace veritrack::certificates::code
