// The files of a proved region of attraction: the picture and the cells.
#pragma once

#include <filesystem>

#include "certificates/quadrature/region.hpp"

namespace veritrack::reports {

/// Writes region.svg, and region.csv with a line for each cell (its bounds as exact decimals of doubles, its
/// verdict and the number of samples after which it was decided), into `directory`, which is made when
/// missing. Returns the path of the picture. Throws certificates::OutputError, FigureError.
std::filesystem::path write_region_files(const certificates::RegionOfAttraction& region,
                                         const std::filesystem::path& directory);

}  // namespace veritrack::reports
