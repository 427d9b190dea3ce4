// The block tracker in reports/.
#pragma once

#include "reports/tracker_reports.hpp"

namespace veritrack::reports {

[[nodiscard]] const TrackerReports& dft_block_reports();

}  // namespace veritrack::reports
