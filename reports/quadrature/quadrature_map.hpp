// The proved region of attraction of a quadrature tracker as files: a document, the picture and the cells.
#pragma once

#include <filesystem>
#include <string>

#include "certificates/quadrature/region.hpp"
#include "reports/tracker_reports.hpp"

namespace veritrack::reports {

/// The document, of what was found and its picture.
[[nodiscard]] std::string quadrature_map_document(const certificates::Design& design,
                                                  const certificates::RegionRequest& request,
                                                  const certificates::RegionOfAttraction& found,
                                                  const Figure& figure);

/// Proves the region (certificates/quadrature/region.hpp) and writes map.md, region.svg, region.csv with a
/// line for each cell (its bounds as exact decimals of doubles, its verdict and the number of samples after
/// which it was decided), and map.html when asked for, into `directory`, which is made when missing. Throws
/// certificates::OutputError, FigureError.
[[nodiscard]] MapResult write_quadrature_map(const certificates::Design& design, const MapRequest& request,
                                             const std::filesystem::path& directory,
                                             const certificates::CertifyProgress& progress);

}  // namespace veritrack::reports
