// How the modes of a loop move with one of its parameters, as files: the document, the picture, the numbers.
#pragma once

#include <filesystem>
#include <string>

#include "certificates/model/root_locus.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "reports/tracker_reports.hpp"

namespace veritrack::reports {

/// Multipliers beside the unit circle, where it is known how they turn, and their sizes over the parameter.
/// Not drawn yet.
[[nodiscard]] Figure root_locus_figure(const certificates::RootLocus& locus);

/// "from 0.05 to 15.9, 20 to 40"; or "at none of these values".
[[nodiscard]] std::string stable_values(const certificates::RootLocus& locus);

/// The document root-locus.md, the answer first.
[[nodiscard]] std::string root_locus_document(const certificates::Design& design,
                                              const certificates::RootLocus& locus, const Figure& figure);

/// Writes root-locus.md, root-locus.svg and root-locus.csv into `directory`, which is made when missing.
/// Throws certificates::RequestError, certificates::OutputError, FigureError.
[[nodiscard]] MapResult write_root_locus(const certificates::Design& design, const MapRequest& request,
                                         const std::filesystem::path& directory);

}  // namespace veritrack::reports
