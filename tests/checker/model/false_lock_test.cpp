// The distance to a false lock, by the formulas.
#include "checker/model/false_lock.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/model/tube/false_lock.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/model/model_sets.hpp"
#include "tests/checker/model/proposed_certificate.hpp"

namespace veritrack::checker {
namespace {

using Json = nlohmann::json;

constexpr double kPi = 3.14159265358979323846;

Json loop_of(const std::string& step, const std::string& frequency = "w") {
  return {{"samples", {"y1", "y2"}},
          {"parameters", Json::array({{{"name", "k"}, {"formula", "0.1"}}})},
          {"angles", {"theta"}},
          {"frequency", frequency},
          {"signal", {"A*cos(phi)", "A*sin(phi)"}},
          {"states", {"theta", "w"}},
          {"step", step}};
}

double half_distance(const Json& model, double lowest = 0.25, double highest = 0.5) {
  const ModelRecursion recursion(read_json(model.dump()));
  return half_distance_to_false_lock({&recursion, one, false}, Ball(lowest), Ball(highest)).near();
}

/// pi over half the distance: the largest degree.
double degree(const std::string& w, const std::string& frequency = "w") {
  return kPi / half_distance(loop_of("theta' = theta + w\nw' = " + w, frequency));
}

TEST_CASE("a detector that does not see half a turn has a false lock at half the distance, and so on") {
  const auto is = [](double found, double expected) { return std::abs(found - expected) < 1e-9; };
  CHECK(is(degree("w + k*y1*sin(theta + w)"), 1.0));
  CHECK(is(degree("w + k*y1*sin(2*theta)"), 2.0));
  CHECK(is(degree("w + k*y1*y2*sin(theta)*cos(theta)"), 2.0));
  CHECK(is(degree("w + k*sin(theta)^4"), 4.0));
  CHECK(is(degree("w + k*sin(theta + theta + theta)"), 3.0));
  CHECK(is(degree("w + k*tan(theta)"), 3.0));  // of a sum with a denominator, and tan(theta) has 2
  CHECK(is(degree("w*1 - k*w*theta/3"), 2.0));
  // A limit that has to be shown is not a part of the step.
  CHECK(is(degree("w + k*y1*sin(theta + w)\nlimit = stays_within(sin(3*theta), -2, 2)"), 1.0));
  // Two states whose signs change together.
  CHECK(is(degree("w + k*w*theta"), 2.0));
  CHECK(degree("w + k*atan(sin(theta)/cos(theta))") >= 2.0);
  CHECK(degree("w + k*atan2(2*sin(theta)*cos(theta), cos(theta)^2 - sin(theta)^2)") >= 2.0);
  CHECK(degree("w + k*sqrt(sin(theta)^2) + k*sqrt(cos(theta)^2)") >= 4.0);
  CHECK(degree("w + k*sin(3*sin(theta))") >= 2.0);
  // |x| does not see a sign, and is no more than a function of x.
  CHECK(degree("w + k*abs(sin(theta))") >= 2.0);
  CHECK(is(degree("w + k*abs(tan(theta))"), degree("w + k*sqrt(tan(theta))")));
  // A turn of w is half a turn of the frequency.
  CHECK(is(degree("w + k*y1*sin(theta + w)", "w/2"), 2.0));
  CHECK(is(degree("w + k*y1*sin(theta + w)", "2*w"), 2.0));
  CHECK(is(degree("w + k*y1*sin(theta + w)", "w*k"), 1.0));
}

TEST_CASE("each partial turn that a step does not see is counted") {
  // Found by trying: the least m for which the detector has the period 2 pi/m, against the degree.
  struct Detector {
    const char* formula;
    double (*value)(double);
  };
  const std::vector<Detector> detectors = {
      {"sin(theta)", [](double x) { return std::sin(x); }},
      {"sin(theta)*cos(theta)", [](double x) { return std::sin(x) * std::cos(x); }},
      {"sin(theta)/cos(theta)", [](double x) { return std::tan(x); }},
      {"cos(theta)^2", [](double x) { return std::cos(x) * std::cos(x); }},
      {"4*cos(theta)^3 - 3*cos(theta)", [](double x) { return std::cos(3 * x); }},
      {"sin(theta)*cos(theta)*(cos(theta)^2 - sin(theta)^2)", [](double x) { return std::sin(4 * x) / 4; }},
      {"exp(sin(5*theta))", [](double x) { return std::exp(std::sin(5 * x)); }},
      {"1/(2 + cos(theta)^2*sin(theta)^2)",
       [](double x) { return 1 / (2 + std::pow(std::cos(x) * std::sin(x), 2)); }}};
  for (const Detector& detector : detectors) {
    CAPTURE(detector.formula);
    int period = 0;
    for (int m = 1; m <= 8; ++m) {
      double most = 0.0;
      for (int i = 0; i < 40; ++i) {
        const double x = 0.1 + 0.157 * i;
        most = std::max(most, std::abs(detector.value(x) - detector.value(x + 2 * kPi / m)));
      }
      period = most < 1e-6 ? m : period;
    }
    CHECK(period >= 1);
    CHECK(degree(std::string("w + k*(") + detector.formula + ")") >= period - 1e-9);
  }
}

TEST_CASE("one channel does not tell a frequency from its image, and harmonics count") {
  Json loop = loop_of("theta' = theta + w\nw' = w + k*y1*sin(theta + w)");
  CHECK(std::abs(half_distance(loop) - kPi) < 1e-9);
  // Two channels that say the same are one.
  loop["signal"] = {"A*cos(phi)", "2*A*cos(phi)"};
  CHECK(half_distance(loop) == 0.25);
  CHECK(std::abs(half_distance(loop, 2.0, 3.0) - (kPi - 3.0)) < 1e-9);
  loop["signal"] = {"A*cos(phi)", "A*sin(phi + 0.3)"};
  CHECK(std::abs(half_distance(loop) - kPi) < 1e-9);
  loop["signal"] = {"A*cos(phi) + 0.1*A*cos(3*phi)", "A*sin(phi)"};
  CHECK(std::abs(half_distance(loop) - 0.25 / 6.0) < 1e-9);
  loop["samples"] = {"y1"};
  loop["signal"] = {"A*sin(phi)"};
  CHECK(half_distance(loop) == 0.25);
  CHECK_FALSE(half_distance(loop, 0.0, 0.5) > 0.0);
}

TEST_CASE("of a filter its model is counted") {
  const Json filter = {{"samples", {"y"}},
                       {"parameters", Json::array()},
                       {"angles", Json::array()},
                       {"frequency", "w"},
                       {"signal", {"A*cos(phi)"}},
                       {"ekf",
                        {{"states", {"x", "v", "w"}},
                         {"predict", "x' = cos(w)*x - sin(w)*v\nv' = sin(w)*x + cos(w)*v\nw' = w"},
                         {"measure", {"x"}},
                         {"Q", {{"1", "0", "0"}, {"0", "1", "0"}, {"0", "0", "1"}}},
                         {"R", {{"1"}}}}}};
  CHECK(half_distance(filter) == 0.25);
  Json two = filter;
  two["samples"] = {"y", "z"};
  two["signal"] = {"A*cos(phi)", "A*sin(phi)"};
  two["ekf"]["measure"] = {"x", "v"};
  two["ekf"]["R"] = Json::array({Json::array({"1", "0"}), Json::array({"0", "1"})});
  CHECK(std::abs(half_distance(two) - kPi / 2.0) < 1e-9);
}

TEST_CASE("the program finds no larger distance than the checker does") {
  const rigor::UpwardRounding upward;
  for (const char* name :
       {"type-2-pll.toml", "gnss-pll.toml", "odrive-pll.toml", "kalmanf.toml", "sogi-fll-third-harmonic.toml",
        "sogi-fll-from-rest.toml", "pei-tseng-notch.toml", "quadrature-notch.toml", "aranovskiy.toml",
        "single-channel-ekf.toml", "quadrature-ekf.toml", "third-harmonic-ekf.toml",
        "zarchan-third-filter.toml", "zarchan-fourth-filter.toml"}) {
    CAPTURE(name);
    const test::ProposedModel proposed(name);
    const certificates::ModelAssumptions& assume = certificates::model_tables(proposed.design).assume;
    const rigor::Interval band = certificates::band_of(assume);
    const double program =
        model::half_distance_to_false_lock(certificates::proved_model(proposed.model, assume), band);
    const Json json = proposed.design_json();
    const ModelRecursion recursion(read_json(json.at("model").dump()));
    const Ball found = half_distance_to_false_lock(
        {&recursion, Ball::hull(Ball(assume.amplitude[0].nearest), Ball(assume.amplitude[1].nearest)), false},
        Ball(band.lower()), Ball(band.upper()));
    CHECK(program > 0.001);
    CHECK(certainly_at_most(Ball(program) * Ball(1.0 - 1e-12), found));
  }
}

TEST_CASE("with two channels a signal moves on at every phase, however wide the range of its amplitude") {
  const ModelRecursion recursion(read_json(loop_of("theta' = theta + w\nw' = w + k*y1*sin(theta)").dump()));
  const Ball wide = Ball::hull(Ball(0.5), Ball(4.0));
  CHECK(half_distance_to_false_lock({&recursion, wide, true}, Ball(0.01), Ball(0.02)).near() > 3.0);
}

}  // namespace
}  // namespace veritrack::checker
