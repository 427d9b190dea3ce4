#include "reports/gnuplot.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace {

using veritrack::reports::draw_pictures;
using veritrack::reports::FigureError;
using veritrack::reports::gnuplot_style;
using veritrack::reports::gnuplot_version;
using veritrack::reports::GnuplotScript;
using veritrack::reports::run_gnuplot;

TEST_CASE("a script becomes a picture, the same every time") {
  const std::string script = "set terminal svg\nplot sin(x)\n";
  const std::string picture = run_gnuplot(script);
  CHECK(picture.find("</svg>") != std::string::npos);
  CHECK(picture == run_gnuplot(script));
}

TEST_CASE("what gnuplot does not understand is an error of one line") {
  try {
    static_cast<void>(run_gnuplot("set terminal svg\nplot nonsense(\n"));
    FAIL("no exception");
  } catch (const FigureError& error) {
    CHECK(std::string(error.what()).find('\n') == std::string::npos);
    CHECK(std::string(error.what()).find("invalid expression") != std::string::npos);
  }
  CHECK_THROWS_AS(static_cast<void>(run_gnuplot("")), FigureError);
}

TEST_CASE("large pictures arrive whole") {
  std::string script = "set terminal svg\n$data << END\n";
  for (int i = 0; i < 50000; ++i) {
    script += std::to_string(i % 97) + "\n";
  }
  const std::string picture = run_gnuplot(script + "END\nplot $data with lines\n");
  CHECK(picture.size() > 500000);
  CHECK(picture.find("</svg>") != std::string::npos);
}

/// Three that leave much behind: a logarithmic axis, panels, a table, a name, a colour, a range.
std::vector<GnuplotScript> pictures() {
  return {{"first.svg", gnuplot_style(300) +
                            "set logscale y\nset xrange [1:3]\nname = 'mine'\n$data << END\n1 2\n3 4\nEND\n"
                            "plot $data with lines lw 3 dt 2 lc rgb '#777777' title name\n"},
          {"second.svg", gnuplot_style(400) +
                             "set multiplot layout 2,1\nset title 'a < b <end of picture>'\nplot sin(x)\n"
                             "set yrange [0:1]\nplot x**2 with points pt 7\nunset multiplot\n"},
          {"third.svg", gnuplot_style(200) + "plot cos(x) title exists('name') ? 'left behind' : 'new'\n"}};
}

TEST_CASE("one gnuplot draws the pictures that one for each draws, in any order") {
  std::vector<GnuplotScript> scripts = pictures();
  for (int turn = 0; turn < 3; ++turn) {
    std::rotate(scripts.begin(), scripts.begin() + 1, scripts.end());
    const std::vector<std::string> together = draw_pictures(scripts);
    REQUIRE(together.size() == scripts.size());
    for (std::size_t i = 0; i < scripts.size(); ++i) {
      CHECK(together[i] == run_gnuplot(scripts[i].text));
      CHECK(together[i].find("left behind") == std::string::npos);
    }
  }
  CHECK(draw_pictures({}).empty());
}

TEST_CASE("an error says which picture it is of") {
  for (const std::string wrong : {"set terminal svg\nplot nonsense(\n", "set terminal svg\n", "exit\n"}) {
    for (std::size_t i = 0; i < 3; ++i) {
      std::vector<GnuplotScript> scripts = pictures();
      scripts[i].text = wrong;
      const std::string name = scripts[i].name;
      try {
        static_cast<void>(draw_pictures(scripts));
        FAIL("no exception");
      } catch (const FigureError& error) {
        CHECK_MESSAGE(std::string(error.what()).rfind("figures need gnuplot: " + name + ": ", 0) == 0,
                      error.what());
      }
    }
  }
}

TEST_CASE("a picture says what drew it") {
  CHECK(gnuplot_version(run_gnuplot("set terminal svg\nplot sin(x)\n")).rfind("gnuplot 5.", 0) == 0);
  CHECK_THROWS_AS(static_cast<void>(gnuplot_version("<svg/>")), FigureError);
}

}  // namespace
