#include "reports/check_reports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

namespace veritrack::reports {

namespace {

using certificates::Claim;
using rigor::Verdict;

constexpr const char* kBadInput = "bad-input";

std::vector<Claim> required_claims(const CheckedDesign& design) {
  std::vector<Claim> claims;
  if (design.certificate) {
    std::copy_if(design.certificate->claims.begin(), design.certificate->claims.end(),
                 std::back_inserter(claims), [](const Claim& claim) { return claim.required; });
  }
  return claims;
}

/// Text for an XML attribute. Control characters, which XML cannot hold, become question marks.
std::string xml_escaped(std::string_view text) {
  std::string result;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += static_cast<unsigned char>(letter) < 0x20 ? '?' : letter;
    }
  }
  return result;
}

std::string junit_case(const std::string& path, const Claim& claim) {
  const std::string opening = fmt::format("    <testcase classname=\"{}\" name=\"{}\"", xml_escaped(path),
                                          xml_escaped(claim.id + ": " + claim.requirement));
  if (claim.verdict == Verdict::proved) {
    return opening + "/>\n";
  }
  return opening + fmt::format(">\n      <failure type=\"{}\" message=\"{}\"/>\n    </testcase>\n",
                               rigor::to_string(claim.verdict), xml_escaped(claim.reason));
}

std::string junit_error(const CheckedDesign& design) {
  return fmt::format(
      "    <testcase classname=\"{}\" name=\"design file\">\n      <error type=\"{}\" "
      "message=\"{}\"/>\n    </testcase>\n",
      xml_escaped(design.path), kBadInput, xml_escaped(design.error));
}

using Json = nlohmann::ordered_json;

Json sarif_result(const std::string& rule, const char* level, const std::string& message,
                  const std::string& path, certificates::Position position) {
  Json place{{"artifactLocation", {{"uri", path}}}};
  if (position.line > 0) {
    place["region"] = {{"startLine", position.line}, {"startColumn", position.column}};
  }
  return {{"ruleId", rule},
          {"level", level},
          {"message", {{"text", message}}},
          {"locations", Json::array({Json{{"physicalLocation", place}}})}};
}

}  // namespace

std::string to_junit(const std::vector<CheckedDesign>& designs) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"veritrack check\">\n";
  for (const CheckedDesign& design : designs) {
    const std::vector<Claim> claims = required_claims(design);
    const int errors = design.certificate ? 0 : 1;
    const auto failures = std::count_if(claims.begin(), claims.end(),
                                        [](const Claim& claim) { return claim.verdict != Verdict::proved; });
    text += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n",
                        xml_escaped(design.path), claims.size() + (errors > 0 ? 1 : 0), failures, errors);
    if (errors > 0) {
      text += junit_error(design);
    }
    for (const Claim& claim : claims) {
      text += junit_case(design.path, claim);
    }
    text += "  </testsuite>\n";
  }
  return text + "</testsuites>\n";
}

std::string to_sarif(const std::vector<CheckedDesign>& designs) {
  Json rules = Json::array();
  Json results = Json::array();
  std::set<std::string> known_rules;
  const auto add_rule = [&](const std::string& id, const char* description) {
    if (known_rules.insert(id).second) {
      rules.push_back({{"id", id}, {"shortDescription", {{"text", description}}}});
    }
  };
  for (const CheckedDesign& design : designs) {
    if (!design.certificate) {
      add_rule(kBadInput, "a design file must be one that can be used");
      results.push_back(sarif_result(kBadInput, "error", design.error, design.path, design.position));
    }
    for (const Claim& claim : required_claims(design)) {
      if (claim.verdict == Verdict::proved) {
        continue;
      }
      add_rule(claim.id, "a requirement of the design file must be PROVED");
      const std::string message =
          fmt::format("{}: {}. {}", rigor::to_string(claim.verdict), claim.requirement, claim.reason);
      results.push_back(sarif_result(claim.id, claim.verdict == Verdict::refuted ? "error" : "warning",
                                     message, design.path, claim.position));
    }
  }
  const Json driver{{"name", "veritrack"}, {"version", VERITRACK_VERSION}, {"rules", rules}};
  const Json report{{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                    {"version", "2.1.0"},
                    {"runs", Json::array({Json{{"tool", {{"driver", driver}}}, {"results", results}}})}};
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace veritrack::reports
