// The KKL observer in reports/.
#pragma once

#include "reports/tracker_reports.hpp"

namespace veritrack::reports {

[[nodiscard]] const TrackerReports& kkl_observer_reports();

}  // namespace veritrack::reports
