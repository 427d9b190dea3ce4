#include "reports/model/model_figures.hpp"

#include <doctest/doctest.h>

#include "analysis/model/set/amplitude_parts.hpp"
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

TEST_CASE("what each cell tolerates is a figure of its own, where it was looked for") {
  certificates::Certificate certificate = test::loop_certificate();
  certificates::ModelSets sets = model_sets(certificate);
  sets.noise = sets.assumed;
  double own = 0.0625;
  for (model::ProvedTube& proved : sets.noise->tubes.tubes) {
    proved.own_noise = own;
    own *= 2.0;
  }
  certificate.particulars = sets;
  std::vector<Figure> figures = with_pictures(draw_model_figures(certificate));
  REQUIRE(figures.size() == 4);
  CHECK(figures[1].file == "tolerance.svg");
  CHECK(figures[1].caption.starts_with("Noise: the noise that the tracker tolerates"));
  CHECK(figures[1].svg.find("noise, signal units") != std::string::npos);
  REQUIRE(figures[1].data.size() == 1);
  CHECK(figures[1].data[0].size() == 2 * sets.noise->tubes.tubes.size());
  CHECK(figures[1].data[0].csv().find(",0.0625\r\n") != std::string::npos);
  sets.slew = sets.noise;
  certificate.particulars = sets;
  CHECK(draw_model_figures(certificate)[1].caption.starts_with("Noise: "));  // no slew of a cell is known
  for (model::ProvedTube& proved : sets.slew->tubes.tubes) {
    proved.own_slew = 0x1p-16;
  }
  certificate.particulars = sets;
  figures = with_pictures(draw_model_figures(certificate));
  CHECK(figures[1].caption.starts_with("Above, the noise that the tracker tolerates"));
  CHECK(figures[1].svg.find("slew, rad/sample per sample") != std::string::npos);
  CHECK(figures[1].data.size() == 2);
  // One cell without a number: there is no line to draw.
  sets.noise->tubes.tubes.front().own_noise = 0.0;
  sets.slew.reset();
  certificate.particulars = sets;
  CHECK(draw_model_figures(certificate).size() == 3);
}

TEST_CASE("of parts of the amplitudes the least is drawn at each frequency, in whichever part it is") {
  certificates::Certificate certificate = test::loop_certificate();
  const certificates::ModelSets whole = model_sets(certificate);
  const auto figures_with = [&](std::size_t least, double share) {
    certificates::ModelSets sets = whole;
    for (model::ProvedSet* set : {&sets.starts, &*sets.assumed}) {
      std::vector<model::TubeSet> parts(3, set->tubes);
      parts[least].tubes.front().levels.front() *= share;
      set->tubes = model::join_amplitudes(parts, {{0.995, 0.999}, {0.999, 1.001}, {1.001, 1.005}});
      REQUIRE(set->tubes.is_complete);
    }
    certificate.particulars = sets;
    return with_pictures(draw_model_figures(certificate));
  };
  const std::vector<Figure> figures = figures_with(0, 0.9);
  REQUIRE(figures.size() == 3);
  CHECK(figures[0].caption.find(", the least of all parts of the amplitudes") != std::string::npos);
  CHECK(figures[0].data[0].size() ==
        2 * (whole.starts.tubes.tubes.size() + whole.assumed->tubes.tubes.size()));
  CHECK(figures[0].script == figures_with(2, 0.9)[0].script);
  CHECK(figures[0].script != figures_with(0, 1.0)[0].script);
  CHECK(figures[1].caption.find("and amplitudes from 0.999 to 1.001") != std::string::npos);
  CHECK(figures[1].caption.find("the noise and the amplitude that push") != std::string::npos);
  CHECK(draw_figures(test::loop_certificate())[0].caption.find("part of the amplitudes") ==
        std::string::npos);
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
  sets.slices.clear();
  certificate.particulars = sets;
  CHECK(draw_model_figures(certificate).empty());
}

}  // namespace
}  // namespace veritrack::reports
