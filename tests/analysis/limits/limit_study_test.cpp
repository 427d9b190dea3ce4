#include "analysis/limits/limit_study.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace veritrack::limits {
namespace {

LimitPoint point(double decibels, double ratio) {
  return {decibels, 2.0, 2.0 * ratio, 0.0, 0.0};
}

TEST_CASE("the threshold is where the last stretch near the bound begins") {
  CHECK(decibels_above_bound(point(0.0, 10.0)) == doctest::Approx(10.0));
  CHECK(threshold_of({point(0.0, 1.1), point(3.0, 2.0), point(6.0, 1.2), point(9.0, 1.0)}) == 6.0);
  CHECK(threshold_of({point(0.0, 1.0), point(3.0, 1.2)}) == 0.0);
  CHECK_FALSE(threshold_of({point(0.0, 1.0), point(3.0, 1.3)}).has_value());
  CHECK_FALSE(threshold_of({point(0.0, std::numeric_limits<double>::quiet_NaN())}).has_value());
}

TEST_CASE("a few runs of the study: both trackers, every ratio, errors and bounds that fall") {
  const auto walks = study_random_walks(20);
  REQUIRE(walks.size() == 12);
  for (const RandomWalkSeries& series : walks) {
    REQUIRE(series.points.size() == studied_decibels().size());
    for (std::size_t i = 1; i < series.points.size(); ++i) {
      CHECK(series.points[i].bound < series.points[i - 1].bound);
    }
    if (series.channels == Channels::quadrature) {
      CHECK(series.points.back().error < series.points.front().error);
    }
  }
  const auto over_time = study_errors_over_time(20);
  REQUIRE(over_time.size() == 8);
  // The more process noise a tracker assumes of a constant frequency, the larger its error in the end.
  CHECK(over_time[0].mean_square.back() < over_time[3].mean_square.back());
  CHECK(over_time[4].mean_square.back() < over_time[7].mean_square.back());
}

}  // namespace
}  // namespace veritrack::limits
