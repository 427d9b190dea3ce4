// The step over a cell of phases and frequencies, to first order in deviations from the curve, with bounds
// of what is left (docs/gain-proof.md, section 10).
#pragma once

#include <utility>
#include <vector>

#include "checker/model/gain/phase_inverse.hpp"
#include "checker/model/gain/phase_rules.hpp"
#include "checker/model/gain/phase_structure.hpp"
#include "checker/model/tube_step.hpp"

namespace veritrack::checker {

/// A cell of frequencies as a certificate writes it. The tube has only the frequencies, the turns and the
/// curve, and `shape` has all entries of the basis, row by row.
struct PhaseCell {
  PhaseTube tube;
  PhaseTube slope;        ///< the derivatives of the curve, without turns, and of the basis by z
  std::size_t parts = 1;  ///< of the frequencies
  std::vector<std::vector<double>> matrix;  ///< coefficients of the powers of z, by entry
};

/// The step over a cell of phases and frequencies: functions of the place in it.
struct PhaseRun {
  PolynomialMatrix forms;    ///< by form and component of eta
  PolynomialMatrix columns;  ///< by variable of the step (eta, noise, inputs) and component of eta
  PolynomialRow residual;
  PolynomialRow slew;        ///< -P^-1 dC/d omega at a fixed phase
  PolynomialMatrix inverse;  ///< P^-1 a sample later
  PolynomialMatrix turned;   ///< P^-1 dP/d omega there, at a fixed phase
  BallPolynomial bias;
  std::vector<BallPolynomial> curve, signal;  ///< by state, by channel
  std::vector<RuleRange> rules;
  /// By form: suprema of the slopes by noise, remainders and inputs, with the numbers of the variables.
  std::vector<std::vector<std::pair<std::size_t, double>>> direct;
  std::vector<double> to_input;  ///< by rule: the supremum of the slope of the value that it is taken in
};

/// Throws NotCovered where something is not certainly defined.
PhaseRun run_over(const PhaseStructure& structure, const TrackedModel& model, const PhaseCell& cell,
                  const TubePart& part);

}  // namespace veritrack::checker
