#include "analysis/model/tube/frequency_cells.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/analysis/model/example_recursions.hpp"

namespace veritrack::model {
namespace {

TEST_CASE("bands are covered without gaps") {
  const TrackedTone tone = test::tone_of(test::phase_locked_loop());
  BandSettings settings;
  const BandProposal band = propose_band(tone, 0.15, 0.5, settings);
  CHECK(band.is_complete);
  REQUIRE(band.cells.size() > 1);
  CHECK(reasons_of(band).empty());
  double end = 0.15;
  for (const TubeProposal& cell : band.cells) {
    CHECK(cell.frequency - cell.half_width == doctest::Approx(end).epsilon(1e-12));
    end = cell.frequency + cell.half_width;
    CHECK(cell.curve_error <= settings.tube.largest_curve_error);
    CHECK(cell.steady_state.turns == std::vector<int>{0, 1});
  }
  CHECK(end == doctest::Approx(0.5).epsilon(1e-12));
}

TEST_CASE("cells that are proposed and turned down are halved, while that is allowed") {
  const test::ExampleTracker example = test::phase_locked_loop();
  BandSettings settings;
  settings.widest = 0.1;
  int asked = 0;
  settings.decided = [&](const TubeProposal& cell, bool may_be_halved) {
    ++asked;
    return cell.half_width < 0.03 || !may_be_halved;
  };
  const BandProposal band = propose_band(test::tone_of(example), 0.25, 0.35, settings);
  CHECK(band.is_complete);
  CHECK(asked == 3);
  REQUIRE(band.cells.size() == 2);
  CHECK(band.cells[0].half_width == doctest::Approx(0.025));
  CHECK(band.cells[1].frequency == doctest::Approx(0.325));
  // Where narrow ones are turned down, too, the next ones are not divided.
  settings.decided = [&](const TubeProposal&, bool) { return false; };
  const BandProposal none = propose_band(test::tone_of(example), 0.25, 0.35, settings);
  CHECK(none.cells.size() <= 6);
}

TEST_CASE("the part of a band without a steady state is named") {
  // Starts far off the tone, at a bandwidth that does not pull in.
  test::ExampleTracker example = test::phase_locked_loop();
  example.start = [](double omega) { return std::vector<double>{omega < 0.4 ? omega : 1.5, 0.0}; };
  BandSettings settings;
  settings.narrowest = 0.05;
  settings.tube.steady_state.samples = 20000;
  settings.tube.steady_state.largest_mean_error = 0.15;
  const BandProposal band = propose_band(test::tone_of(example), 0.2, 0.6, settings);
  CHECK_FALSE(band.is_complete);
  REQUIRE(reasons_of(band).size() >= 1);
  CHECK(band.cells.front().outcome == TubeOutcome::proposed);
  CHECK(band.cells.back().outcome == TubeOutcome::no_steady_state);
  CHECK(reasons_of(band).back().find("between 0.4") != std::string::npos);
  CHECK_THROWS_AS((void)propose_band(test::tone_of(example), 0.5, 0.4, settings), std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::model
