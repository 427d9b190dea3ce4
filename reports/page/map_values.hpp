// What a map says of a start: the values of each cell, for the page.
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
  std::size_t samples = 0;           ///< what {samples} of its kind stands for
};

/// A map as the page needs it.
struct MapValues {
  MapAxis x, y;
  /// What a cell is told with: {x0}, {x1}, ... {z1} are its ends, {kind} is its kind.
  std::string sentence;
  std::vector<std::string>
      kinds;  ///< the strongest first: where cells lie on top of each other, the last is told
  std::vector<MapCell> cells;
};

/// Where the axes are in the picture, as shares of its width and height: gnuplot is told, and so is the page.
struct PlotPlace {
  double left = 0.1, right = 0.97, bottom = 0.2, top = 0.97;  ///< from the left and from the bottom
  /// For a gnuplot script: the margins, and the key at the bottom of the picture.
  [[nodiscard]] std::string margins() const;
};

/// JSON for the program of the page. The ends of cells are rounded inward to five digits, so that what is
/// said of a cell is true of all that is told to be in it.
[[nodiscard]] std::string map_values_json(const MapValues& map, const PlotPlace& place, double width,
                                          double height);

}  // namespace veritrack::reports::page
