#include "reports/figures.hpp"

#include <doctest/doctest.h>

#include "tests/certificates/test_design.hpp"

namespace {

using namespace veritrack;

TEST_CASE("a certificate has its three figures, with captions that carry units") {
  const auto figures = reports::draw_figures(test::certificate());
  REQUIRE(figures.size() == 3);
  for (const reports::Figure& figure : figures) {
    CHECK(figure.svg.find("</svg>") != std::string::npos);
    CHECK(figure.caption.find("rad/sample") != std::string::npos);
    CHECK(figure.svg.find("<title>" + figure.title + "</title>") != std::string::npos);
    CHECK(figure.title.size() > 10);
  }
}

TEST_CASE("the bounds that the error is compared with are in the figure") {
  const auto figures =
      reports::draw_figures(test::certificate({{"[require]", "[require]\nfrequency_error_below = 0.05"}}));
  const std::string& svg = figures.at(1).svg;
  CHECK(svg.find(">required<") != std::string::npos);
  // Far below everything else: in words.
  CHECK(svg.find("(2.45), printed") == std::string::npos);
  CHECK(svg.find("(2.45), errata") == std::string::npos);
  CHECK(figures[1].caption.find("(2.45), printed: ≈ 2.2") != std::string::npos);
  CHECK(figures[1].caption.find("(2.45), errata: ≈ ") != std::string::npos);
  CHECK(svg.find("certified in the long run") != std::string::npos);
  CHECK(figures.at(2).svg.find("in the long run") != std::string::npos);
}

TEST_CASE("starts that had to be followed are mapped") {
  const auto figures = reports::draw_figures(
      test::certificate({{"initial_frequency_error = 0.005", "initial_frequency_error = 0.3"}}));
  REQUIRE(figures.size() == 4);
  CHECK(figures.back().file == "capture.svg");
  CHECK(figures.back().caption.starts_with("The assumed starts, followed"));
  CHECK(figures[2].svg.find("certified, assumed starts") != std::string::npos);
}

TEST_CASE("a long run is thinned out, and says so") {
  const auto figures = reports::draw_figures(test::certificate({{"samples = 60", "samples = 5000"}}));
  CHECK(figures.front().caption.find("One sample in 3") != std::string::npos);
  CHECK(figures.front().svg.size() < 200000);
}

TEST_CASE("without a run there are no figures") {
  auto certificate = test::certificate();
  certificate.simulation.trajectory.clear();
  CHECK(reports::draw_figures(certificate).empty());
}

TEST_CASE("a run that leaves the finite numbers is drawn as far as it goes") {
  auto certificate = test::certificate();
  certificate.simulation.trajectory[30].filtered_state.setConstant(std::nan(""));
  CHECK(reports::draw_figures(certificate).size() == 3);
}

}  // namespace
