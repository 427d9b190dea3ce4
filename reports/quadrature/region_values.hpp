// The cells of a region of attraction as numbers: for a page, and for a file beside the map.
#pragma once

#include <cstddef>
#include <string>

#include "analysis/quadrature/capture/capture_basin.hpp"
#include "analysis/quadrature/capture/capture_region.hpp"
#include "reports/figure_table.hpp"
#include "reports/page/map_values.hpp"

namespace veritrack::reports {

/// Where the axes are in the picture, and its size in pixels.
inline constexpr page::PlotPlace kRegionPlace{0.1, 0.97, 0.27, 0.97};
inline constexpr std::size_t kRegionWidth = 820;
inline constexpr std::size_t kRegionHeight = 560;

/// The sentence of each cell, for a page. A sentence is about one cell, and names all its ends.
[[nodiscard]] std::string region_values(const quadrature::Region& region,
                                        const quadrature::SimulatedBasin& basin);

/// The cells with their verdicts.
[[nodiscard]] FigureTable table_of_region(const quadrature::Region& region);

}  // namespace veritrack::reports
