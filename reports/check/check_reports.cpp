#include "reports/check/check_reports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

namespace veritrack::reports {

namespace {

using rigor::Verdict;

bool is_open(const CheckedRequirement& requirement) {
  return requirement.verdict != Verdict::proved;
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

std::string junit_case(const std::string& path, const CheckedRequirement& requirement) {
  const std::string opening = fmt::format("    <testcase classname=\"{}\" name=\"{}\"", xml_escaped(path),
                                          xml_escaped(requirement.claim + ": " + requirement.requirement));
  if (!is_open(requirement)) {
    return opening + "/>\n";
  }
  return opening + fmt::format(">\n      <failure type=\"{}\" message=\"{}\"/>\n    </testcase>\n",
                               rigor::to_string(requirement.verdict), xml_escaped(requirement.reason));
}

/// A failure of the design, and not of the work on it.
bool is_failure(const CheckObjection& objection) {
  return objection.kind == CheckObjection::Kind::nothing_required;
}

std::string junit_error(const std::string& path, const CheckObjection& objection) {
  return fmt::format(
      "    <testcase classname=\"{}\" name=\"{}\">\n      <{} type=\"{}\" "
      "message=\"{}\"/>\n    </testcase>\n",
      xml_escaped(path), objection.kind == CheckObjection::Kind::cannot_write ? "report" : "design file",
      is_failure(objection) ? "failure" : "error", to_string(objection.kind), xml_escaped(objection.message));
}

using Json = nlohmann::ordered_json;

Json sarif_result(const std::string& rule, const std::string& message, const std::string& path,
                  certificates::Position position) {
  Json place{{"artifactLocation", {{"uri", uri_of(path)}}}};
  if (position.line > 0) {
    place["region"] = {{"startLine", position.line}, {"startColumn", position.column}};
  }
  return {{"ruleId", rule},
          {"level", "error"},
          {"message", {{"text", message}}},
          {"locations", Json::array({Json{{"physicalLocation", place}}})}};
}

std::string rule_of(CheckObjection::Kind kind) {
  switch (kind) {
    case CheckObjection::Kind::bad_input:
      return "a design file must be one that can be used";
    case CheckObjection::Kind::failure:
      return "a design must be one that can be worked on to the end";
    case CheckObjection::Kind::not_verified:
      return "the certificate of a design must be verified";
    case CheckObjection::Kind::nothing_required:
      return "a design must require something";
    case CheckObjection::Kind::cannot_write:
      return "a report must be one that can be written";
    case CheckObjection::Kind::time_limit:
      break;
  }
  return "a design must be decided within the time limit";
}

std::string sentence_of(const CheckedRequirement& requirement) {
  return fmt::format("{}: {}. {}", rigor::to_string(requirement.verdict), requirement.requirement,
                     requirement.reason);
}

/// Text of a workflow command; in its properties colons and commas are special, too.
std::string command_escaped(std::string_view text, bool is_property) {
  std::string result;
  for (const char letter : text) {
    const bool is_special = letter == '%' || letter == '\r' || letter == '\n' ||
                            (is_property && (letter == ':' || letter == ','));
    result +=
        is_special ? fmt::format("%{:02X}", static_cast<unsigned char>(letter)) : std::string(1, letter);
  }
  return result;
}

std::string annotation(const std::string& path, certificates::Position position, std::string_view title,
                       std::string_view message) {
  std::string text = "::error file=" + command_escaped(path, true);
  if (position.line > 0) {
    text += fmt::format(",line={},col={}", position.line, position.column);
  }
  return text + fmt::format(",title={}::{}\n", command_escaped(title, true), command_escaped(message, false));
}

Json checked_json(const CheckedDesign& design) {
  Json json{{"path", design.path}};
  Json requirements = Json::array();
  for (const CheckedRequirement& each : design.requirements) {
    requirements.push_back({{"claim", each.claim},
                            {"requirement", each.requirement},
                            {"verdict", rigor::to_string(each.verdict)},
                            {"reason", each.reason},
                            {"line", each.position.line},
                            {"column", each.position.column}});
  }
  if (design.objection) {
    json["error"] = {{"kind", to_string(design.objection->kind)},
                     {"message", design.objection->message},
                     {"line", design.objection->position.line},
                     {"column", design.objection->position.column}};
  }
  const CheckOutcome outcome = outcome_of(design);
  if (outcome != CheckOutcome::bad && !(design.objection && outcome == CheckOutcome::undecided)) {
    json["verdict"] = to_string(outcome);
    json["requirements"] = requirements;
  }
  if (design.verified) {
    json["verified"] = *design.verified;
  }
  return json;
}

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string uri_of(const std::string& path) {
  constexpr std::string_view kKept = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  // A colon is encoded, too, so that no first segment looks like a scheme.
  std::string uri;
  for (const char letter : path) {
    uri += kKept.find(letter) != std::string_view::npos
               ? std::string(1, letter)
               : fmt::format("%{:02X}", static_cast<unsigned char>(letter));
  }
  return uri;
}

std::string to_junit(const std::vector<CheckedDesign>& designs) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"veritrack check\">\n";
  for (const CheckedDesign& design : designs) {
    const std::ptrdiff_t objections = design.objection ? 1 : 0;
    const std::ptrdiff_t errors = design.objection && !is_failure(*design.objection) ? 1 : 0;
    const auto failures =
        std::count_if(design.requirements.begin(), design.requirements.end(), is_open) + objections - errors;
    text += fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\">\n",
        xml_escaped(design.path), design.requirements.size() + static_cast<std::size_t>(objections), failures,
        errors, design.seconds);
    if (design.verified) {
      text += fmt::format(
          "    <properties>\n      <property name=\"verified\" value=\"{}\"/>\n    </properties>\n",
          *design.verified);
    }
    text += design.objection ? junit_error(design.path, *design.objection) : "";
    for (const CheckedRequirement& requirement : design.requirements) {
      text += junit_case(design.path, requirement);
    }
    text += "  </testsuite>\n";
  }
  return text + "</testsuites>\n";
}

std::string to_sarif(const std::vector<CheckedDesign>& designs) {
  Json rules = Json::array();
  Json results = Json::array();
  std::set<std::string> known_rules;
  const auto add_rule = [&](const std::string& id, const std::string& description) {
    if (known_rules.insert(id).second) {
      rules.push_back({{"id", id}, {"shortDescription", {{"text", description}}}});
    }
  };
  for (const CheckedDesign& design : designs) {
    if (const auto& objection = design.objection) {
      add_rule(to_string(objection->kind), rule_of(objection->kind));
      results.push_back(
          sarif_result(to_string(objection->kind), objection->message, design.path, objection->position));
    }
    for (const CheckedRequirement& requirement : design.requirements) {
      if (is_open(requirement)) {
        add_rule(requirement.claim, "a requirement of the design file must be PROVED");
        results.push_back(
            sarif_result(requirement.claim, sentence_of(requirement), design.path, requirement.position));
      }
    }
  }
  const Json driver{{"name", "veritrack"}, {"version", VERITRACK_VERSION}, {"rules", rules}};
  return text_of({{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                  {"version", "2.1.0"},
                  {"runs", Json::array({Json{{"tool", {{"driver", driver}}}, {"results", results}}})}});
}

std::string to_check_json(const std::vector<CheckedDesign>& designs) {
  Json list = Json::array();
  for (const CheckedDesign& design : designs) {
    list.push_back(checked_json(design));
  }
  return text_of({{"schema", "veritrack/check/1"},
                  {"version", VERITRACK_VERSION},
                  {"exit_status", exit_status_of(designs)},
                  {"summary", summary_of(designs)},
                  {"designs", list}});
}

std::string to_annotations(const CheckedDesign& design) {
  std::string text;
  if (const auto& objection = design.objection) {
    text += annotation(design.path, objection->position, to_string(objection->kind), objection->message);
  }
  for (const CheckedRequirement& requirement : design.requirements) {
    if (is_open(requirement)) {
      text += annotation(design.path, requirement.position, rigor::to_string(requirement.verdict),
                         fmt::format("{}. {}", requirement.requirement, requirement.reason));
    }
  }
  return text;
}

}  // namespace veritrack::reports
