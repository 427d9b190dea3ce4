// The quadrature tracker in reports/.
#pragma once

#include "reports/tracker_reports.hpp"

namespace veritrack::reports {

[[nodiscard]] const TrackerReports& quadrature_reports();

}  // namespace veritrack::reports
