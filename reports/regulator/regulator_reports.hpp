// The vibration regulator in reports/.
#pragma once

#include "reports/tracker_reports.hpp"

namespace veritrack::reports {

[[nodiscard]] const TrackerReports& regulator_reports();

}  // namespace veritrack::reports
