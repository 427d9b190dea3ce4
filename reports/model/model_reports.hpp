// Trackers that users write down, in reports/.
#pragma once

#include "reports/tracker_reports.hpp"

namespace veritrack::reports {

[[nodiscard]] const TrackerReports& model_reports();

}  // namespace veritrack::reports
