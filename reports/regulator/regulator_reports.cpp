#include "reports/regulator/regulator_reports.hpp"

#include "reports/regulator/regulator_figures.hpp"

namespace veritrack::reports {

const TrackerReports& regulator_reports() {
  static const TrackerReports reports{"vibration-regulator", draw_regulator_figures};
  return reports;
}

}  // namespace veritrack::reports
