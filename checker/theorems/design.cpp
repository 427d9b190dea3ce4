#include "checker/theorems/design.hpp"

#include "checker/document/design_number.hpp"
#include "checker/numbers/matrix3.hpp"

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

std::array<std::array<std::string, 3>, 3> texts_of(const Tree& rows) {
  std::array<std::array<std::string, 3>, 3> texts;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      texts[i][j] = text_of(rows.at(i).at(j));
    }
  }
  return texts;
}

/// From one end to the other, two matrices or two numbers. Objects to a range that may be empty.
void read_covariance_range(const Tree& range, Design& design, Objections& objections) {
  const Tree& from = range.at("from");
  const Tree& to = range.at("to");
  if (from.kind() != to.kind()) {
    throw Malformed("initial_covariance goes from a matrix to a number");
  }
  bool in_order = false;
  if (from.kind() == Tree::Kind::array) {
    design.covariance = read_covariance(from, design.amplitude, objections);
    design.highest_covariance = read_covariance(to, design.amplitude, objections);
    design.covariance_texts = texts_of(from);
    design.highest_covariance_texts = texts_of(to);
    in_order = definite(*design.covariance) && definite(*design.highest_covariance - *design.covariance);
  } else {
    design.covariance_multiples = {read_positive(from, "initial_covariance", objections),
                                   read_positive(to, "initial_covariance", objections)};
    design.multiples_texts = {text_of(from), text_of(to)};
    in_order = text_of(from) == text_of(to) ||
               certainly_less((*design.covariance_multiples)[0], (*design.covariance_multiples)[1]);
  }
  if (!in_order) {
    objections.emplace_back("initial_covariance must go from a positive definite matrix to a larger one");
  }
}

}  // namespace

bool is_gaussian(const Tree& assume) {
  return assume.at("noise").kind() == Tree::Kind::object && assume.at("noise").find("text") == nullptr;
}

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
  const Band band = read_band(assume, objections);
  design.lowest_frequency = band.lowest;
  design.highest_frequency = band.highest;
  design.largest_frequency = band.highest;
  // Gaussian noise has no bound: no statement that needs one is true for it.
  design.noise = assume.at("noise").find("text") == nullptr ? Ball::everything()
                                                            : not_negative(assume, "noise") / amplitude;
  design.slew = read_slew(assume.at("slew"), assume, objections);
  design.amplitude_error = not_negative(assume, "initial_amplitude_error") / amplitude;
  design.phase_error = not_negative(assume, "initial_phase_error");
  design.frequency_error =
      read_frequency(assume.at("initial_frequency_error"), assume, "initial_frequency_error", objections);
  const Tree& covariance = assume.at("initial_covariance");
  if (covariance.kind() == Tree::Kind::array) {
    design.covariance = read_covariance(covariance, amplitude, objections);
    design.covariance_texts = texts_of(covariance);
  } else if (covariance.kind() == Tree::Kind::object) {
    read_covariance_range(covariance, design, objections);
  } else if (covariance.text() != "steady-state") {
    throw Malformed("initial_covariance is neither a matrix, nor a range, nor steady-state");
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
