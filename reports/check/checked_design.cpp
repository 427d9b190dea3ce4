#include "reports/check/checked_design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace veritrack::reports {

namespace {

using certificates::Position;
using rigor::Verdict;
using Json = nlohmann::ordered_json;
using Kind = CheckObjection::Kind;

constexpr std::array kKinds{Kind::bad_input,    Kind::failure,          Kind::time_limit,
                            Kind::not_verified, Kind::nothing_required, Kind::cannot_write};
constexpr std::array kOutcomes{CheckOutcome::proved, CheckOutcome::refuted, CheckOutcome::undecided,
                               CheckOutcome::nothing_required, CheckOutcome::bad};
constexpr std::array kVerdicts{Verdict::proved, Verdict::refuted, Verdict::undecided};

Json position_json(const Position& position) {
  return {{"line", position.line}, {"column", position.column}};
}

Position position_from(const Json& json) {
  return {json.at("line").get<int>(), json.at("column").get<int>()};
}

/// The one of this name. Throws std::out_of_range.
template <typename Values>
auto named(const Values& values, const std::string& name) {
  for (const auto value : values) {
    if (to_string(value) == name) {
      return value;
    }
  }
  throw std::out_of_range(name);
}

}  // namespace

std::vector<CheckedRequirement> requirements_of(const certificates::Certificate& certificate) {
  std::vector<CheckedRequirement> requirements;
  for (const certificates::Claim& claim : certificate.claims) {
    if (claim.required) {
      requirements.push_back({claim.id, claim.requirement, claim.reason, claim.verdict, claim.position});
    }
  }
  return requirements;
}

void note_verification(CheckedDesign& design, const std::string& refusal) {
  design.verified = refusal.empty();
  if (refusal.empty()) {
    return;
  }
  for (CheckedRequirement& requirement : design.requirements) {
    requirement.reason = "not verified: " + refusal;
    requirement.verdict = Verdict::undecided;
  }
  if (design.requirements.empty()) {
    design.objection = CheckObjection{Kind::not_verified, refusal, {}};
  }
}

std::string to_string(CheckObjection::Kind kind) {
  switch (kind) {
    case Kind::bad_input:
      return "bad-input";
    case Kind::failure:
      return "failure";
    case Kind::time_limit:
      return "time-limit";
    case Kind::not_verified:
      return "not-verified";
    case Kind::nothing_required:
      return "nothing-required";
    case Kind::cannot_write:
      break;
  }
  return "cannot-write";
}

std::string to_string(CheckOutcome outcome) {
  switch (outcome) {
    case CheckOutcome::proved:
      return "proved";
    case CheckOutcome::refuted:
      return "refuted";
    case CheckOutcome::undecided:
      return "undecided";
    case CheckOutcome::nothing_required:
      return "nothing-required";
    case CheckOutcome::bad:
      break;
  }
  return "bad";
}

CheckOutcome outcome_of(const CheckedDesign& design) {
  if (design.objection) {
    switch (design.objection->kind) {
      case Kind::time_limit:
      case Kind::not_verified:
        return CheckOutcome::undecided;
      case Kind::nothing_required:
        return CheckOutcome::nothing_required;
      default:
        return CheckOutcome::bad;
    }
  }
  if (design.requirements.empty()) {
    return CheckOutcome::nothing_required;
  }
  const auto has = [&](Verdict verdict) {
    return std::any_of(design.requirements.begin(), design.requirements.end(),
                       [&](const CheckedRequirement& each) { return each.verdict == verdict; });
  };
  return has(Verdict::refuted)     ? CheckOutcome::refuted
         : has(Verdict::undecided) ? CheckOutcome::undecided
                                   : CheckOutcome::proved;
}

bool is_final(const CheckedDesign& design) {
  return !design.objection &&
         (!design.cut_short ||
          std::none_of(design.requirements.begin(), design.requirements.end(),
                       [](const CheckedRequirement& each) { return each.verdict == Verdict::undecided; }));
}

int exit_status_of(const std::vector<CheckedDesign>& designs) {
  int status = 0;
  for (const CheckedDesign& design : designs) {
    const CheckOutcome outcome = outcome_of(design);
    const bool is_fine =
        outcome == CheckOutcome::proved || (outcome == CheckOutcome::nothing_required && !design.objection);
    status = std::max(status, outcome == CheckOutcome::bad ? 2 : is_fine ? 0 : 1);
  }
  return status;
}

std::string summary_of(const std::vector<CheckedDesign>& designs) {
  const auto is_report = [](const CheckedDesign& each) {
    return each.objection && each.objection->kind == Kind::cannot_write;
  };
  const auto reports = std::count_if(designs.begin(), designs.end(), is_report);
  const auto number = static_cast<std::ptrdiff_t>(designs.size()) - reports;
  std::string text = fmt::format("{} design{}", number, number == 1 ? "" : "s");
  const char* separator = ": ";
  for (const CheckOutcome outcome : kOutcomes) {
    const auto count = std::count_if(designs.begin(), designs.end(), [&](const CheckedDesign& each) {
      return !is_report(each) && outcome_of(each) == outcome;
    });
    if (count > 0) {
      text += fmt::format(
          "{}{} {}", separator, count,
          outcome == CheckOutcome::nothing_required ? "with nothing required" : to_string(outcome));
      separator = ", ";
    }
  }
  return reports == 0
             ? text
             : fmt::format("{}; {} report{} cannot be written", text, reports, reports == 1 ? "" : "s");
}

std::string to_text(const CheckedDesign& design) {
  Json json{{"requirements", Json::array()}, {"seconds", design.seconds}, {"cut_short", design.cut_short}};
  for (const CheckedRequirement& requirement : design.requirements) {
    json["requirements"].push_back({{"claim", requirement.claim},
                                    {"requirement", requirement.requirement},
                                    {"reason", requirement.reason},
                                    {"verdict", rigor::to_string(requirement.verdict)},
                                    {"position", position_json(requirement.position)}});
  }
  if (design.verified) {
    json["verified"] = *design.verified;
  }
  if (design.objection) {
    json["objection"] = {{"kind", to_string(design.objection->kind)},
                         {"message", design.objection->message},
                         {"position", position_json(design.objection->position)}};
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<CheckedDesign> checked_from_text(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    CheckedDesign design;
    design.seconds = json.at("seconds").get<double>();
    design.cut_short = json.at("cut_short").get<bool>();
    for (const Json& each : json.at("requirements")) {
      design.requirements.push_back(
          {each.at("claim").get<std::string>(), each.at("requirement").get<std::string>(),
           each.at("reason").get<std::string>(), named(kVerdicts, each.at("verdict").get<std::string>()),
           position_from(each.at("position"))});
    }
    if (json.contains("verified")) {
      design.verified = json.at("verified").get<bool>();
    }
    if (json.contains("objection")) {
      const Json& objection = json.at("objection");
      design.objection =
          CheckObjection{named(kKinds, objection.at("kind").get<std::string>()),
                         objection.at("message").get<std::string>(), position_from(objection.at("position"))};
    }
    return design;
  } catch (const Json::exception&) {
    return std::nullopt;
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
}

}  // namespace veritrack::reports
