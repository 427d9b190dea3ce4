#include "checker/theorems/design.hpp"

#include "checker/document/design_number.hpp"

namespace veritrack::checker {

namespace {

std::array<std::array<Ball, 3>, 3> read_covariance(const Tree& rows, const Ball& amplitude,
                                                   Objections& objections) {
  const std::array<Ball, 3> unit{amplitude, amplitude, one};
  std::array<std::array<Ball, 3>, 3> covariance;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      covariance[i][j] = read_number(rows.at(i).at(j), objections) / (unit[i] * unit[j]);
      if (text_of(rows.at(i).at(j)) != text_of(rows.at(j).at(i))) {
        objections.emplace_back("initial_covariance is not written symmetrically");
      }
    }
  }
  return covariance;
}

}  // namespace

Design read_design(const Tree& tree, Objections& objections) {
  const auto positive = [&](const Tree& table, const char* name) {
    return read_positive(table.at(name), name, objections);
  };
  const auto not_negative = [&](const Tree& table, const char* name) {
    return read_not_negative(table.at(name), name, objections);
  };
  const Tree& chosen = tree.at("design");
  const Tree& assume = tree.at("assume");
  const Tree& theorem = tree.at("theorem_2_9");
  const Ball amplitude = positive(assume, "amplitude");
  Design design;
  design.amplitude = amplitude;
  design.q1 = not_negative(chosen, "q1") / square(amplitude);
  design.q2 = positive(chosen, "q2");
  design.r = positive(chosen, "r") / square(amplitude);
  design.epsilon = not_negative(chosen, "epsilon");
  design.q1_equals_q2 =
      certainly_equal(amplitude, one) && text_of(chosen.at("q1")) == text_of(chosen.at("q2"));
  const Band band = read_band(assume.at("frequency"), objections);
  design.lowest_frequency = band.lowest;
  design.highest_frequency = band.highest;
  design.largest_frequency = band.highest;
  design.noise = not_negative(assume, "noise") / amplitude;
  design.slew = not_negative(assume, "slew");
  design.amplitude_error = not_negative(assume, "initial_amplitude_error") / amplitude;
  design.phase_error = not_negative(assume, "initial_phase_error");
  design.frequency_error = not_negative(assume, "initial_frequency_error");
  const Tree& covariance = assume.at("initial_covariance");
  if (covariance.kind() == Tree::Kind::array) {
    design.covariance = read_covariance(covariance, amplitude, objections);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        design.covariance_texts[i][j] = text_of(covariance.at(i).at(j));
      }
    }
  } else if (covariance.text() != "steady-state") {
    throw Malformed("initial_covariance is neither a matrix nor steady-state");
  }
  design.state_bound = positive(theorem, "R_x");
  design.sigma = positive(theorem, "sigma");
  design.gamma_fraction = positive(theorem, "gamma_fraction");
  design.c1 = not_negative(theorem, "c1");
  design.c2 = not_negative(theorem, "c2");
  if (!certainly_less(design.epsilon, one)) {
    objections.emplace_back("epsilon must be below 1");
  }
  return design;
}

}  // namespace veritrack::checker
