#include "certificates/document/json.hpp"

#include "analysis/rigor/decimal.hpp"
#include "certificates/document/number_json.hpp"
#include "certificates/document/tracker_kind.hpp"

namespace veritrack::certificates {

namespace {

Json quantities_json(const std::vector<theorems::Quantity>& quantities, Json& not_applicable) {
  Json json = Json::object();
  for (const theorems::Quantity& quantity : quantities) {
    if (quantity.not_applicable) {
      not_applicable[quantity.name] = {{"symbol", quantity.symbol},
                                       {"formula", quantity.formula},
                                       {"source", quantity.source},
                                       {"reason", *quantity.not_applicable}};
      continue;
    }
    Json entry = enclosure_json(quantity.value);
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

Json condition_json(const theorems::Condition& condition) {
  Json json{{"id", condition.id},
            {"statement", condition.statement},
            {"verdict", std::string(rigor::to_string(condition.verdict))},
            {"reason", condition.reason}};
  if (!rigor::is_empty(condition.lhs)) {
    json["lhs"] = enclosure_json(condition.lhs);
  }
  if (!rigor::is_empty(condition.rhs)) {
    json["rhs"] = enclosure_json(condition.rhs);
  }
  return json;
}

Json feasibility_json(const theorems::Feasibility& feasibility) {
  Json not_applicable = Json::object();
  Json json{{"verdict", std::string(rigor::to_string(feasibility.verdict))},
            {"argument", feasibility.argument},
            {"every_design", feasibility.every_design}};
  if (feasibility.lower_bound) {
    json["lower_bound"] = enclosure_json(*feasibility.lower_bound);
  }
  if (!feasibility.witness.empty()) {
    json["witness"] = quantities_json(feasibility.witness, not_applicable);
  }
  if (!feasibility.best_found.empty()) {
    json["best_found"] = quantities_json(feasibility.best_found, not_applicable);
  }
  return json;
}

Json evidence_json(const theorems::Evidence& evidence) {
  Json json{{"name", evidence.name}, {"numbers", Json::object()}, {"matrices", Json::object()}};
  for (const auto& [name, number] : evidence.numbers) {
    json["numbers"][name] = rigor::to_hexadecimal(number);
  }
  for (const auto& [name, matrix] : evidence.matrices) {
    json["matrices"][name] = matrix_json(matrix);
  }
  return json;
}

Json derivation_json(const theorems::Derivation& derivation) {
  Json not_applicable = Json::object();
  Json json{{"id", derivation.id}, {"title", derivation.title}};
  json["quantities"] = quantities_json(derivation.quantities, not_applicable);
  if (!not_applicable.empty()) {
    json["not_applicable"] = not_applicable;
  }
  json["conditions"] = Json::array();
  for (const theorems::Condition& condition : derivation.conditions) {
    json["conditions"].push_back(condition_json(condition));
  }
  json["verdict"] = std::string(rigor::to_string(derivation.verdict));
  if (derivation.feasibility) {
    json["feasibility"] = feasibility_json(*derivation.feasibility);
  }
  for (const theorems::Evidence& evidence : derivation.evidence) {
    json["evidence"].push_back(evidence_json(evidence));
  }
  json["notes"] = derivation.notes;
  return json;
}

Json claim_json(const Claim& claim) {
  Json not_applicable = Json::object();
  return {{"id", claim.id},
          {"statement", claim.statement},
          {"verdict", std::string(rigor::to_string(claim.verdict))},
          {"required", claim.required},
          {"reason", claim.reason},
          {"evidence", quantities_json(claim.evidence, not_applicable)}};
}

Json formal_proofs_json(const FormalProofs& proofs) {
  Json json{{"file", kFormalProofFile}, {"proofs", Json::array()}};
  for (const FormalProof& proof : proofs.proofs) {
    json["proofs"].push_back({{"lemma", proof.lemma}, {"of", proof.of}, {"statement", proof.statement}});
  }
  return json;
}

/// The design as read, every number with its text, its enclosure and its line.
Json design_json(const Certificate& certificate, const TrackerKind& kind) {
  const Design& design = certificate.design;
  Json json{{"file", certificate.design_file},
            {"name", design.name},
            {"tracker", design.tracker},
            {"source", design.source}};
  json.update(kind.design_json(design));
  return json;
}

}  // namespace

std::string to_json(const Certificate& certificate) {
  const TrackerKind& kind = kind_of(certificate.design);
  Json json{{"schema", "veritrack/certificate/1"}, {"design", design_json(certificate, kind)}};
  json["derivations"] = Json::array();
  for (const theorems::Derivation& derivation : certificate.derivations) {
    json["derivations"].push_back(derivation_json(derivation));
  }
  // Every certificate has these members; a kind of tracker that has nothing to put there leaves them empty.
  Json evidence{{"certified_sets", Json::array()}, {"audits", Json::array()}, {"comparison", Json::array()}};
  if (kind.evidence_json != nullptr) {
    evidence.update(kind.evidence_json(certificate));
  }
  json.update(evidence);
  json["claims"] = Json::array();
  for (const Claim& claim : certificate.claims) {
    json["claims"].push_back(claim_json(claim));
  }
  if (certificate.formal_proofs) {
    json["formal_proofs"] = formal_proofs_json(*certificate.formal_proofs);
  }
  json["verdict"] = verdict_text(certificate);
  // A file name need not be UTF-8; JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace veritrack::certificates
