#include "checker/theorems/design.hpp"

namespace veritrack::checker {

Design read_design(const Tree& tree, Objections& objections) {
  const auto number = [&](const Tree& table, const char* name) {
    return read_number(table.at(name), objections);
  };
  const Tree& chosen = tree.at("design");
  const Tree& assume = tree.at("assume");
  const Tree& theorem = tree.at("theorem_2_9");
  const Ball amplitude = number(assume, "amplitude");
  Design design;
  design.amplitude = amplitude;
  design.q1 = number(chosen, "q1") / square(amplitude);
  design.q2 = number(chosen, "q2");
  design.r = number(chosen, "r") / square(amplitude);
  design.epsilon = number(chosen, "epsilon");
  design.q1_equals_q2 = certainly_equal(amplitude, one) &&
                        chosen.at("q1").at("text").text() == chosen.at("q2").at("text").text();
  const Tree& frequency = assume.at("frequency");
  design.lowest_frequency = read_number(frequency.at(0), objections);
  design.highest_frequency = read_number(frequency.at(1), objections);
  design.largest_frequency = max(abs(design.lowest_frequency), abs(design.highest_frequency));
  design.noise = number(assume, "noise") / amplitude;
  design.slew = number(assume, "slew");
  design.amplitude_error = number(assume, "initial_amplitude_error") / amplitude;
  design.phase_error = number(assume, "initial_phase_error");
  design.frequency_error = number(assume, "initial_frequency_error");
  const Tree& covariance = assume.at("initial_covariance");
  if (covariance.kind() == Tree::Kind::array) {
    const std::array<Ball, 3> unit{amplitude, amplitude, one};
    auto& start = design.covariance.emplace();
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        start[i][j] = read_number(covariance.at(i).at(j), objections) / (unit[i] * unit[j]);
        if (covariance.at(i).at(j).at("text").text() != covariance.at(j).at(i).at("text").text()) {
          objections.emplace_back("initial_covariance is not written symmetrically");
        }
      }
    }
  } else if (covariance.text() != "steady-state") {
    throw Malformed("initial_covariance is neither a matrix nor steady-state");
  }
  design.state_bound = number(theorem, "R_x");
  design.sigma = number(theorem, "sigma");
  design.gamma_fraction = number(theorem, "gamma_fraction");
  design.c1 = number(theorem, "c1");
  design.c2 = number(theorem, "c2");
  if (!certainly_positive(amplitude) || !certainly_positive(design.q2) || !certainly_positive(design.r)) {
    objections.emplace_back("amplitude, q2 and r must be positive");
  }
  for (const Ball* bound : {&design.q1, &design.noise, &design.slew, &design.amplitude_error,
                            &design.phase_error, &design.frequency_error}) {
    if (!certainly_not_negative(*bound)) {
      objections.emplace_back("q1, noise, slew and start errors must not be negative");
    }
  }
  return design;
}

}  // namespace veritrack::checker
