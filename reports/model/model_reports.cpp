#include "reports/model/model_reports.hpp"

#include "reports/model/model_figures.hpp"
#include "reports/model/model_map.hpp"

namespace veritrack::reports {

const TrackerReports& model_reports() {
  static const TrackerReports reports{"model",
                                      draw_model_figures,
                                      write_model_map,
                                      {"--over", "--at", "--x", "--y", "--x-range", "--y-range", "--cells"}};
  return reports;
}

}  // namespace veritrack::reports
