#include "certificates/document/report_json.hpp"

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/versions.hpp"
#include "certificates/document/number_json.hpp"
#include "certificates/document/tracker_kind.hpp"

namespace veritrack::certificates {

namespace {

Json told_quantities_json(const std::vector<theorems::Quantity>& quantities, Json& not_applicable) {
  Json json = Json::object();
  for (const theorems::Quantity& quantity : quantities) {
    if (quantity.not_applicable) {
      not_applicable[quantity.name] = {{"symbol", quantity.symbol},
                                       {"formula", quantity.formula},
                                       {"source", quantity.source},
                                       {"reason", *quantity.not_applicable}};
      continue;
    }
    Json entry = readable_enclosure_json(quantity.value);
    entry["symbol"] = quantity.symbol;
    entry["formula"] = quantity.formula;
    entry["source"] = quantity.source;
    if (!quantity.is_proved()) {
      entry["proved"] = false;
    }
    json[quantity.name] = entry;
  }
  return json;
}

Json told_condition_json(const theorems::Condition& condition) {
  Json json{{"id", condition.id},
            {"statement", condition.statement},
            {"verdict", std::string(rigor::to_string(condition.verdict))},
            {"reason", condition.reason}};
  if (!rigor::is_empty(condition.lhs)) {
    json["lhs"] = readable_enclosure_json(condition.lhs);
  }
  if (!rigor::is_empty(condition.rhs)) {
    json["rhs"] = readable_enclosure_json(condition.rhs);
  }
  return json;
}

Json told_feasibility_json(const theorems::Feasibility& feasibility) {
  Json not_applicable = Json::object();
  Json json{{"verdict", std::string(rigor::to_string(feasibility.verdict))},
            {"argument", feasibility.argument},
            {"every_design", feasibility.every_design}};
  if (feasibility.lower_bound) {
    json["lower_bound"] = readable_enclosure_json(*feasibility.lower_bound);
  }
  if (!feasibility.witness.empty()) {
    json["witness"] = told_quantities_json(feasibility.witness, not_applicable);
  }
  if (!feasibility.best_found.empty()) {
    json["best_found"] = told_quantities_json(feasibility.best_found, not_applicable);
  }
  return json;
}

Json told_derivation_json(const theorems::Derivation& derivation) {
  Json not_applicable = Json::object();
  Json json{{"id", derivation.id}, {"title", derivation.title}};
  json["quantities"] = told_quantities_json(derivation.quantities, not_applicable);
  if (!not_applicable.empty()) {
    json["not_applicable"] = not_applicable;
  }
  json["conditions"] = Json::array();
  for (const theorems::Condition& condition : derivation.conditions) {
    json["conditions"].push_back(told_condition_json(condition));
  }
  json["verdict"] = std::string(rigor::to_string(derivation.verdict));
  if (derivation.feasibility) {
    json["feasibility"] = told_feasibility_json(*derivation.feasibility);
  }
  json["notes"] = derivation.notes;
  return json;
}

Json told_claim_json(const Claim& claim) {
  Json not_applicable = Json::object();
  return {{"id", claim.id},
          {"statement", claim.statement},
          {"requirement", claim.requirement},
          {"verdict", std::string(rigor::to_string(claim.verdict))},
          {"required", claim.required},
          {"reason", claim.reason},
          {"evidence", told_quantities_json(claim.evidence, not_applicable)}};
}

Json formal_proofs_json(const FormalProofs& proofs) {
  Json json{{"file", kFormalProofFile}, {"proofs", Json::array()}};
  for (const FormalProof& proof : proofs.proofs) {
    json["proofs"].push_back({{"lemma", proof.lemma}, {"of", proof.of}, {"statement", proof.statement}});
  }
  if (!proofs.left_out.empty()) {
    json["left_out"] = proofs.left_out;
  }
  return json;
}

}  // namespace

std::string to_report_json(const Certificate& certificate) {
  const TrackerKind& kind = kind_of(certificate.design);
  Json json{{"schema", "veritrack/report/1"},
            {"program", "veritrack " VERITRACK_VERSION},
            {"design_file", certificate.design_file}};
  json["derivations"] = Json::array();
  for (const theorems::Derivation& derivation : certificate.derivations) {
    json["derivations"].push_back(told_derivation_json(derivation));
  }
  if (kind.report_json != nullptr) {
    json.update(kind.report_json(certificate));
  }
  json["claims"] = Json::array();
  for (const Claim& claim : certificate.claims) {
    json["claims"].push_back(told_claim_json(claim));
  }
  if (certificate.formal_proofs) {
    json["formal_proofs"] = formal_proofs_json(*certificate.formal_proofs);
  }
  if (certificate.deadline.has_struck()) {
    json["stopped_by_time_limit"] = true;
  }
  json["verdict"] = verdict_text(certificate);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace veritrack::certificates
