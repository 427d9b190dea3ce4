#include "papers/reproductions/limit_report.hpp"

#include <doctest/doctest.h>

#include <string>

#include "papers/reproductions/limit_figures.hpp"

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
  // Ten runs decide little, and it says so at the top.
  const std::string warning = undecided_thresholds(study);
  CHECK(warning.find("10 runs are too few for ") == 0);
  CHECK(document.find("\n\n*" + warning + "*\n\n") != std::string::npos);
  CHECK(with_picture(draw_random_walks(study.random_walks)).svg.find("</svg>") != std::string::npos);
  CHECK(with_picture(draw_errors_over_time(study.over_time)).svg.find("</svg>") != std::string::npos);
}

TEST_CASE("what the report says of thresholds and lost runs is what was simulated") {
  LimitStudy study = simulate_limits(2);
  for (limits::RandomWalkSeries& series : study.random_walks) {
    for (limits::LimitPoint& point : series.points) {
      point.error = point.bound * (point.decibels < 9.0 ? 4.0 : 1.0);
      point.standard_error = 0.01 * point.bound;
      point.lost = 0.5;
    }
  }
  CHECK(undecided_thresholds(study).empty());
  const std::string document = limit_document(study);
  CHECK(document.find("the threshold is 9 dB for the quadrature tracker and 9 dB") != std::string::npos);
  CHECK(document.find("50.0 ± 35.4 %") != std::string::npos);
  for (limits::RandomWalkSeries& series : study.random_walks) {
    series.points.back().error = 10.0 * series.points.back().bound;
  }
  CHECK(limit_document(study).find("the threshold is above 30 dB") != std::string::npos);
  for (limits::RandomWalkSeries& series : study.random_walks) {
    series.points.back().standard_error = 10.0 * series.points.back().bound;
  }
  const std::string noisy = limit_document(study);
  CHECK(noisy.find("the threshold is undecided, 9 dB or higher for") != std::string::npos);
  CHECK(noisy.find("2 runs are too few for 12 of the 12 thresholds") != std::string::npos);
}

TEST_CASE("a single run says that its errors are unknown") {
  const std::string document = limit_document(simulate_limits(1));
  CHECK(document.find("dB ± unknown") != std::string::npos);
  CHECK(document.find("nan") == std::string::npos);
}

}  // namespace
}  // namespace veritrack::reports
