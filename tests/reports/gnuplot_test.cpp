#include "reports/gnuplot.hpp"

#include <doctest/doctest.h>

#include <string>

namespace {

using veritrack::reports::FigureError;
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

TEST_CASE("the version names the program") {
  CHECK(veritrack::reports::gnuplot_version().rfind("gnuplot 5.", 0) == 0);
}

}  // namespace
