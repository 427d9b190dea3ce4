// A loop at the frequencies of a part of a cell, over all phases (docs/gain-proof.md, section 10).
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "checker/model/gain/phase_kernels.hpp"
#include "checker/model/gain/phase_rounding.hpp"
#include "checker/model/gain/phase_run.hpp"

namespace veritrack::checker {

/// The known values over a cell of phases.
struct PhaseCellValues {
  std::vector<RuleRange> rules;
  std::vector<std::vector<std::pair<std::size_t, double>>> direct;  ///< as of a run
  std::vector<double> to_input;                                     ///< as of a run
  DoubleRange bias;
  DoubleRange mean_bias;  ///< over the phases of the cell
};

struct PhasePart {
  Ball lowest, highest;           ///< the frequencies, rad/sample, or more
  double half_width = 0.0;        ///< D of its cell
  std::array<Table, 2> matrix;    ///< near the matrix at the lowest and the highest frequency, row by row
  Table off;                      ///< sup of how far the matrix is from the line between them
  Table matrix_low, matrix_high;  ///< enclose all matrices
  std::vector<GridFunction> forms;
  std::vector<PhaseInput> inputs;  ///< noise, the slew, then those of the structure
  Table inverse;                   ///< sup |P^-1|
  std::vector<double> residual;
  PhaseRounding rounding;          ///< of a program
  std::vector<double> curve_bend;  ///< sup |d^2 C/d omega^2|
  Table turned;                    ///< sup |P^-1 dP/d omega|
  Table basis_bend;                ///< sup |d^2 P/d omega^2|
  std::vector<PhaseCellValues> cells;

  static constexpr std::size_t kNoise = 0;
  static constexpr std::size_t kSlew = 1;
  static constexpr std::size_t kFirstOfRemainders = 2;
};

/// Part number `part` of a cell, with so many phases, and `program`, if there is one. Throws NotCovered where
/// something is not certain.
PhasePart phase_part(const PhaseStructure& structure, const TrackedModel& model, const PhaseCell& cell,
                     std::size_t part, std::size_t phases, const RoundedProgram* program);

/// The same with nothing that leans: forms, inputs and matrices are those in the middle of its frequencies,
/// up to errors.
PhasePart without_lean(PhasePart part);

/// The part of z in [-1, 1] with this number, or a little more, over a cell of phases.
TubePart place_of_part(std::size_t part, std::size_t parts, std::size_t phase, std::size_t phases);

}  // namespace veritrack::checker
