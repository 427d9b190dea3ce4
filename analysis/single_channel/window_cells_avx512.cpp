// Compiled for AVX-512.
#include "analysis/single_channel/window_cell_lanes.hpp"
#include "analysis/single_channel/window_grid_lanes.hpp"

namespace veritrack::single_channel::detail {

void check_window_avx512(const WindowTask& task, const WindowCells& cells, WindowAnswers& answers) {
  check_window<8>(task, cells, answers);
}

const GridFunctions kGridAvx512 = kGridFunctions<8>;

}  // namespace veritrack::single_channel::detail
