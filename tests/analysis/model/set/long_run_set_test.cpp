// Tubes in the long run: long_run_set.cpp, declared in tube_set.hpp. Runs of a filter are compared with what
// is proved of its long run in tests/certificates/model/built_in_tracker_test.cpp.
#include <doctest/doctest.h>

#include <cmath>

#include "analysis/model/set/tube_set.hpp"
#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack::model {
namespace {

TEST_CASE("no long run without bounds of a covariance, without tubes, or when the time is over") {
  const test::Example loop(test::phase_locked_loop());
  const TrackedTone tone = test::tone_of(loop.tracker);
  CHECK_FALSE(prove_long_run_set(tone, loop.model, {}, {}).has_value());
  TubeSet set;
  set.tubes.resize(1);
  set.tubes.front().levels = {0.01};
  CHECK_FALSE(prove_long_run_set(tone, loop.model, set, {}).has_value());
  set.tubes.front().tube.covariance_high = {PhaseSeries{}};
  CHECK_FALSE(prove_long_run_set(tone, loop.model, set, search::Deadline(0.0)).has_value());
}

TEST_CASE(
    "the way into the long run: down the levels around it, between its bounds, and down its own levels") {
  ProvedTube around;
  around.levels = {1.0, 0.5};
  around.shrinking = {0.9};
  ProvedTube inner;
  inner.levels = {0.5, 0.125};
  inner.shrinking = {0.8};
  CHECK_FALSE(std::isfinite(samples_until_long_run(around, inner, 0)));
  inner.entry = LongRunEntry{0.5, 7.0};
  // ceil(ln 2 / -ln 0.9) = 7, ceil(ln 7 / ln 2) = 3, ceil(ln 4 / -ln 0.8) = 7.
  CHECK(samples_until_long_run(around, inner, 0) == 10.0);
  CHECK(samples_until_long_run(around, inner, 1) == 17.0);
}

}  // namespace
}  // namespace veritrack::model
