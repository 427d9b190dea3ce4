// The design and the assumptions of a single-channel tracker, at a signal of amplitude 1.
#pragma once

#include "checker/document/statement.hpp"

namespace veritrack::checker {

struct SingleChannelDesign {
  Ball amplitude;           ///< the true one, signal units
  Ball q1, q2, r, epsilon;  ///< Q = diag(q1, q1, q2)
  Ball lowest, highest;     ///< true frequencies, rad/sample
  Ball noise, slew;
  Ball amplitude_error, phase_error, frequency_error;  ///< of the start, bounds on absolute values
  bool has_given_covariance = false;
  [[nodiscard]] bool without_leak() const { return certainly_equal(epsilon, zero); }
};

/// Objects to numbers that [lo, hi] does not contain, and to values that no design can have.
SingleChannelDesign read_single_channel_design(const Tree& design, Objections& objections);

}  // namespace veritrack::checker
