#include "reports/quadrature/region_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using quadrature::Region;
using quadrature::RegionCell;
using quadrature::SimulatedBasin;
using reports::MapRectangle;
using rigor::Interval;
using rigor::Verdict;

RegionCell cell(double frequency_lower, double frequency_upper, double phase_lower, double phase_upper,
                Verdict verdict) {
  RegionCell result;
  result.starts = {Interval(0.0), Interval::from_bounds(phase_lower, phase_upper),
                   Interval::from_bounds(frequency_lower, frequency_upper)};
  result.verdict = verdict;
  return result;
}

/// Over [-1, 1] x [-2, 2]: everything locks but the last column of the grid.
SimulatedBasin basin() {
  SimulatedBasin result{Interval::from_bounds(-2.0, 2.0), Interval::from_bounds(-1.0, 1.0), 8, 10, {}};
  for (int k = 0; k < 80; ++k) {
    result.locks.push_back(k % 10 == 9 ? 0 : 1);
  }
  return result;
}

bool holds(const std::vector<MapRectangle>& rectangles, double frequency, double phase) {
  return std::any_of(rectangles.begin(), rectangles.end(), [&](const MapRectangle& r) {
    return r.frequency_lower <= frequency && frequency <= r.frequency_upper && r.phase_lower <= phase &&
           phase <= r.phase_upper;
  });
}

TEST_CASE("joined rectangles cover what the given ones cover, with fewer") {
  test::Random random(41);
  std::vector<MapRectangle> given;
  for (int i = 0; i < 16; ++i) {
    for (int j = 0; j < 16; ++j) {
      if (random.uniform() < 0.7) {
        given.push_back({0.1 * i, 0.1 * (i + 1), 0.2 * j, 0.2 * (j + 1)});
      }
    }
  }
  const auto fewer = reports::joined(given);
  CHECK(fewer.size() < given.size() / 2);
  const auto area = [](const std::vector<MapRectangle>& rectangles) {
    double sum = 0.0;
    for (const MapRectangle& r : rectangles) {
      sum += (r.frequency_upper - r.frequency_lower) * (r.phase_upper - r.phase_lower);
    }
    return sum;
  };
  CHECK(area(fewer) == doctest::Approx(area(given)));
  for (int n = 0; n < 2000; ++n) {
    const double frequency = random.uniform(0.0, 1.6);
    const double phase = random.uniform(0.0, 3.2);
    CHECK(holds(fewer, frequency, phase) == holds(given, frequency, phase));
  }
  std::reverse(given.begin(), given.end());
  CHECK(reports::joined(given).size() == fewer.size());
}

TEST_CASE("four quarters become one") {
  const auto one = reports::joined({{0, 1, 0, 1}, {1, 2, 1, 2}, {0, 1, 1, 2}, {1, 2, 0, 1}});
  REQUIRE(one.size() == 1);
  CHECK(one[0].frequency_upper == 2.0);
  CHECK(one[0].phase_upper == 2.0);
  CHECK(reports::joined({}).empty());
}

TEST_CASE("the map shows the three verdicts, and its caption the shares with units") {
  Region region;
  region.cells = {cell(-1.0, 0.0, -2.0, 2.0, Verdict::proved), cell(0.0, 0.65, -2.0, 2.0, Verdict::undecided),
                  cell(0.65, 1.0, -2.0, 2.0, Verdict::refuted)};
  const auto figure = reports::with_picture(reports::draw_region_map(region, basin()));
  CHECK(figure.file == "region.svg");
  CHECK(figure.svg.find("</svg>") != std::string::npos);
  for (const char* words : {"proved captured", "proved to lock at a wrong frequency", "undecided",
                            "basin in simulation", "rad/sample", "phase error at the start, rad"}) {
    CHECK(figure.svg.find(words) != std::string::npos);
  }
  // 5 of the 9 columns that lock have their grid points in the proved cell, 3 in the undecided one.
  CHECK(figure.caption.find("Proved: 55.6 % of the simulated basin; undecided: 33.3 %") != std::string::npos);
}

TEST_CASE("a share says 100 % only when it is all") {
  Region region;
  region.cells = {cell(-1.0, 1.0, -2.0, 1.99, Verdict::proved),
                  cell(-1.0, 1.0, 1.99, 2.0, Verdict::undecided)};
  CHECK(reports::draw_region_map(region, basin()).caption.find("Proved: 100 %") != std::string::npos);
  region.cells.push_back(cell(-1.0, -0.89, -2.0, -1.74, Verdict::undecided));  // a single grid point
  CHECK(reports::draw_region_map(region, basin()).caption.find("Proved: 98.6 %") != std::string::npos);
}

TEST_CASE("a map without cells or without a basin can be drawn, and says so") {
  const auto empty = reports::with_picture(reports::draw_region_map(Region{}, basin()));
  CHECK(empty.svg.find("</svg>") != std::string::npos);
  CHECK(empty.caption.find("Proved: 0 %") != std::string::npos);
  auto none = basin();
  std::fill(none.locks.begin(), none.locks.end(), static_cast<char>(0));
  CHECK(reports::draw_region_map(Region{}, none).caption.find("none of these starts locks") !=
        std::string::npos);
}

}  // namespace
