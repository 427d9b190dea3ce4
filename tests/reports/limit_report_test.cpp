#include "reports/limit_report.hpp"

#include <doctest/doctest.h>

#include <string>

#include "reports/limit_figures.hpp"

namespace veritrack::reports {
namespace {

TEST_CASE("the report of a few runs: the same twice, with a table for every walk and both figures") {
  const LimitStudy study = simulate_limits(10);
  const std::string document = limit_document(study);
  CHECK(document == limit_document(simulate_limits(10)));
  for (const char* words :
       {"What is compared", "It proves nothing", "over 10 runs", "Quadrature tracker, walk variance 1e-06",
        "Single-channel tracker, walk variance 0.001"}) {
    CAPTURE(words);
    CHECK(document.find(words) != std::string::npos);
  }
  CHECK(document.find("nan") == std::string::npos);
  CHECK(draw_random_walks(study.random_walks).svg.find("</svg>") != std::string::npos);
  CHECK(draw_errors_over_time(study.over_time).svg.find("</svg>") != std::string::npos);
}

TEST_CASE("what the report says of thresholds and lost runs is what was simulated") {
  LimitStudy study = simulate_limits(2);
  for (limits::RandomWalkSeries& series : study.random_walks) {
    for (limits::LimitPoint& point : series.points) {
      point.error = point.bound * (point.decibels < 9.0 ? 4.0 : 1.0);
      point.lost = 0.25;
    }
  }
  const std::string document = limit_document(study);
  CHECK(document.find("the threshold is 9 dB for the quadrature tracker and 9 dB") != std::string::npos);
  CHECK(document.find("25.0 %") != std::string::npos);
  for (limits::RandomWalkSeries& series : study.random_walks) {
    series.points.back().error = 10.0 * series.points.back().bound;
  }
  CHECK(limit_document(study).find("the threshold is above 30 dB") != std::string::npos);
}

}  // namespace
}  // namespace veritrack::reports
