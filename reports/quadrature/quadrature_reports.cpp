#include "reports/quadrature/quadrature_reports.hpp"

#include "reports/quadrature/quadrature_figures.hpp"
#include "reports/quadrature/quadrature_map.hpp"

namespace veritrack::reports {

const TrackerReports& quadrature_reports() {
  static const TrackerReports reports{
      "quadrature-ekf", draw_quadrature_figures, write_quadrature_map, {"--frequency", "--phase"}};
  return reports;
}

}  // namespace veritrack::reports
