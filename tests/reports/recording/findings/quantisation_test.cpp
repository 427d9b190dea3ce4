#include "reports/recording/findings/detectors.hpp"

#include <doctest/doctest.h>

#include "tests/reports/recording/findings/defective_tone.hpp"

namespace veritrack::reports {
namespace {

using test::examined;
using test::made;
using test::MadeTone;
using test::names;

TEST_CASE("coarse steps are found, and only they") {
  for (const int channels : {1, 2}) {
    for (const double decibels : {30.0, 40.0, 200.0}) {
      MadeTone tone;
      tone.channels = channels;
      tone.decibels = decibels;
      tone.distorted = [](std::size_t, RecordedSample& sample) {
        sample.in_phase = std::round(sample.in_phase * 16.0) / 16.0;
        sample.quadrature = std::round(sample.quadrature * 16.0) / 16.0;
      };
      const std::vector<Finding> found = examined(made(tone), channels);
      INFO(channels, " channels, ", decibels, " dB: ", names(found));
      REQUIRE(names(found) == "quantisation");
      CHECK(found.front().sees.find("steps of 0.0625") != std::string::npos);
      CHECK_FALSE(found.front().is_signal);
      // It is no Gaussian noise.
      certificates::SignalAssumptions assume = test::audio_assumptions();
      assume.noise.reset();
      assume.noise_deviation = 0.1;
      CHECK(examined(made(tone), channels, assume).front().is_signal);
    }
  }
}

TEST_CASE("noise of more than a step hides it; more bits, which is the remedy, have fine ones") {
  for (const auto& [decibels, steps] : {std::pair{15.0, 16.0}, std::pair{40.0, 4096.0}}) {
    MadeTone tone;
    tone.decibels = decibels;
    tone.distorted = [steps = steps](std::size_t, RecordedSample& sample) {
      sample.in_phase = std::round(sample.in_phase * steps) / steps;
    };
    CHECK(names(examined(made(tone), 1)) == "nothing");
  }
}

}  // namespace
}  // namespace veritrack::reports
