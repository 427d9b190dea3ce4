#include "reports/page/map_values.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/rigor/decimal.hpp"

namespace veritrack::reports::page {

namespace {

constexpr int kDigits = 5;

std::string end(double value, rigor::Direction inward) {
  return rigor::to_decimal(value, kDigits, inward);
}

}  // namespace

std::string PlotPlace::margins() const {
  return fmt::format(
      "set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\nset tmargin at screen "
      "{}\n"
      "set key at screen 0.5,0.015 center bottom vertical Left reverse samplen 4 maxrows 4\n",
      left, right, bottom, top);
}

std::string map_values_json(const MapValues& map, const PlotPlace& place, double width, double height) {
  using Json = nlohmann::ordered_json;
  using rigor::Direction;
  Json cells = Json::array();
  for (const MapCell& cell : map.cells) {
    cells.push_back({end(cell.x_low, Direction::up), end(cell.x_high, Direction::down),
                     end(cell.y_low, Direction::up), end(cell.y_high, Direction::down), cell.kind,
                     cell.samples, end(cell.z_low, Direction::up), end(cell.z_high, Direction::down)});
  }
  const Json json{{"plot",
                   {{"left", place.left * width},
                    {"right", place.right * width},
                    {"top", (1.0 - place.top) * height},
                    {"bottom", (1.0 - place.bottom) * height}}},
                  {"x", {{"range", {map.x.low, map.x.high}}}},
                  {"y", {{"range", {map.y.low, map.y.high}}}},
                  {"invitation", "Point at a cell of the map."},
                  {"sentence", map.sentence},
                  {"kinds", map.kinds},
                  {"cells", cells}};
  return json.dump();
}

}  // namespace veritrack::reports::page
