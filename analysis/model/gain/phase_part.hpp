// A loop over a part of the frequencies of a cell: its step at all phases, on a grid
// (docs/gain-proof.md, section 10).
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/model/gain/grid_function.hpp"
#include "analysis/model/gain/phase_step.hpp"

namespace veritrack::model {

/// How bounds are computed: the cells of phases, the horizon, and the parts of the frequencies.
struct PhaseGridding {
  std::size_t phases = 64;
  std::size_t horizon = 1024;  ///< lags that are taken one by one
  std::size_t parts = 1;
  /// Later ones by turns of the phase: so many blocks, of so many turns each.
  std::size_t late_blocks = 0, late_turns = 0;
  std::size_t lags = 1024;  ///< all of them, at the lowest frequency
};

/// The part of a step over a cell of phases that bounds need.
struct PhaseNetwork {
  std::vector<PhaseInput> inputs;
  std::vector<std::vector<DirectWeight>> direct;  ///< by form
  rigor::Interval bias;                           ///< rad/sample
  rigor::Interval mean_bias;                      ///< its mean over the phases of the cell
};

/// Matrices are n x n, row by row.
struct PhasePart {
  std::size_t states = 0;
  double frequency = 0.0;   ///< in the middle, rad/sample
  double half_width = 0.0;  ///< rad/sample, at least
  std::vector<PhaseNetwork> cells;
  std::vector<GridFunction> forms;        ///< the last one is the frequency error
  std::vector<GridFunction> noise;        ///< columns of the components
  std::map<int, GridFunction> columns;    ///< of gates, by the numbers of their inputs
  GridFunction slew;                      ///< column, but for the bend of the curve
  std::vector<double> slew_bend;          ///< what the bend adds to its error, times the slew
  std::vector<rigor::Interval> matrix;    ///< at all phases and frequencies
  std::vector<double> middle;             ///< the matrix of the cell in the middle of the part, nearly
  std::vector<double> lean;               ///< half of what it changes over the part, nearly
  std::vector<double> off;                ///< sup of how far the matrix is from the line of both
  std::vector<double> residual;           ///< sup
  std::vector<double> rounding;           ///< of a program in each step, sup; empty: nothing is rounded
  std::vector<double> rounding_of_start;  ///< of its states, not in the basis
  double rounding_of_frequency = 0.0;     ///< rad/sample
  std::vector<double> inverse;            ///< sup of the inverse of the basis
  std::vector<double> basis_slope;        ///< sup of the inverse times the derivative of the basis
  std::vector<double> basis_bend;         ///< what the bend of the basis adds to it, times the slew
  std::optional<std::pair<std::size_t, rigor::Interval>> frequency_state;
};

/// Part number `part`. Empty where its matrix is not known. Throws NoFrame where the rules do not cover the
/// loop. Needs the upward rounding mode.
[[nodiscard]] std::optional<PhasePart> phase_part(const TrackerModel& tracker, const FloquetCell& cell,
                                                  const PhaseGridding& gridding, std::size_t part);

/// With everything that a slew of this size, rad/sample per sample, does to the matrix, the columns and the
/// residual; with one, forms, columns and the matrix do not lean, because earlier samples may be of other
/// parts. Empty where it is too large for the basis.
[[nodiscard]] std::optional<PhasePart> with_slew(PhasePart part, double slew);

}  // namespace veritrack::model
