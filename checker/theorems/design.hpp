// The design and the assumptions of a quadrature tracker, at a signal of amplitude 1: the filter (q1, r,
// noise v) at amplitude A is the filter (q1/A^2, r/A^2, v/A) at amplitude 1.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "checker/document/statement.hpp"

namespace veritrack::checker {

struct Design {
  Ball amplitude;  ///< the true one, signal units
  Ball q1, q2, r, epsilon;
  Ball lowest_frequency, highest_frequency, largest_frequency;  ///< rad/sample
  Ball noise, slew;
  Ball amplitude_error, phase_error, frequency_error;  ///< of the start, bounds on absolute values
  std::optional<std::array<std::array<Ball, 3>, 3>>
      covariance;  ///< P(0|0); none: a multiple of a matrix of ours
  std::array<std::array<std::string, 3>, 3> covariance_texts;  ///< as written, in signal units
  Ball state_bound, sigma, gamma_fraction, c1, c2;             ///< of Theorem 2.9
  bool q1_equals_q2 = false;
  [[nodiscard]] bool without_leak() const { return certainly_equal(epsilon, zero); }
};

/// Objects to numbers that [lo, hi] does not contain, and to what no design can be.
Design read_design(const Tree& design, Objections& objections);

}  // namespace veritrack::checker
