#include "reports/model/response_figure.hpp"

#include <doctest/doctest.h>

#include "certificates/model/model_sets.hpp"
#include "reports/figures.hpp"
#include "tests/certificates/model/model_certificates.hpp"

namespace veritrack::reports {
namespace {

TEST_CASE("a loop that is certified by gains has one figure: a step and noise") {
  const certificates::Certificate certificate = test::two_channel_certificate();
  const std::vector<Figure> figures = draw_figures(certificate);
  REQUIRE(figures.size() == 1);
  CHECK(figures[0].file == "response.svg");
  CHECK(figures[0].caption.find("not proved") != std::string::npos);
  CHECK(figures[0].caption.find("Hz") != std::string::npos);
  CHECK(figures[0].svg.find("</svg>") != std::string::npos);
  CHECK(figures[0].svg.find("time after the step, ms") != std::string::npos);
  REQUIRE(figures[0].data.size() == 2);
  CHECK(figures[0].data[0].csv().find("\r\n0,0\r\n") != std::string::npos);  // at first nothing is followed
  CHECK(figures[0].data[1].size() == 241);
  CHECK(draw_figures(test::two_channel_certificate("kp = 2.1, ki = 0.03")).empty());
}

}  // namespace
}  // namespace veritrack::reports
