// Several cells of a set at once: error_contraction.cpp covers a set with them, step_inequality.hpp says what
// has to hold in each.
#pragma once

#include "analysis/quadrature/contraction/step_inequality.hpp"
#include "trackers/instruction_set.hpp"

namespace veritrack::quadrature {

/// Up to kMost cells, a column each: boxes of (s, beta, along, across), and the proposals for them. Plain
/// arrays, which units for different processors share.
struct CellBatch {
  static constexpr int kMost = 8;
  int count = 0;
  double low[kCellVariables][kMost];         // NOLINT: plain
  double high[kCellVariables][kMost];        // NOLINT
  double middle[kCellVariables][kMost];      // NOLINT
  double half_width[kCellVariables][kMost];  ///< upper bounds NOLINT
  double axis_cosine[kMost];                 // NOLINT
  double axis_sine[kMost];                   // NOLINT
  double reach[2][kMost];                    ///< of RayCell NOLINT
  double multiplier[kMost];                  ///< lambda NOLINT
  double angle_multiplier[kMost];            ///< tau NOLINT
  double tangent_squared[kMost];             ///< of CellForms; 0 where tau is NOLINT
};

/// The result of examining them.
struct CellAnswers {
  /// True only when the inequality is true everywhere in the cell, and Correction describes its step.
  bool holds[CellBatch::kMost];                        // NOLINT
  double influence[kCellVariables][CellBatch::kMost];  ///< as CellVerdict NOLINT
};

/// How far corrections reach in each of the first two variables' boxes, upper bounds; NaN or infinite where
/// that is not known.
struct CellReach {
  double reach[2][CellBatch::kMost];  // NOLINT
};

namespace detail {
using CheckCells = void(const StepSetting<rigor::Interval>& setting,
                        const StepConstants<rigor::Interval>& constants, const CellBatch& cells,
                        CellAnswers& answers);
using ReachOfCells = void(const StepSetting<rigor::Interval>& setting, const CellBatch& cells,
                          CellReach& found);
CheckCells check_cells_avx2;
CheckCells check_cells_avx512;
ReachOfCells reach_of_cells_avx2;
ReachOfCells reach_of_cells_avx512;
}  // namespace detail

}  // namespace veritrack::quadrature
