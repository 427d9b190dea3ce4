#include "papers/limits/limit_study.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace veritrack::limits {
namespace {

LimitPoint point(double decibels, double ratio, double error_of_ratio = 0.0) {
  return {decibels, 2.0, 2.0 * ratio, 2.0 * error_of_ratio, 0.0};
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST_CASE("the threshold is where the last stretch near the bound begins") {
  CHECK(decibels_above_bound(point(0.0, 10.0)) == doctest::Approx(10.0));
  const Threshold late = threshold_of({point(0.0, 1.1), point(3.0, 2.0), point(6.0, 1.2), point(9.0, 1.0)});
  CHECK(late.is_decided());
  CHECK(late.at_most == 6.0);
  CHECK(threshold_of({point(0.0, 1.0), point(3.0, 1.2)}).at_most == 0.0);
  CHECK_FALSE(threshold_of({point(0.0, 1.0), point(3.0, 1.3)}).at_least.has_value());
  CHECK_FALSE(threshold_of({point(0.0, kNaN)}).at_least.has_value());
}

TEST_CASE("what is within two standard errors decides nothing") {
  // 1 dB is a ratio of 1.259.
  CHECK(nearness_of(point(0.0, 1.2, 0.02)) == Nearness::near);
  CHECK(nearness_of(point(0.0, 1.2, 0.04)) == Nearness::undecided);
  CHECK(nearness_of(point(0.0, 1.3, 0.04)) == Nearness::undecided);
  CHECK(nearness_of(point(0.0, 1.3, 0.01)) == Nearness::far);
  CHECK(nearness_of(point(0.0, 1.0, kNaN)) == Nearness::undecided);
  CHECK(nearness_of(point(0.0, kNaN, kNaN)) == Nearness::far);
  const Threshold open = threshold_of({point(0.0, 2.0), point(3.0, 1.2, 0.1), point(6.0, 1.0)});
  CHECK_FALSE(open.is_decided());
  CHECK(open.at_least == 3.0);
  CHECK(open.at_most == 6.0);
  const Threshold higher = threshold_of({point(0.0, 2.0), point(3.0, 1.2, 0.1)});
  CHECK(higher.at_least == 3.0);
  CHECK_FALSE(higher.at_most.has_value());
}

TEST_CASE("a single run has no standard error") {
  TrackingExperiment experiment;
  experiment.runs = 1;
  CHECK(std::isnan(simulate_tracking(experiment).standard_error));
  experiment.runs = 2;
  CHECK(simulate_tracking(experiment).standard_error > 0.0);
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
