#include "reports/model/model_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "certificates/design/design_reader.hpp"
#include "certificates/design/request_error.hpp"
#include "reports/model/map_figure.hpp"

namespace veritrack::reports {
namespace {

using certificates::Design;
using certificates::map_model;
using certificates::ModelMap;
using certificates::ModelMapRequest;
using certificates::RequestError;

Design loop() {
  return certificates::read_design(R"(name = "a loop"
tracker = "model"

[model]
samples = 'y'
parameters = { wn = 0.08, zeta = 0.7071, ki = 'wn^2', kp = '2*zeta*wn' }
states = ['theta', 'w']
angles = ['theta']
units = { w = 'rad/sample' }
step = '''
e      = -2*y*sin(theta + w)
w'     = w + ki*e
theta' = theta + w + kp*e
'''
frequency = 'w'
start = { theta = 0, w = 'omega' }

[assume]
amplitude = 1
frequency = [1.0, 1.2]
noise = 0.02
)",
                                   "loop.toml");
}

/// Of 3 x 3 cells, small enough to be followed in a moment.
const ModelMap& small_map() {
  static const ModelMap map = [] {
    ModelMapRequest request;
    request.cells = 3;
    request.x_range = 0.4;
    request.y_range = 0.04;
    const certificates::ModelMapResult result = map_model(loop(), request);
    REQUIRE(result.found);
    return *result.found;
  }();
  return map;
}

TEST_CASE("defaults: an angle and the state of the frequency, the middle of the band") {
  const ModelMap& map = small_map();
  CHECK(map.x.name == "theta");
  CHECK(map.x.unit == "rad");
  CHECK(map.y.name == "w");
  CHECK(map.y.unit == "rad/sample");
  CHECK(map.frequency_text == "1.1");
  CHECK(rigor::contains(map.frequency, 1.1));
  CHECK(map.noise == 0.0);
  CHECK(map.x.certified > 0.05);
  CHECK(map.grid.x.back() == 0.4);
  REQUIRE(map.cells.size() == 9);
  CHECK(map.cells[4].is_proved);
  CHECK(map.proved() >= 3);
  CHECK(map.proved() + map.simulated_only() <= 9);
  CHECK(map.frequency_error > 0.0);
  CHECK(map.frequency_error < 0.5);
  CHECK(map.settled_error <= map.frequency_error);
}

TEST_CASE("what a design does not have is refused, with the key that it is about") {
  const auto key_of = [](const ModelMapRequest& request) {
    try {
      (void)map_model(loop(), request);
    } catch (const RequestError& error) {
      return error.key() + ": " + error.what();
    }
    return std::string("nothing was refused");
  };
  ModelMapRequest request;
  request.frequency = "2";
  CHECK(key_of(request).starts_with("assume.frequency: --at 2: not in the assumed band"));
  request.frequency = "1e";
  CHECK(key_of(request).starts_with(": --at 1e: no number"));
  request = {};
  request.y = "u";
  CHECK(key_of(request).starts_with("model.states: --y u: no such state"));
  request.y = "theta";
  request.x = "theta";
  CHECK(key_of(request).find("two different states") != std::string::npos);
}

TEST_CASE("the document begins with the answer and names the hypotheses") {
  const ModelMap& map = small_map();
  const Figure figure = with_picture(draw_model_map(map));
  const std::string document = model_map_document(loop(), map, figure);
  CHECK(document.starts_with("# "));
  CHECK(document.find("of the starts are PROVED to lock (" + std::to_string(map.proved()) + " of 9 cells)") <
        80);
  for (const char* words :
       {"**PROVED**: In exact arithmetic", "amplitude 1 ", "constant frequency 1.1 rad/sample",
        "without noise", "at any phase of the signal", "angles counted modulo 2π", "The cells", "rounding"}) {
    CHECK_MESSAGE(document.find(words) != std::string::npos, words);
  }
  ModelMap none = map;
  for (auto& cell : none.cells) {
    cell = {};
  }
  const std::string nothing = model_map_document(loop(), none, figure);
  CHECK(nothing.starts_with("# 0 % of the starts are PROVED"));
  CHECK(nothing.find("**PROVED**") == std::string::npos);
}

TEST_CASE("the figure has shades for proved cells, all below a round number of samples") {
  const ModelMap& map = small_map();
  const std::vector<std::size_t> steps = capture_steps(map);
  REQUIRE_FALSE(steps.empty());
  CHECK(steps.size() <= 5);
  CHECK(steps.back() >= map.longest());
  CHECK((steps.size() == 1 || steps[steps.size() - 2] < map.longest()));
  for (const std::size_t longest : {0U, 1U, 4U, 99U, 100U, 101U, 1596U, 60000U}) {
    ModelMap other = map;
    other.cells.assign(9, {});
    other.cells[0] = {true, longest};
    const std::vector<std::size_t> of_other = capture_steps(other);
    CHECK(of_other.size() <= 5);
    CHECK(of_other.back() >= longest);
  }
  const Figure figure = with_picture(draw_model_map(map));
  CHECK(figure.file == "region.svg");
  CHECK(figure.svg.find("</svg>") != std::string::npos);
  CHECK(figure.svg.find("edge of the certified set") != std::string::npos);
  CHECK(figure.caption.find("theta, rad") != std::string::npos);
  CHECK(figure.svg == with_picture(draw_model_map(map)).svg);
}

TEST_CASE("a unit is whatever the design says, and nothing but a text") {
  ModelMap map = small_map();
  map.y.unit = "m'; print 'said'; # <b> *x*";
  const Figure figure = with_picture(draw_model_map(map));
  CHECK(figure.svg.find("m'; print 'said'; # &lt;b>") != std::string::npos);
  CHECK(figure.svg.find("\nsaid") == std::string::npos);
  CHECK(figure.caption.find("\\<b\\> \\*x\\*") != std::string::npos);
  CHECK(figure.values.find("m'; print 'said'; # <b> *x* in w: {kind}.") != std::string::npos);
}

TEST_CASE("cells as a table and as numbers") {
  const ModelMap& map = small_map();
  const std::string table = model_map_cells(map);
  CHECK(std::count(table.begin(), table.end(), '\n') == 10);
  CHECK(table.find("PROVED") != std::string::npos);
  const std::string json = model_map_json(loop(), map);
  CHECK(json.find("\"tube\"") != std::string::npos);
  CHECK(json.find("\"levels\"") != std::string::npos);
}

}  // namespace
}  // namespace veritrack::reports
