// Compiled for AVX2.
#include "analysis/single_channel/window_cell_lanes.hpp"
#include "analysis/single_channel/window_grid_lanes.hpp"

namespace veritrack::single_channel::detail {

void check_window_avx2(const WindowTask& task, const WindowCells& cells, WindowAnswers& answers) {
  check_window<4>(task, cells, answers);
}

const GridFunctions kGridAvx2 = kGridFunctions<4>;

}  // namespace veritrack::single_channel::detail
