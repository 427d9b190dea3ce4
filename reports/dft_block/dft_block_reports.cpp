#include "reports/dft_block/dft_block_reports.hpp"

#include "reports/dft_block/block_tracker_map.hpp"
#include "reports/dft_block/dft_block_figures.hpp"

namespace veritrack::reports {

const TrackerReports& dft_block_reports() {
  static const TrackerReports reports{
      "dft-block-ekf", draw_dft_block_figures, write_block_tracker_map, {"--cells"}};
  return reports;
}

}  // namespace veritrack::reports
