#include "reports/kkl_observer/kkl_observer_reports.hpp"

#include "reports/kkl_observer/kkl_figures.hpp"

namespace veritrack::reports {

const TrackerReports& kkl_observer_reports() {
  static const TrackerReports reports{"kkl-observer", draw_kkl_figures};
  return reports;
}

}  // namespace veritrack::reports
