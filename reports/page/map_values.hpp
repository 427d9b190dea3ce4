// The values of each cell of a map, which the page shows.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace veritrack::reports::page {

/// An axis: its values at the edges of the picture.
struct MapAxis {
  double low = 0.0, high = 0.0;
};

/// A cell of starts.
struct MapCell {
  double x_low = 0.0, x_high = 0.0, y_low = 0.0, y_high = 0.0;
  double z_low = 0.0, z_high = 0.0;  ///< across the picture
  std::size_t kind = 0;              ///< of the list of kinds
  std::size_t samples = 0;           ///< the text in place of {samples} for its kind
};

/// A map as the page needs it.
struct MapValues {
  MapAxis x, y;
  /// The sentence about a cell: {x0}, {x1}, ... {z1} are its ends, {kind} is its kind.
  std::string sentence;
  std::vector<std::string> kinds;  ///< the strongest first: where cells overlap, the last is shown
  std::vector<MapCell> cells;
};

/// Where the axes are in the picture, as shares of its width and height, for gnuplot and for the page.
struct PlotPlace {
  double left = 0.1, right = 0.97, bottom = 0.2, top = 0.97;  ///< from the left and from the bottom
  /// For a gnuplot script: the margins, and the key at the bottom of the picture.
  [[nodiscard]] std::string margins() const;
};

/// JSON for the program of the page. The ends of cells are rounded inward to five digits, so that a statement
/// about a cell is true for everything that it is said to contain.
[[nodiscard]] std::string map_values_json(const MapValues& map, const PlotPlace& place, double width,
                                          double height);

}  // namespace veritrack::reports::page
