#include "reports/dft_block/dft_block_reports.hpp"

#include "reports/dft_block/dft_block_figures.hpp"

namespace veritrack::reports {

const TrackerReports& dft_block_reports() {
  static const TrackerReports reports{"dft-block-ekf", draw_dft_block_figures};
  return reports;
}

}  // namespace veritrack::reports
