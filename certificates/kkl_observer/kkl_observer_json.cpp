#include "certificates/kkl_observer/kkl_observer_json.hpp"

#include "certificates/kkl_observer/kkl_observer_design.hpp"

namespace veritrack::certificates {

Json kkl_observer_design_json(const Design& read) {
  const auto& [design, assume, require] = kkl_observer_tables(read);
  Json rates = Json::array();
  for (const Number& rate : design.lambda) {
    rates.push_back(number_json(rate));
  }
  Json chosen{{"lambda", rates}};
  add_number(chosen, "ell", design.ell);
  add_number(chosen, "sampling_interval", design.sampling_interval);
  Json assumed{{"frequency", {number_json(assume.frequency[0]), number_json(assume.frequency[1])}},
               {"amplitude", {number_json(assume.amplitude[0]), number_json(assume.amplitude[1])}}};
  if (assume.disturbance) {
    Json disturbance = Json::object();
    add_number(disturbance, "bound", assume.disturbance->bound);
    add_number(disturbance, "amplitude", assume.disturbance->amplitude);
    add_number(disturbance, "frequency", assume.disturbance->frequency);
    assumed["disturbance"] = disturbance;
  }
  Json required = Json::object();
  add_number(required, "frequency_error_below", require.frequency_error_below);
  add_number(required, "amplitude_error_below", require.amplitude_error_below);
  add_number(required, "settles_within", require.settles_within);
  return {{"design", chosen}, {"assume", assumed}, {"require", required}};
}

}  // namespace veritrack::certificates
