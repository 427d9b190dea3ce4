#include "checker/single_channel/single_channel_design.hpp"

namespace veritrack::checker {

SingleChannelDesign read_single_channel_design(const Tree& tree, Objections& objections) {
  const auto number = [&](const Tree& table, const char* name) {
    return read_number(table.at(name), objections);
  };
  const Tree& chosen = tree.at("design");
  const Tree& assume = tree.at("assume");
  SingleChannelDesign design;
  design.amplitude = number(assume, "amplitude");
  const Tree& process_noise = chosen.at("process_noise");
  const bool by_ratio = chosen.find("lambda") != nullptr;
  if (by_ratio && (chosen.find("q") != nullptr || chosen.find("r") != nullptr)) {
    throw Malformed("lambda replaces q and r");
  }
  const auto q = [&] { return by_ratio ? one : number(chosen, "q"); };
  design.r = number(chosen, by_ratio ? "lambda" : "r");
  design.epsilon = number(chosen, "epsilon");
  if (process_noise.kind() == Tree::Kind::object) {
    design.q1 = number(process_noise, "q1");
    design.q2 = number(process_noise, "q2");
  } else if (process_noise.text() == "identity" || process_noise.text() == "frequency-only") {
    design.q1 = process_noise.text() == "identity" ? q() : zero;
    design.q2 = q();
  } else {
    throw Malformed("no process noise: " + process_noise.text());
  }
  design.q1 = design.q1 / square(design.amplitude);
  design.r = design.r / square(design.amplitude);
  const Tree& band = assume.at("frequency");
  design.lowest = read_number(band.at(0), objections);
  design.highest = read_number(band.at(1), objections);
  const bool in_order = band.at(0).at("text").text() == band.at(1).at("text").text() ||
                        certainly_at_most(design.lowest, design.highest);
  design.noise = number(assume, "noise") / design.amplitude;
  design.slew = number(assume, "slew");
  design.amplitude_error = number(assume, "initial_amplitude_error") / design.amplitude;
  design.phase_error = number(assume, "initial_phase_error");
  design.frequency_error = number(assume, "initial_frequency_error");
  const Tree& covariance = assume.at("initial_covariance");
  design.starts_in_steady_state = covariance.kind() == Tree::Kind::text;
  if (design.starts_in_steady_state && covariance.text() != "steady-state") {
    throw Malformed("initial_covariance is neither a matrix nor steady-state");
  }
  if (!certainly_positive(design.amplitude) || !certainly_positive(design.q2) || !in_order) {
    objections.emplace_back("amplitude and q2 must be positive, and the frequencies in order");
  }
  for (const Ball* bound : {&design.q1, &design.r, &design.epsilon, &design.noise, &design.slew,
                            &design.amplitude_error, &design.phase_error, &design.frequency_error}) {
    if (!certainly_not_negative(*bound)) {
      objections.emplace_back("variances, the leak, noise, slew and start errors must not be negative");
    }
  }
  return design;
}

}  // namespace veritrack::checker
