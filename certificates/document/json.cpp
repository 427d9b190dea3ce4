#include "certificates/document/json.hpp"

#include <nlohmann/json.hpp>

#include "analysis/rigor/decimal.hpp"
#include "certificates/document/design_json.hpp"

namespace veritrack::certificates {

namespace {

using Json = nlohmann::ordered_json;

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

/// A matrix of exact doubles, row by row.
template <typename Matrix>
Json matrix_json(const Matrix& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      row.push_back(rigor::to_hexadecimal(matrix(i, j)));
    }
    rows.push_back(row);
  }
  return rows;
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

Json audit_point_json(const theorems::AuditPoint& point) {
  Json json{{"step", point.step},
            {"verdict", std::string(rigor::to_string(point.verdict))},
            {"margin", enclosure_json(point.margin)}};
  if (!rigor::is_empty(point.relative_margin)) {
    json["relative_margin"] = enclosure_json(point.relative_margin);
  }
  return json;
}

Json audited_json(const theorems::Audit& audit, const theorems::AuditedInequality& inequality) {
  Json json{{"id", inequality.id},
            {"statement", inequality.statement},
            {"source", inequality.source},
            {"kind", inequality.kind == theorems::AuditKind::assumption ? "assumption" : "claim"}};
  if (inequality.not_applicable) {
    json["not_applicable"] = *inequality.not_applicable;
    return json;
  }
  json["first_step"] = inequality.first_step;
  json["satisfied"] = inequality.satisfied;
  json["violated"] = inequality.violated;
  json["undecided"] = inequality.undecided;
  if (inequality.worst) {
    json["worst"] = audit_point_json(*inequality.worst);
  }
  if (inequality.first_violation) {
    json["first_violation"] = *inequality.first_violation;
  }
  if (inequality.before_first_step) {
    json["before_first_step"] = audit_point_json(*inequality.before_first_step);
  }
  json["refuted_by_this_run"] = audit.refutes(inequality);
  return json;
}

Json audit_json(const AuditedDerivation& audited) {
  Json json{{"derivation", audited.derivation},
            {"proved", false},
            {"steps_within_assumptions", audited.audit.steps_within_assumptions},
            {"inequalities", Json::array()}};
  for (const theorems::AuditedInequality& inequality : audited.audit.inequalities) {
    json["inequalities"].push_back(audited_json(audited.audit, inequality));
  }
  return json;
}

Json compared_json(const ComparedResult& row) {
  Json json{{"result", row.result}, {"proved", !row.simulated}};
  if (row.verdict) {
    json["verdict"] = std::string(rigor::to_string(*row.verdict));
  }
  if (row.frequency_error) {
    json["initial_frequency_error"] = enclosure_json(*row.frequency_error);
  }
  if (row.noise) {
    json["noise"] = enclosure_json(*row.noise);
  }
  if (row.rate) {
    json["rate"] = enclosure_json(*row.rate);
  }
  return json;
}

Json certified_set_json(const NamedSet& named) {
  const quadrature::CertifiedSet& set = named.set;
  return {{"purpose", named.purpose},
          {"metric", matrix_json(set.metric)},
          {"radius", rigor::to_hexadecimal(set.radius)},
          {"covariance_lower", matrix_json(set.covariance_lower)},
          {"covariance_upper", matrix_json(set.covariance_upper)},
          {"noise", rigor::to_hexadecimal(set.noise)},
          {"slew", rigor::to_hexadecimal(set.slew)},
          {"rate", rigor::to_hexadecimal(set.rate)},
          {"noise_gain", rigor::to_hexadecimal(set.noise_gain)},
          {"slew_gain", rigor::to_hexadecimal(set.slew_gain)}};
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

}  // namespace

std::string to_json(const Certificate& certificate) {
  Json json{{"schema", "veritrack/certificate/1"}, {"design", design_json(certificate)}};
  json["derivations"] = Json::array();
  for (const theorems::Derivation& derivation : certificate.derivations) {
    json["derivations"].push_back(derivation_json(derivation));
  }
  json["certified_sets"] = Json::array();
  for (const NamedSet& set : certificate.certified_sets) {
    json["certified_sets"].push_back(certified_set_json(set));
  }
  json["audits"] = Json::array();
  for (const AuditedDerivation& audited : certificate.audits) {
    json["audits"].push_back(audit_json(audited));
  }
  json["comparison"] = Json::array();
  for (const ComparedResult& row : certificate.comparison) {
    json["comparison"].push_back(compared_json(row));
  }
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
