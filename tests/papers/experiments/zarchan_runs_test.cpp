#include "papers/experiments/zarchan_runs.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace veritrack::experiments {
namespace {

TEST_CASE("samples, truths and deviations of each filter") {
  for (const ZarchanFilter filter : {ZarchanFilter::phase, ZarchanFilter::known_amplitude,
                                     ZarchanFilter::oscillator, ZarchanFilter::squared_frequency}) {
    const ZarchanRun run = zarchan_runs({filter, -1.0, 2.0}, 1).front();
    REQUIRE(run.size() == 200);
    const double truth = run.back().truth.at(frequency_state(filter));
    CHECK(truth == (filter == ZarchanFilter::squared_frequency ? 1.0 : -1.0));
    CHECK(run.back().deviation.at(frequency_state(filter)) > 0.0);
  }
  CHECK(zarchan_runs({ZarchanFilter::phase, 1.0, 2.0, 1.0, 0.0, 1.0}, 1).front().size() == 20);
}

TEST_CASE("the filter that sees only the square of the frequency does the same for either first sign") {
  const ZarchanRun positive = zarchan_runs({ZarchanFilter::oscillator, 1.0, 2.0}, 1).front();
  const ZarchanRun negative = zarchan_runs({ZarchanFilter::oscillator, 1.0, -2.0}, 1).front();
  for (std::size_t k = 0; k < positive.size(); ++k) {
    CHECK(positive[k].state[2] == -negative[k].state[2]);
    CHECK(positive[k].state[0] == negative[k].state[0]);
  }
}

TEST_CASE("runs in parts are the runs at once") {
  const ZarchanExperiment experiment{ZarchanFilter::oscillator, 1.0, 2.0};
  const auto all = zarchan_runs(experiment, 5);
  const auto later = zarchan_runs(experiment, 2, 3);
  REQUIRE(later.size() == 2);
  for (std::size_t i = 0; i < later.size(); ++i) {
    CHECK(later[i].back().state == all[i + 3].back().state);
  }
}

TEST_CASE("with little noise every run settles, and only from the given time on") {
  const ZarchanExperiment experiment{ZarchanFilter::known_amplitude, 1.0, 2.0, 1e-3};
  for (const ZarchanRun& run : zarchan_runs(experiment, 5)) {
    CHECK(stays_within(run, 0.1, 1, 0.002, 15.0));
    CHECK_FALSE(stays_within(run, 0.1, 1, 0.002, 0.0));
    CHECK_FALSE(stays_within(run, 0.1, 1, 0.002, 15.0, -1.0));
  }
  CHECK_FALSE(stays_within({}, 0.1, 1, 0.01, 15.0));
}

}  // namespace
}  // namespace veritrack::experiments
