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
  /// P(0|0) as the design gives it, or the two ends between which it lies in the Loewner order; none: a
  /// multiple of a matrix of ours.
  std::optional<std::array<std::array<Ball, 3>, 3>> covariance, highest_covariance;
  std::optional<std::array<Ball, 2>> covariance_multiples;  ///< those of the design: from, to
  /// As written, in signal units; of the multiples alone the ends are.
  std::array<std::array<std::string, 3>, 3> covariance_texts, highest_covariance_texts;
  std::array<std::string, 2> multiples_texts;
  Ball state_bound, sigma, gamma_fraction, c1, c2;  ///< of Theorem 2.9
  bool q1_equals_q2 = false;
  [[nodiscard]] bool without_leak() const { return certainly_equal(epsilon, zero); }
};

/// `assume.noise` is an object, so that the noise is Gaussian.
bool is_gaussian(const Tree& assume);

/// Objects to numbers that [lo, hi] does not contain, and to values that no design can have.
Design read_design(const Tree& design, Objections& objections);

}  // namespace veritrack::checker
