#include "reports/model/model_figures.hpp"

#include <doctest/doctest.h>

#include "certificates/model/model_sets.hpp"
#include "reports/model/tube_figure.hpp"
#include "tests/certificates/model/model_certificates.hpp"

namespace veritrack::reports {
namespace {

TEST_CASE("a proved loop has three figures, with captions that carry units and say what is not proved") {
  const certificates::Certificate& certificate = test::loop_certificate();
  const std::vector<Figure> figures = draw_figures(certificate);
  REQUIRE(figures.size() == 3);
  CHECK(figures[0].file == "reach.svg");
  CHECK(figures[1].file == "tube.svg");
  CHECK(figures[2].file == "bias.svg");
  for (const Figure& figure : figures) {
    CAPTURE(figure.file);
    CHECK(figure.svg.find("</svg>") != std::string::npos);
    CHECK(figure.svg.find("nan") == std::string::npos);
    CHECK(figure.caption.find("Hz") != std::string::npos);
    CHECK(figure.caption.find("rove") != std::string::npos);
    CHECK(figure.svg.size() < 400000);
  }
  CHECK(figures[0].svg.find("assumed noise") != std::string::npos);
  CHECK(figures[0].svg.find("largest noise") == std::string::npos);  // it was not asked for
  CHECK(figures[1].caption.find("for noise of at most 0.02 signal units") != std::string::npos);
  CHECK(draw_figures(certificate)[1].svg == figures[1].svg);
}

TEST_CASE("only what is proved is drawn") {
  certificates::Certificate certificate = test::loop_certificate();
  certificates::ModelSets sets = model_sets(certificate);
  sets.assumed->tubes.is_complete = false;  // tubes of a part of the band are drawn
  certificate.particulars = sets;
  CHECK(draw_model_figures(certificate)[0].script.find("assumed noise") != std::string::npos);
  sets.assumed->tubes.tubes.clear();
  certificate.particulars = sets;
  std::vector<Figure> figures = with_pictures(draw_model_figures(certificate));
  REQUIRE(figures.size() == 3);
  CHECK(figures[1].caption.find("without noise") != std::string::npos);
  CHECK(figures[0].svg.find("assumed noise") == std::string::npos);
  sets.starts.tubes.is_complete = false;
  sets.starts.tubes.tubes.clear();
  sets.cells.clear();
  certificate.particulars = sets;
  CHECK(draw_model_figures(certificate).empty());
}

}  // namespace
}  // namespace veritrack::reports
