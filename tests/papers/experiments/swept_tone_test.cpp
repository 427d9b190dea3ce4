#include "papers/experiments/swept_tone.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "papers/experiments/repeated_runs.hpp"
#include "trackers/signals/test_signals.hpp"

namespace veritrack::experiments {
namespace {

TEST_CASE("the stand-in is the signal la-scala-1994") {
  const std::vector<double> frequencies = frequencies_of(kStandIn);
  const auto samples = trackers::make_signal("la-scala-1994", {.samples = kStandIn.samples});
  REQUIRE(frequencies.size() == samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    CHECK(frequencies[k] == samples[k].frequency);
  }
}

TEST_CASE("both signals have what is known of the published one: a slew in [0, 0.04] that reaches 0.04") {
  for (const SweptTone& tone : {kStandIn, kFitted}) {
    const std::vector<double> frequencies = frequencies_of(tone);
    double largest = 0.0;
    for (std::size_t k = 1; k < frequencies.size(); ++k) {
      const double slew = frequencies[k] - frequencies[k - 1];
      CHECK(slew >= 0.0);
      largest = std::max(largest, slew);
    }
    CHECK(largest <= 0.04 + 1e-12);
    CHECK(largest > 0.036);
  }
}

TEST_CASE("the start's error is 0.01, or up to 20 %") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const ToneRun close = tone_run({kFitted, FrequencyStart::close, 0.01}, seed);
    CHECK(close.start == doctest::Approx(close.frequency.front() - 0.01));
    const ToneRun far = tone_run({kFitted, FrequencyStart::uniform, 0.01}, seed);
    CHECK(std::fabs(far.start / far.frequency.front() - 1.0) <= 0.2);
    CHECK(far.in_phase == close.in_phase);  // the same noise
  }
}

TEST_CASE("without noise, started exactly at a constant frequency, nothing errs") {
  const SweptTone constant{0.5, 0.0, 1e-9, 2.0, 60};
  ToneRun run = tone_run({constant, FrequencyStart::close, 0.0}, 1);
  run.start = 0.5;
  CHECK(squared_errors({run}, {1e-3, 1e-3, 0.01, 0.0}, 0.0).front() < 1e-20);
  CHECK(squared_errors({run}, NotchInput::quadrature, {0.9, 0.0, 2.0}).front() == 0.0);
  // The sums are those of the estimates.
  const ToneRun noisy = tone_run({kFitted, FrequencyStart::close, 0.01}, 3);
  const trackers::ToneModel<double> design{0.0005, 0.0005, 0.01, 0.05};
  const std::vector<double> estimates = tracked(noisy, design, 0.35);
  double sum = 0.0;
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    sum += (estimates[k] - noisy.frequency[k]) * (estimates[k] - noisy.frequency[k]);
  }
  CHECK(squared_errors({noisy}, design, 0.35).front() == doctest::Approx(sum));
}

TEST_CASE("searches find designs better than those printed") {
  const auto runs = tone_runs({kFitted, FrequencyStart::uniform, 0.01}, 10);
  const auto mean = [](const std::vector<double>& sums) { return summary_of(sums).mean; };
  const double printed = mean(squared_errors(runs, {0.0023, 0.0023, 0.05, 0.01}, 0.35));
  CHECK(mean(squared_errors(runs, best_tracker(runs, 0.01, 0.35), 0.35)) < 0.5 * printed);
  CHECK(mean(squared_errors(runs, NotchInput::quadrature, best_notch(runs, NotchInput::quadrature))) <
        0.5 * printed);
}

}  // namespace
}  // namespace veritrack::experiments
