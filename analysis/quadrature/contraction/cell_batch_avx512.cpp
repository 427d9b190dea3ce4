// Compiled for AVX-512.
#include "analysis/quadrature/contraction/cell_lanes.hpp"

namespace veritrack::quadrature::detail {

void check_cells_avx512(const StepSetting<rigor::Interval>& setting,
                        const StepConstants<rigor::Interval>& constants, const CellBatch& cells,
                        CellAnswers& answers) {
  check_cells<8>(setting, constants, cells, answers);
}

void reach_of_cells_avx512(const StepSetting<rigor::Interval>& setting, const CellBatch& cells,
                           CellReach& found) {
  reach_of_cells<8>(setting, cells, found);
}

}  // namespace veritrack::quadrature::detail
