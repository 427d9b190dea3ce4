// The map of a proved region of attraction, as SVG, over (start frequency error, start phase error). It is
// readable in grey: proved dark, refuted hatched, undecided light.
#pragma once

#include <string>
#include <vector>

#include "analysis/quadrature/capture/capture_basin.hpp"
#include "analysis/quadrature/capture/capture_region.hpp"
#include "reports/figures.hpp"

namespace veritrack::reports {

/// A rectangle of the map.
struct MapRectangle {
  double frequency_lower, frequency_upper;  ///< rad/sample
  double phase_lower, phase_upper;          ///< rad
};

/// The same area by fewer rectangles: neighbours that share a whole side are joined, again and again. Does
/// not depend on the order of the rectangles.
[[nodiscard]] std::vector<MapRectangle> joined(std::vector<MapRectangle> rectangles);

/// A percentage that never says 100 (or 0) unless it is all (or nothing).
[[nodiscard]] std::string percent(double share);

/// The map, with the outline of the simulated basin and, in the caption, the share of it that is proved.
/// Where cells of several amplitude errors lie on top of each other the weakest verdict is seen. Not
/// drawn yet.
[[nodiscard]] Figure draw_region_map(const quadrature::Region& region,
                                     const quadrature::SimulatedBasin& basin);

}  // namespace veritrack::reports
