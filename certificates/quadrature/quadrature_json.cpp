#include "certificates/quadrature/quadrature_json.hpp"

#include "analysis/rigor/decimal.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"
#include "certificates/sets/assumptions_json.hpp"

namespace veritrack::certificates {

namespace {

Json audit_point_json(const theorems::AuditPoint& point) {
  Json json{{"step", point.step},
            {"verdict", std::string(rigor::to_string(point.verdict))},
            {"margin", readable_enclosure_json(point.margin)}};
  if (!rigor::is_empty(point.relative_margin)) {
    json["relative_margin"] = readable_enclosure_json(point.relative_margin);
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
    json["initial_frequency_error"] = readable_enclosure_json(*row.frequency_error);
  }
  if (row.noise) {
    json["noise"] = readable_enclosure_json(*row.noise);
  }
  if (row.rate) {
    json["rate"] = readable_enclosure_json(*row.rate);
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

/// A metric, a covariance: [[a, 0, 0], [0, b, c], [0, d, e]].
Json block_json(double a, double b, double c, double d, double e) {
  Eigen::Matrix3d matrix;
  matrix << a, 0.0, 0.0, 0.0, b, c, 0.0, d, e;
  return matrix_json(matrix);
}

Json metric_json(const quadrature::BlockMetric<double>& t) {
  return block_json(t.amplitude, t.phase, t.coupling, 0.0, t.frequency);
}

Json vector_json(const std::array<double, 3>& vector) {
  Json json = Json::array();
  for (const double entry : vector) {
    json.push_back(rigor::to_hexadecimal(entry));
  }
  return json;
}

Json mean_square_json(const quadrature::LockMeanSquare& form, bool leaks) {
  Json json{{"metric", metric_json(form.metric)},
            {"weight", rigor::to_hexadecimal(form.weight)},
            {"share", rigor::to_hexadecimal(form.share)},
            {"rate", rigor::to_hexadecimal(form.rate)},
            {"bound", rigor::to_hexadecimal(form.bound)}};
  if (leaks) {
    json["offset"] = vector_json(form.offset);
  }
  return json;
}

Json lock_set_json(const quadrature::LockSet& set, bool leaks) {
  const auto covariance = [](const quadrature::LevelCovariance<double>& p) {
    Eigen::Matrix3d matrix;
    matrix << p.p11, p.p12, p.p13, p.p12, p.p22, p.p23, p.p13, p.p23, p.p33;
    return matrix_json(matrix);
  };
  Json json{{"metric", metric_json(set.metric)},
            {"centre", covariance(set.centre)},
            {"spread_above", covariance(set.spread_above)},
            {"spread_below", covariance(set.spread_below)},
            {"weight", rigor::to_hexadecimal(set.weight)},
            {"level", rigor::to_hexadecimal(set.level)},
            {"decay", rigor::to_hexadecimal(set.decay)},
            {"drift", rigor::to_hexadecimal(set.drift)},
            {"noise_deviation", rigor::to_hexadecimal(set.noise_deviation)},
            {"frequency_walk", rigor::to_hexadecimal(set.frequency_walk)}};
  if (leaks) {
    json["bias"] = vector_json(set.bias);
    json["frequencies"] = Json::array(
        {rigor::to_hexadecimal(set.lowest_frequency), rigor::to_hexadecimal(set.highest_frequency)});
  }
  return json;
}

}  // namespace

Json quadrature_design_json(const Design& read) {
  const auto& [design, assume, require, simulate, theorem] = quadrature_tables(read);
  return {{"design",
           {{"q1", number_json(design.q1)},
            {"q2", number_json(design.q2)},
            {"r", number_json(design.r)},
            {"epsilon", number_json(design.epsilon)}}},
          {"assume", assume_json(assume)},
          {"require", require_json(require)},
          {"theorem_2_9",
           {{"R_x", number_json(theorem.state_bound)},
            {"sigma", number_json(theorem.sigma)},
            {"gamma_fraction", number_json(theorem.gamma_fraction)},
            {"c1", number_json(theorem.c1)},
            {"c2", number_json(theorem.c2)}}}};
}

Json quadrature_evidence_json(const Certificate& certificate) {
  Json sets = Json::array();
  for (const NamedSet& set : quadrature_particulars(certificate).certified_sets) {
    sets.push_back(certified_set_json(set));
  }
  Json json{{"certified_sets", sets}};
  const bool leaks = !quadrature_tables(certificate.design).design.without_leak();
  for (const quadrature::LockSet& set : quadrature_particulars(certificate).lock_sets) {
    json["lock_sets"].push_back(lock_set_json(set, leaks));
  }
  const auto& mean_squares = quadrature_particulars(certificate).lock_mean_squares;
  for (std::size_t k = 0; k < mean_squares.size(); ++k) {
    json["lock_sets"][k]["mean_square"] = mean_square_json(mean_squares[k], leaks);
  }
  if (const auto& set = quadrature_particulars(certificate).lowest_snr_set) {
    json["lowest_snr_set"] = lock_set_json(*set, false);
  }
  return json;
}

Json quadrature_report_json(const Certificate& certificate) {
  const QuadratureParticulars& particulars = quadrature_particulars(certificate);
  Json json{{"simulate", simulate_json(quadrature_tables(certificate.design).simulate)},
            {"audits", Json::array()},
            {"comparison", Json::array()}};
  for (const AuditedDerivation& audited : particulars.audits) {
    json["audits"].push_back(audit_json(audited));
  }
  for (const ComparedResult& row : particulars.comparison) {
    json["comparison"].push_back(compared_json(row));
  }
  return json;
}

}  // namespace veritrack::certificates
