#include "analysis/model/step/place_store.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>

#include "analysis/model/tube/tube_proposal.hpp"
#include "analysis/model/tube/tube_verification.hpp"
#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack::model {
namespace {

using rigor::Verdict;
using test::Example;

TEST_CASE("what is kept is what was made for the same cell and slew, up to a number of cells") {
  const TrackerModel model{};
  const Tube tube{};
  PlaceStore store(model, tube, 2);
  int made = 0;
  const auto at = [&](const TubeCell& cell, double slew) {
    return *store.at<int>(model, tube, cell, slew, [&] { return ++made; });
  };
  const TubeCell a{0.25, 0.125, 0.0, 1.0};
  const TubeCell b{0.25, 0.0625, 0.0, 1.0};
  CHECK(at(a, 0.0) == 1);
  CHECK(at(a, 0.0) == 1);
  CHECK(at(a, 1e-5) == 2);
  CHECK(at(b, 0.0) == 3);
  CHECK(at(b, 0.0) == 4);  // the third is not kept
  CHECK(at(a, 0.0) == 1);
  CHECK(at(a, 1e-5) == 2);
}

TEST_CASE("of another tube, model or kind of value, and of numbers that are none, nothing is handed out") {
  const TrackerModel model{};
  const auto constant = [](double value) {
    PhaseSeries series;
    series.coefficients.emplace_back(1, value);
    return series;
  };
  Tube tube;
  tube.frequency = 0.3;
  tube.half_width = 0.04;
  tube.turns.push_back(0);
  tube.curve.push_back(constant(1.0));
  tube.shape.push_back(constant(0.5));
  PlaceStore store(model, tube, 100);
  int made = 0;
  const TubeCell a{0.25, 0.125, 0.0, 1.0};
  const auto make = [&] { return ++made; };
  const auto at = [&](const TrackerModel& of, const Tube& in, const TubeCell& cell, double variant) {
    return *store.at<int>(of, in, cell, variant, make);
  };
  CHECK(at(model, tube, a, 0.0) == 1);
  const Tube same = tube;
  CHECK(at(model, same, a, 0.0) == 1);
  const TrackerModel another{};
  CHECK(at(another, tube, a, 0.0) == 2);
  // The tube changes where it stands, in one number.
  for (double* number : {&tube.frequency, &tube.half_width, &tube.amplitude}) {
    const double before = *number;
    *number *= 1.0 + 1e-15;
    REQUIRE(*number != before);
    const int known = made;
    CHECK(at(model, tube, a, 0.0) == known + 1);
    CHECK(at(model, tube, a, 0.0) == known + 2);  // and is not kept
    *number = before;
  }
  tube.shape[0].coefficients[0][0] = {0.5, 1e-300};
  const int of_shape = made;
  CHECK(at(model, tube, a, 0.0) == of_shape + 1);
  tube = same;
  tube.covariance_high.push_back(constant(1.0));
  CHECK(at(model, tube, a, 0.0) == of_shape + 2);
  tube = same;
  CHECK(at(model, tube, a, 0.0) == 1);
  // NaN is before and after every number: it must not be taken for one of them.
  const int of_numbers = made;
  CHECK(at(model, tube, a, NAN) == of_numbers + 1);
  CHECK(at(model, tube, a, NAN) == of_numbers + 2);
  CHECK(at(model, tube, {NAN, 0.125, 0.0, 1.0}, 0.0) == of_numbers + 3);
  CHECK(at(model, tube, {0.25, 0.125, NAN, 1.0}, 0.0) == of_numbers + 4);
  CHECK(at(model, tube, a, 0.0) == 1);
  CHECK(*store.at<double>(model, tube, a, 0.0, [] { return 2.5; }) == 2.5);
  CHECK(*store.at<double>(model, tube, a, 0.0, [] { return 3.5; }) == 2.5);
  CHECK(at(model, tube, a, 0.0) == 1);
}

TEST_CASE("places are as many as the memory they take allows") {
  Tube tube;
  tube.curve.resize(3);
  tube.shape.resize(6);
  const std::size_t few = places_in(tube, 1e6);
  CHECK(few > 50);
  tube.covariance_low.resize(6);
  tube.covariance_high.resize(6);
  CHECK(places_in(tube, 1e6) < few / 2);
  CHECK(places_in(tube, 1.0) == 0);
}

TEST_CASE("verdicts, cells and frequency errors are the same with a store as without one") {
  const Example loop(test::phase_locked_loop());
  TubeSettings settings;
  settings.shape.objective = ShapeObjective::largest_noise;
  settings.largest_curve_error = 1e-7;
  const TubeProposal proposal = propose_tube(test::tone_of(loop.tracker), 0.3, 0.04, settings);
  REQUIRE(proposal.tube.has_value());
  const Tube& tube = *proposal.tube;
  PlaceStore store(loop.model, tube, 60);  // fewer than there are cells
  int proved = 0;
  for (const double slew : {0.0, 1e-6}) {
    for (const double noise : {0.0, 0.02, 0.04, 0.08}) {
      for (const double radius : {0.003, 0.0045, 0.013}) {
        CAPTURE(slew);
        CAPTURE(noise);
        CAPTURE(radius);
        LevelQuestion question{radius, noise};
        question.slew = slew;
        const LevelResult alone = verify_level(loop.model, tube, question, {});
        const LevelResult stored = verify_level(loop.model, tube, question, {}, &store);
        CHECK(alone.verdict == stored.verdict);
        CHECK(alone.cells == stored.cells);
        if (alone.verdict == Verdict::proved) {
          ++proved;
          CHECK(alone.frequency_error.upper() == stored.frequency_error.upper());
          CHECK(alone.frequency_error.lower() == stored.frequency_error.lower());
        }
        const double growth = sampled_growth(loop.model, tube, question, 16);
        CHECK(may_shrink(loop.model, tube, question, 16, growth, &store));
        CHECK(std::isfinite(growth) !=
              may_shrink(loop.model, tube, question, 16, growth * (1.0 - 1e-12), &store));
        CHECK_FALSE(may_shrink(loop.model, tube, question, 16, NAN, &store));
      }
    }
  }
  CHECK(proved > 4);
}

}  // namespace
}  // namespace veritrack::model
