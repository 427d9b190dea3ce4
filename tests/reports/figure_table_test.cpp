#include "reports/figure_table.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "reports/gnuplot.hpp"

namespace veritrack::reports {
namespace {

FigureTable small() {
  FigureTable table("run", {"line, drawn", "time [s]", "value [rad/sample]"});
  table.add({std::string("a \"b\""), 0.0, 0.1});
  table.gap();
  table.add({std::string("c"), 1.0, std::nan("")});
  return table;
}

TEST_CASE("the file has a header, all digits, quotes where they are needed, and CRLF") {
  CHECK(small().csv() == "\"line, drawn\",time [s],value [rad/sample]\r\n\"a \"\"b\"\"\",0,0.1\r\nc,1,\r\n");
  FigureTable table("t", {"x"});
  table.add({1.0 / 3.0});
  table.add({std::numeric_limits<double>::infinity()});
  CHECK(table.csv() == "x\r\n0.3333333333333333\r\n\r\n");
  CHECK(table.size() == 2);
}

TEST_CASE("the block has nine digits, gaps, and words that cannot end it") {
  CHECK(small().block() == "$run << END\n\"a b\" 0 0.1\n\n\"c\" 1 NaN\nEND\n");
  FigureTable table("t", {"x", "y"});
  CHECK(table.block() == "$t << END\nNaN NaN\nEND\n");
  table.add({1.0 / 3.0, std::string("END\nEND\n")});
  table.next_index();
  CHECK(table.block() == "$t << END\n0.333333333 \"ENDEND\"\n\n\nEND\n");
}

TEST_CASE("a row of another length is refused") {
  FigureTable table("t", {"x", "y"});
  CHECK_THROWS_AS(table.add({1.0}), std::invalid_argument);
}

TEST_CASE("whatever is in a text, gnuplot takes it for a text") {
  CHECK(gnuplot_text("rad/s") == "'rad/s'");
  CHECK(gnuplot_text("it's\nso") == "'it''s so'");
  const std::string picture =
      run_gnuplot(gnuplot_style(200) + "set xlabel " + gnuplot_text("m'; print 'said'; #") + "\nplot 0\n");
  CHECK(picture.find("m'; print 'said'; #") != std::string::npos);
  CHECK(picture.find("\nsaid") == std::string::npos);
}

}  // namespace
}  // namespace veritrack::reports
