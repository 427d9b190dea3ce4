#include "reports/model/model_reports.hpp"

#include "reports/model/model_figures.hpp"

namespace veritrack::reports {

const TrackerReports& model_reports() {
  static const TrackerReports reports{"model", draw_model_figures};
  return reports;
}

}  // namespace veritrack::reports
