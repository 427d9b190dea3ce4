#include "certificates/sets/assumptions_json.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

namespace {

Json rows_json(const CovarianceArray& covariance) {
  Json rows = Json::array();
  for (const auto& row : covariance) {
    Json entries = Json::array();
    for (const Number& entry : row) {
      entries.push_back(number_json(entry));
    }
    rows.push_back(entries);
  }
  return rows;
}

Json initial_covariance(const Assumptions& assume) {
  if (const auto& range = assume.covariance_range) {
    return {{"from", rows_json((*range)[0])}, {"to", rows_json((*range)[1])}};
  }
  if (const auto& multiples = assume.covariance_multiples) {
    return {{"from", number_json((*multiples)[0])}, {"to", number_json((*multiples)[1])}};
  }
  return assume.initial_covariance ? rows_json(*assume.initial_covariance) : Json("steady-state");
}

}  // namespace

Json noise_json(const Number& bound, const std::optional<GaussianNoise>& gaussian) {
  if (!gaussian) {
    return number_json(bound);
  }
  Json json = Json::object();
  add_number(json, "snr_db", gaussian->snr_db);
  add_number(json, "deviation", gaussian->deviation);
  return json;
}

Json require_json(const Requirements& require) {
  Json json = Json::object();
  add_number(json, "frequency_error_below", require.frequency_error_below);
  add_number(json, "settles_within", require.settles_within);
  add_number(json, "settled_below", require.settled_below);
  add_number(json, "largest_noise_at_least", require.largest_noise_at_least);
  add_number(json, "largest_slew_at_least", require.largest_slew_at_least);
  add_number(json, "frequency_error_radius_at_least", require.frequency_error_radius_at_least);
  add_number(json, "probability_of_losing_lock_below", require.probability_of_losing_lock_below);
  add_number(json, "rms_frequency_error_below", require.rms_frequency_error_below);
  return json;
}

Json assume_json(const Assumptions& assume) {
  Json json = {{"amplitude", number_json(assume.amplitude)},
               {"frequency", {number_json(assume.frequency[0]), number_json(assume.frequency[1])}},
               {"noise", noise_json(assume.noise, assume.gaussian)},
               {"slew", number_json(assume.slew)},
               {"initial_frequency_error", number_json(assume.initial_frequency_error)},
               {"initial_phase_error", number_json(assume.initial_phase_error)},
               {"initial_amplitude_error", number_json(assume.initial_amplitude_error)},
               {"initial_covariance", initial_covariance(assume)}};
  add_number(json, "sample_rate", assume.sample_rate);
  add_number(json, "frequency_walk", assume.frequency_walk);
  add_number(json, "samples", assume.samples);
  return json;
}

Json simulate_json(const SimulationSettings& simulate) {
  return {{"samples", simulate.samples}, {"seed", simulate.seed}, {"signal", simulate.signal}};
}

}  // namespace veritrack::certificates
