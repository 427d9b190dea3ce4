// The single-channel tracker in reports/.
#pragma once

#include "reports/tracker_reports.hpp"

namespace veritrack::reports {

[[nodiscard]] const TrackerReports& single_channel_reports();

}  // namespace veritrack::reports
