#include "checker/single_channel/single_channel_design.hpp"

#include "checker/document/design_number.hpp"

namespace veritrack::checker {

namespace {

/// Q = diag(q1, q1, q2) and r, in signal units.
void read_variances(const Tree& chosen, SingleChannelDesign& design, Objections& objections) {
  const auto not_negative = [&](const Tree& table, const char* name) {
    return read_not_negative(table.at(name), name, objections);
  };
  const Tree& process_noise = chosen.at("process_noise");
  const bool by_ratio = chosen.find("lambda") != nullptr;
  if (by_ratio && (chosen.find("q") != nullptr || chosen.find("r") != nullptr)) {
    throw Malformed("lambda replaces q and r");
  }
  design.r = not_negative(chosen, by_ratio ? "lambda" : "r");
  if (process_noise.kind() == Tree::Kind::object) {
    design.q1 = not_negative(process_noise, "q1");
    design.q2 = read_positive(process_noise.at("q2"), "q2", objections);
    return;
  }
  const std::string& kind = process_noise.text();
  if (kind != "identity" && kind != "frequency-only") {
    throw Malformed("no process noise: " + kind.substr(0, 60));
  }
  design.q2 = by_ratio ? one : read_positive(chosen.at("q"), "q", objections);
  design.q1 = kind == "identity" ? design.q2 : zero;
}

}  // namespace

SingleChannelDesign read_single_channel_design(const Tree& tree, Objections& objections) {
  const Tree& chosen = tree.at("design");
  const Tree& assume = tree.at("assume");
  const auto not_negative = [&](const Tree& table, const char* name) {
    return read_not_negative(table.at(name), name, objections);
  };
  SingleChannelDesign design;
  design.amplitude = read_positive(assume.at("amplitude"), "amplitude", objections);
  read_variances(chosen, design, objections);
  design.epsilon = not_negative(chosen, "epsilon");
  design.q1 = design.q1 / square(design.amplitude);
  design.r = design.r / square(design.amplitude);
  const Band band = read_band(assume, objections);
  design.lowest = band.lowest;
  design.highest = band.highest;
  design.noise = not_negative(assume, "noise") / design.amplitude;
  design.slew = read_slew(assume.at("slew"), assume, objections);
  design.amplitude_error = not_negative(assume, "initial_amplitude_error") / design.amplitude;
  design.phase_error = not_negative(assume, "initial_phase_error");
  design.frequency_error =
      read_frequency(assume.at("initial_frequency_error"), assume, "initial_frequency_error", objections);
  if (!certainly_less(design.epsilon, one)) {
    objections.emplace_back("epsilon must be below 1");
  }
  const Tree& covariance = assume.at("initial_covariance");
  design.has_given_covariance = covariance.kind() != Tree::Kind::text;
  if (design.has_given_covariance) {
    for (std::size_t i = 0; i < 9; ++i) {
      read_number(covariance.at(i / 3).at(i % 3), objections);
    }
  } else if (covariance.text() != "steady-state") {
    throw Malformed("initial_covariance is neither a matrix nor steady-state");
  }
  return design;
}

}  // namespace veritrack::checker
