#include "certificates/document/design_json.hpp"

#include <variant>

#include "analysis/rigor/decimal.hpp"

namespace veritrack::certificates {

namespace {

using Json = nlohmann::ordered_json;

Json number(const Number& value) {
  Json json{{"text", value.text}};
  json.update(enclosure_json(value.value));
  if (value.position.line > 0) {
    json["line"] = value.position.line;
  } else {
    json["default"] = true;
  }
  return json;
}

Json initial_covariance(const std::optional<CovarianceArray>& covariance) {
  if (!covariance) {
    return "steady-state";
  }
  Json rows = Json::array();
  for (const auto& row : *covariance) {
    Json entries = Json::array();
    for (const Number& entry : row) {
      entries.push_back(number(entry));
    }
    rows.push_back(entries);
  }
  return rows;
}

void add(Json& json, const char* name, const std::optional<Number>& value) {
  if (value) {
    json[name] = number(*value);
  }
}

Json require_json(const Requirements& require) {
  Json json = Json::object();
  add(json, "frequency_error_below", require.frequency_error_below);
  add(json, "settles_within", require.settles_within);
  add(json, "largest_noise_at_least", require.largest_noise_at_least);
  add(json, "largest_slew_at_least", require.largest_slew_at_least);
  add(json, "frequency_error_radius_at_least", require.frequency_error_radius_at_least);
  return json;
}

Json assume_json(const Assumptions& assume) {
  return {{"amplitude", number(assume.amplitude)},
          {"frequency", {number(assume.frequency[0]), number(assume.frequency[1])}},
          {"noise", number(assume.noise)},
          {"slew", number(assume.slew)},
          {"initial_frequency_error", number(assume.initial_frequency_error)},
          {"initial_phase_error", number(assume.initial_phase_error)},
          {"initial_amplitude_error", number(assume.initial_amplitude_error)},
          {"initial_covariance", initial_covariance(assume.initial_covariance)}};
}

Json simulate_json(const SimulationSettings& simulate) {
  return {{"samples", simulate.samples}, {"seed", simulate.seed}, {"signal", simulate.signal}};
}

Json tables_json(const QuadratureEkfTables& tables) {
  const auto& [design, assume, require, simulate, theorem] = tables;
  return {{"design",
           {{"q1", number(design.q1)},
            {"q2", number(design.q2)},
            {"r", number(design.r)},
            {"epsilon", number(design.epsilon)}}},
          {"assume", assume_json(assume)},
          {"require", require_json(require)},
          {"simulate", simulate_json(simulate)},
          {"theorem_2_9",
           {{"R_x", number(theorem.state_bound)},
            {"sigma", number(theorem.sigma)},
            {"gamma_fraction", number(theorem.gamma_fraction)},
            {"c1", number(theorem.c1)},
            {"c2", number(theorem.c2)}}}};
}

Json tables_json(const KklObserverTables& tables) {
  const auto& [design, assume, require] = tables;
  Json rates = Json::array();
  for (const Number& rate : design.lambda) {
    rates.push_back(number(rate));
  }
  Json chosen{{"lambda", rates}};
  add(chosen, "ell", design.ell);
  Json assumed{{"frequency", {number(assume.frequency[0]), number(assume.frequency[1])}},
               {"amplitude", {number(assume.amplitude[0]), number(assume.amplitude[1])}}};
  if (assume.disturbance) {
    Json disturbance = Json::object();
    add(disturbance, "bound", assume.disturbance->bound);
    add(disturbance, "amplitude", assume.disturbance->amplitude);
    add(disturbance, "frequency", assume.disturbance->frequency);
    assumed["disturbance"] = disturbance;
  }
  Json required = Json::object();
  add(required, "frequency_error_below", require.frequency_error_below);
  add(required, "amplitude_error_below", require.amplitude_error_below);
  add(required, "settles_within", require.settles_within);
  return {{"design", chosen}, {"assume", assumed}, {"require", required}};
}

Json tables_json(const SingleChannelEkfTables& tables) {
  const auto& [design, assume, require, simulate] = tables;
  Json chosen = Json::object();
  add(chosen, "q", design.q);
  add(chosen, "r", design.r);
  add(chosen, "lambda", design.lambda);
  chosen["epsilon"] = number(design.epsilon);
  if (design.variances) {
    chosen["process_noise"] = {{"q1", number((*design.variances)[0])},
                               {"q2", number((*design.variances)[1])}};
  } else {
    chosen["process_noise"] = design.process_noise == SingleChannelEkfDesign::ProcessNoise::identity
                                  ? "identity"
                                  : "frequency-only";
  }
  return {{"design", chosen},
          {"assume", assume_json(assume)},
          {"require", require_json(require)},
          {"simulate", simulate_json(simulate)}};
}

}  // namespace

Json enclosure_json(const rigor::Interval& value) {
  return {{"lo", rigor::to_hexadecimal(value.lower())},
          {"hi", rigor::to_hexadecimal(value.upper())},
          {"decimal", rigor::to_decimal(value)}};
}

Json design_json(const Certificate& certificate) {
  const Design& design = certificate.design;
  Json json{{"file", certificate.design_file},
            {"name", design.name},
            {"tracker", design.tracker},
            {"source", design.source}};
  json.update(std::visit([](const auto& tables) { return tables_json(tables); }, design.tables));
  return json;
}

}  // namespace veritrack::certificates
