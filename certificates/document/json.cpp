#include "certificates/document/json.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/rigor/decimal.hpp"
#include "certificates/document/number_json.hpp"
#include "certificates/document/sha256.hpp"
#include "certificates/document/tracker_kind.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Verdict;
using theorems::Sense;

/// The statement on a value: lo, hi, or both.
Json value_json(const rigor::Interval& value, Sense sense) {
  Json json = enclosure_json(value);
  if (sense == Sense::at_most || !std::isfinite(value.lower())) {
    json.erase("lo");
  }
  if (sense == Sense::at_least || !std::isfinite(value.upper())) {
    json.erase("hi");
  }
  return json;
}

Json quantities_json(const std::vector<theorems::Quantity>& quantities) {
  Json json = Json::object();
  for (const theorems::Quantity& quantity : quantities) {
    const Json value = value_json(quantity.value, quantity.sense);
    if (quantity.applies() && quantity.is_proved() && !value.empty()) {
      json[quantity.name] = value;
    }
  }
  return json;
}

Json condition_json(const theorems::Condition& condition) {
  Json json{{"id", condition.id}, {"verdict", std::string(rigor::to_string(condition.verdict))}};
  if (!rigor::is_empty(condition.lhs)) {
    json["lhs"] = value_json(condition.lhs, condition.lhs_sense);
  }
  if (!rigor::is_empty(condition.rhs)) {
    json["rhs"] = value_json(condition.rhs, Sense::enclosure);
  }
  return json;
}

Json feasibility_json(const theorems::Feasibility& feasibility) {
  Json json{{"verdict", std::string(rigor::to_string(feasibility.verdict))},
            {"every_design", feasibility.every_design}};
  if (feasibility.lower_bound) {
    json["lower_bound"] = enclosure_json(*feasibility.lower_bound);
  }
  if (!feasibility.witness.empty()) {
    json["witness"] = quantities_json(feasibility.witness);
  }
  return json;
}

Json evidence_json(const theorems::Evidence& evidence) {
  Json json{{"name", evidence.name}};
  for (const auto& [name, number] : evidence.numbers) {
    json["numbers"][name] = rigor::to_hexadecimal(number);
  }
  for (const auto& [name, matrix] : evidence.matrices) {
    json["matrices"][name] = matrix_json(matrix);
  }
  for (const auto& [name, text] : evidence.decimals) {
    json["decimals"][name] = text;
  }
  return json;
}

Json derivation_json(const theorems::Derivation& derivation) {
  Json json{{"id", derivation.id},
            {"quantities", quantities_json(derivation.quantities)},
            {"conditions", Json::array()}};
  for (const theorems::Condition& condition : derivation.conditions) {
    if (condition.verdict != Verdict::undecided) {
      json["conditions"].push_back(condition_json(condition));
    }
  }
  if (derivation.verdict != Verdict::undecided) {
    json["verdict"] = std::string(rigor::to_string(derivation.verdict));
  }
  if (derivation.feasibility && derivation.feasibility->verdict != Verdict::undecided) {
    json["feasibility"] = feasibility_json(*derivation.feasibility);
  }
  for (const theorems::Evidence& evidence : derivation.evidence) {
    json["evidence"].push_back(evidence_json(evidence));
  }
  return json;
}

bool says_something(const theorems::Derivation& derivation) {
  const auto proved = [](const theorems::Quantity& quantity) {
    return quantity.applies() && quantity.is_proved();
  };
  const auto decided = [](const theorems::Condition& condition) {
    return condition.verdict != Verdict::undecided;
  };
  return std::any_of(derivation.quantities.begin(), derivation.quantities.end(), proved) ||
         std::any_of(derivation.conditions.begin(), derivation.conditions.end(), decided);
}

Json claim_json(const Claim& claim) {
  Json json{{"id", claim.id},
            {"verdict", std::string(rigor::to_string(claim.verdict))},
            {"required", claim.required},
            {"evidence", quantities_json(claim.evidence)}};
  for (const auto& [name, value] : claim.values) {
    json[name] = value;
  }
  return json;
}

/// Adds the proved and refuted statements, and the evidence, to those on the design.
void add_findings(Json& json, const Certificate& certificate) {
  const TrackerKind& kind = kind_of(certificate.design);
  json["derivations"] = Json::array();
  json["claims"] = Json::array();
  json["verdict"] = verdict_text(certificate);
  for (const theorems::Derivation& derivation : certificate.derivations) {
    if (says_something(derivation)) {
      json["derivations"].push_back(derivation_json(derivation));
    }
  }
  if (kind.evidence_json != nullptr) {
    json.update(kind.evidence_json(certificate));
  }
  for (const Claim& claim : certificate.claims) {
    if (claim.verdict != Verdict::undecided) {
      json["claims"].push_back(claim_json(claim));
    }
  }
}

}  // namespace

Json inner_certificate_json(const Certificate& certificate) {
  Json json;
  // Every number of the design with its text and its enclosure.
  json["design"] = {{"tracker", certificate.design.tracker}};
  json["design"].update(kind_of(certificate.design).design_json(certificate.design));
  add_findings(json, certificate);
  return json;
}

std::string to_json(const Certificate& certificate) {
  const Design& design = certificate.design;
  Json json{{"schema", "veritrack/certificate/2"}, {"design_sha256", sha256(certificate.design_text)}};
  json["design"] = {{"name", design.name}, {"tracker", design.tracker}, {"source", design.source}};
  json["design"].update(kind_of(design).design_json(design));
  add_findings(json, certificate);
  // A design's name need not be UTF-8; JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace veritrack::certificates
