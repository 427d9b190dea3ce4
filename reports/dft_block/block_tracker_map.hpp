// veritrack map of a block tracker: where starts end, in lock or in a false lock.
#pragma once

#include "reports/tracker_reports.hpp"

namespace veritrack::reports {

/// See TrackerReports.
[[nodiscard]] MapResult write_block_tracker_map(const certificates::Design& design, const MapRequest& request,
                                                const std::filesystem::path& directory,
                                                const certificates::CertifyProgress& progress);

}  // namespace veritrack::reports
