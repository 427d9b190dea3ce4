// The design and the assumptions of a KKL observer (Praly, Marconi, Isidori).
#pragma once

#include <optional>
#include <vector>

#include "checker/document/statement.hpp"

namespace veritrack::checker {

struct KklDesign {
  std::vector<Ball> lambda;  ///< filter rates, 1/s
  std::optional<Ball> ell;   ///< of (9); none: the lower end of the enclosure of (10)
  /// s, for a program that takes its input to be straight between samples; none: continuous time.
  std::optional<Ball> sampling_interval;
  Ball frequency_low, frequency_high;  ///< rad/s
  Ball amplitude_low, amplitude_high;  ///< signal units
  // The disturbance: |d| <= bound, or amplitude sin(W t + p) for any p and any W from the frequency up. All
  // are empty when there is no disturbance.
  std::optional<Ball> bound, disturbance_amplitude, disturbance_frequency;
};

/// Objects to numbers that [lo, hi] does not contain, and to values that no such design can have.
KklDesign read_kkl_design(const Tree& design, Objections& objections);

}  // namespace veritrack::checker
