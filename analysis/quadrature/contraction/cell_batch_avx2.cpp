// Compiled for AVX2.
#include "analysis/quadrature/contraction/cell_lanes.hpp"

namespace veritrack::quadrature::detail {

void check_cells_avx2(const StepSetting<rigor::Interval>& setting,
                      const StepConstants<rigor::Interval>& constants, const CellBatch& cells,
                      CellAnswers& answers) {
  check_cells<4>(setting, constants, cells, answers);
}

void reach_of_cells_avx2(const StepSetting<rigor::Interval>& setting, const CellBatch& cells,
                         CellReach& found) {
  reach_of_cells<4>(setting, cells, found);
}

}  // namespace veritrack::quadrature::detail
