#include "analysis/theorems/other_results/song_grizzle.hpp"

#include <doctest/doctest.h>

#include "tests/analysis/theorems/simulated_errors.hpp"
#include "tests/analysis/theorems/tracker_inputs.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Verdict;

}  // namespace

TEST_CASE("the printed assumptions are refuted: no Gramian at z = 0, no bound on F") {
  const auto derivation = theorems::evaluate_song_grizzle(test::without_leak(test::kTable32[0]));
  CHECK(derivation.id == "song-grizzle");
  CHECK(test::find_condition(derivation, "gramian").verdict == Verdict::refuted);
  CHECK(test::find_condition(derivation, "bounded-F").verdict == Verdict::refuted);
}

TEST_CASE("local: the constants by the formulas of the thesis in double, and starts at the bound decay") {
  test::Random random(91);
  for (const test::TableRow& row : test::kTable32) {
    CAPTURE(row.figure);
    INFO("seed ", test::kSeed + 91);
    theorems::TrackerInput input = test::without_leak(row);
    input.theorem_2_9.measurement_noise = Interval(0.0);
    const auto derivation = theorems::evaluate_song_grizzle_local(input);
    const auto value = [&](const std::string& name) { return test::value_of(derivation, name).lower(); };
    const double p = value("p");
    const double q = value("q");
    const double r = value("r");
    const double e = value("prediction_error");
    const double phi = 0.5 * value("curvature") * p * p * q * q;
    CHECK(value("phi") == doctest::Approx(phi).epsilon(1e-9));
    const double varphi = -1.0 / (r * q * q) + p * e * phi * (2.0 * p * q * value("a_bar") + phi * e);
    CHECK(value("gamma") == doctest::Approx(-varphi).epsilon(1e-6));
    CHECK(varphi < 0.0);
    const double start = value("initial_frequency_error_bound");
    test::TestDesign design = test::table_design(row);
    design.epsilon = 0.0;
    const auto errors = test::simulated_errors(design, start, 0.0, 100, random);
    CHECK(errors.back().norm() < start);
    input.theorem_2_9.initial_error = Interval(0.99 * start);
    CHECK(theorems::evaluate_song_grizzle_local(input).verdict == Verdict::proved);
    input.theorem_2_9.measurement_noise = Interval(1e-12);
    CHECK(theorems::evaluate_song_grizzle_local(input).verdict == Verdict::refuted);
  }
}
