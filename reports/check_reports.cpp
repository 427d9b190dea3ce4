#include "reports/check_reports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

namespace veritrack::reports {

namespace {

using certificates::Claim;
using rigor::Verdict;

std::vector<Claim> required_claims(const certificates::Certificate& certificate) {
  std::vector<Claim> claims;
  std::copy_if(certificate.claims.begin(), certificate.claims.end(), std::back_inserter(claims),
               [](const Claim& claim) { return claim.required; });
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

}  // namespace

std::string to_junit(const std::vector<CheckedDesign>& designs) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"veritrack check\">\n";
  for (const CheckedDesign& design : designs) {
    const std::vector<Claim> claims = required_claims(design.certificate);
    const auto failures = std::count_if(claims.begin(), claims.end(),
                                        [](const Claim& claim) { return claim.verdict != Verdict::proved; });
    text += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\">\n", xml_escaped(design.path),
                        claims.size(), failures);
    for (const Claim& claim : claims) {
      text += junit_case(design.path, claim);
    }
    text += "  </testsuite>\n";
  }
  return text + "</testsuites>\n";
}

std::string to_sarif(const std::vector<CheckedDesign>& designs) {
  using Json = nlohmann::ordered_json;
  Json rules = Json::array();
  Json results = Json::array();
  std::vector<std::string> known_rules;
  for (const CheckedDesign& design : designs) {
    for (const Claim& claim : required_claims(design.certificate)) {
      if (claim.verdict == Verdict::proved) {
        continue;
      }
      if (std::find(known_rules.begin(), known_rules.end(), claim.id) == known_rules.end()) {
        known_rules.push_back(claim.id);
        rules.push_back(
            {{"id", claim.id},
             {"shortDescription", {{"text", "a requirement of the design file must be PROVED"}}}});
      }
      const std::string message =
          fmt::format("{}: {}. {}", rigor::to_string(claim.verdict), claim.requirement, claim.reason);
      const Json region{{"startLine", claim.position.line}, {"startColumn", claim.position.column}};
      const Json location{
          {"physicalLocation", {{"artifactLocation", {{"uri", design.path}}}, {"region", region}}}};
      results.push_back({{"ruleId", claim.id},
                         {"level", claim.verdict == Verdict::refuted ? "error" : "warning"},
                         {"message", {{"text", message}}},
                         {"locations", Json::array({location})}});
    }
  }
  const Json driver{{"name", "veritrack"}, {"version", VERITRACK_VERSION}, {"rules", rules}};
  const Json report{{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                    {"version", "2.1.0"},
                    {"runs", Json::array({Json{{"tool", {{"driver", driver}}}, {"results", results}}})}};
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace veritrack::reports
