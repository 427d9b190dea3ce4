#include "reports/page/map_values.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace veritrack::reports::page {
namespace {

TEST_CASE("ends are rounded inward, and the place of the axes is in units of the picture") {
  const MapValues map{{-1.0, 1.0},
                      {0.0, 3.0},
                      "{x0}: {kind}",
                      {"proved"},
                      {{-0.123456789, 0.123456789, 0.1, 0.30000004, 0.0, 0.0, 0, 7}}};
  const auto json = nlohmann::json::parse(map_values_json(map, {0.1, 0.9, 0.2, 0.95}, 800.0, 400.0));
  const auto& cell = json.at("cells").at(0);
  CHECK(cell.at(0) == "-0.12345");
  CHECK(cell.at(1) == "0.12345");
  // The double next to 0.1 is above it; five digits hold nothing between it and 0.10001.
  CHECK(std::stod(cell.at(2).get<std::string>()) >= 0.1);
  CHECK(std::stod(cell.at(3).get<std::string>()) <= 0.30000004);
  CHECK(cell.at(5) == 7);
  CHECK(json.at("plot").at("left") == doctest::Approx(80.0));
  CHECK(json.at("plot").at("right") == doctest::Approx(720.0));
  CHECK(json.at("plot").at("top") == doctest::Approx(20.0));
  CHECK(json.at("plot").at("bottom") == doctest::Approx(320.0));
  CHECK(json.at("x").at("range").at(0) == -1.0);
}

}  // namespace
}  // namespace veritrack::reports::page
