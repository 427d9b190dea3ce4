// A program's rounding about a steady state that is a curve (docs/gain-proof.md, section 12).
#pragma once

#include <vector>

#include "checker/model/gain/gain_rounding.hpp"
#include "checker/model/gain/phase_run.hpp"

namespace veritrack::checker {

/// A program whose states stay within their room of the curve.
struct RoundedProgram {
  std::vector<double> room;  ///< by state; of angles infinite
  double most_noise = 0.0;   ///< in the samples
  RoundingOfStep of_step;
};

/// What a program is off in a step, at most: sup over the phases of a part.
struct PhaseRounding {
  std::vector<double> of_step;   ///< in the basis
  std::vector<double> of_start;  ///< by state
  double of_frequency = 0.0;     ///< rad/sample

  void raise(const PhaseRounding& other);
};

/// Over the cell of phases and frequencies of a run. Throws NotCovered where no bound is known.
PhaseRounding rounding_over(const RoundedProgram& program, const PhaseRun& run);

}  // namespace veritrack::checker
