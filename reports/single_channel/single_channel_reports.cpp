#include "reports/single_channel/single_channel_reports.hpp"

#include "reports/single_channel/single_channel_figures.hpp"

namespace veritrack::reports {

const TrackerReports& single_channel_reports() {
  static const TrackerReports reports{"single-channel-ekf", draw_single_channel_figures};
  return reports;
}

}  // namespace veritrack::reports
