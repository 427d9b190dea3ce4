#include "reports/quadrature/region_values.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace veritrack::reports {
namespace {

using rigor::Interval;
using rigor::Verdict;

TEST_CASE("a cell says what is proved of it, with its amplitudes where they differ, the weakest kinds last") {
  const quadrature::SimulatedBasin basin{
      Interval::from_bounds(-2.0, 2.0), Interval::from_bounds(-1.0, 1.0), 1, 1, {1}};
  quadrature::Region region;
  for (const Verdict verdict : {Verdict::proved, Verdict::refuted, Verdict::undecided}) {
    quadrature::RegionCell cell;
    cell.starts = {Interval(0.0), Interval::from_bounds(-2.0, 2.0), Interval::from_bounds(-1.0, 1.0)};
    cell.verdict = verdict;
    cell.result.samples = 9;
    region.cells.push_back(cell);
  }
  region.cells.push_back(region.cells[1]);
  region.cells.back().whole = false;
  auto json = nlohmann::json::parse(region_values(region, basin));
  const auto kind_of = [&](std::size_t cell) {
    return json.at("kinds").at(json.at("cells").at(cell).at(4).get<std::size_t>()).get<std::string>();
  };
  CHECK(kind_of(0) == "proved to be captured within {samples} samples");
  CHECK(kind_of(1).starts_with("all of them are proved to lock at a wrong frequency"));
  CHECK(kind_of(2) == "undecided");
  CHECK(kind_of(3).starts_with("the start in the middle"));
  CHECK(json.at("cells").at(2).at(4) > json.at("cells").at(3).at(4));
  CHECK(json.at("sentence").get<std::string>().find("the exact amplitude") != std::string::npos);
  region.cells[0].starts.amplitude_error = Interval::from_bounds(-0.1, 0.1);
  json = nlohmann::json::parse(region_values(region, basin));
  CHECK(json.at("sentence").get<std::string>().find("amplitude error from {z0} to {z1}") !=
        std::string::npos);
  CHECK(table_of_region(region).size() == 4);
}

}  // namespace
}  // namespace veritrack::reports
