// The proved region of attraction of a model as files: the document, the picture, the cells.
#pragma once

#include <filesystem>
#include <string>

#include "certificates/model/model_map.hpp"
#include "reports/tracker_reports.hpp"

namespace veritrack::reports {

/// The document map.md, the answer first.
[[nodiscard]] std::string model_map_document(const certificates::Design& design,
                                             const certificates::ModelMap& map, const Figure& figure);

/// region.csv: a line for each cell; its ends are exact decimals of doubles.
[[nodiscard]] std::string model_map_cells(const certificates::ModelMap& map);

/// map.json: the frequency, the tube into which starts are followed and the cells, numbers as hexadecimal
/// floats.
[[nodiscard]] std::string model_map_json(const certificates::Design& design,
                                         const certificates::ModelMap& map);

/// Proves the region (certificates/model/model_map.hpp) and writes map.md, map.json, region.svg and
/// region.csv into `directory`, which is made when missing. Throws certificates::RequestError,
/// certificates::OutputError, FigureError.
[[nodiscard]] MapResult write_model_map(const certificates::Design& design, const MapRequest& request,
                                        const std::filesystem::path& directory,
                                        const certificates::CertifyProgress& progress);

}  // namespace veritrack::reports
