// The proved region of attraction of a quadrature tracker as files: the picture and the cells.
#pragma once

#include <filesystem>

#include "reports/tracker_reports.hpp"

namespace veritrack::reports {

/// Proves the region (certificates/quadrature/region.hpp) and writes region.svg, and region.csv with a line
/// for each cell (its bounds as exact decimals of doubles, its verdict and the number of samples after which
/// it was decided), into `directory`, which is made when missing. Throws certificates::OutputError,
/// FigureError.
[[nodiscard]] MapResult write_quadrature_map(const certificates::Design& design, const MapRequest& request,
                                             const std::filesystem::path& directory,
                                             const certificates::CertifyProgress& progress);

}  // namespace veritrack::reports
