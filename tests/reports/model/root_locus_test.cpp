#include "reports/model/root_locus.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "certificates/design/request_error.hpp"
#include "tests/certificates/model/model_certificates.hpp"

namespace veritrack::reports {
namespace {

/// Two modes at three values; the last one is unstable.
certificates::RootLocus example() {
  certificates::RootLocus locus;
  locus.parameter = "kp";
  locus.given = 2.1;
  locus.frequency = 0.5;
  locus.is_in_frame = true;
  locus.points = {
      {1.0, {{0.5, 0.5}, {0.5, -0.5}}}, {2.0, {{0.9, 0.0}, {-0.8, 0.0}}}, {3.0, {{1.1, 0.0}, {0.0, 0.0}}}};
  locus.stable = {{1.0, 2.5}};
  return locus;
}

TEST_CASE("a root locus: the answer first, a line for each value, and what it is not") {
  const Figure figure = root_locus_figure(example());
  CHECK(figure.data.front().size() == 6);
  CHECK(figure.data.front().csv().find("0.9,0,9.49") != std::string::npos);  // -1/ln 0.9
  CHECK(figure.script.find("cos(t), sin(t)") != std::string::npos);
  const certificates::Design design = test::loop_design();
  std::string text = root_locus_document(design, example(), figure);
  CHECK(text.starts_with("# Stable for `kp` from 1 to 2.5 (computed, not proved)\n"));
  CHECK(
      text.find(
          "| `kp` | Largest multiplier, its size | Slowest time constant, samples | Least damping ratio |") !=
      std::string::npos);
  CHECK(text.find("The design has 2.1.") != std::string::npos);
  certificates::RootLocus other = example();
  other.is_in_frame = false;
  other.stable.clear();
  const Figure sizes = root_locus_figure(other);
  CHECK(sizes.script.find("cos(t), sin(t)") == std::string::npos);
  text = root_locus_document(design, other, sizes);
  CHECK(text.starts_with("# Stable for `kp` at none of these values"));
  other.is_in_frame = true;
  other.points = {other.points.back()};
  other.points.front().multipliers = {{1.1, 0.0}};
  CHECK(root_locus_figure(other).script.find("time constant") == std::string::npos);  // there is none to draw
  CHECK(text.find("damping") == std::string::npos);
  CHECK(text.find("not how it turns") != std::string::npos);
}

TEST_CASE("options of a map are refused beside --over") {
  MapRequest request;
  request.over = {"kp", 0.1, 1.0};
  request.cells = 5;
  CHECK_THROWS_AS((void)write_root_locus(test::loop_design(), request, std::filesystem::path("never-made")),
                  certificates::RequestError);
  CHECK_FALSE(std::filesystem::exists("never-made"));
}

}  // namespace
}  // namespace veritrack::reports
