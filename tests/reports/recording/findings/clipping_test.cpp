#include "reports/recording/findings/detectors.hpp"

#include <doctest/doctest.h>

#include "tests/reports/recording/findings/defective_tone.hpp"

namespace veritrack::reports {
namespace {

using test::examined;
using test::made;
using test::MadeTone;
using test::names;

TEST_CASE("clipped peaks are found, and nothing else in them, on floats and on steps") {
  test::for_each_kind([](int channels, double decibels) {
    for (const double steps : {1e9, 32768.0, 128.0}) {
      MadeTone tone;
      tone.channels = channels;
      tone.decibels = decibels;
      tone.distorted = [steps](std::size_t, RecordedSample& sample) {
        const auto clipped = [steps](double value) {
          return std::round(std::clamp(value, -0.9, 0.9) * steps) / steps;
        };
        sample.in_phase = clipped(sample.in_phase);
        sample.quadrature = clipped(sample.quadrature);
      };
      const std::vector<Finding> found = examined(made(tone), channels);
      INFO(channels, " channels, ", decibels, " dB, ", steps, " steps: ", names(found));
      REQUIRE(names(found) == "clipping");
      CHECK(found.front().where.samples() > 4000);
    }
  });
}

TEST_CASE("one side, and a part of the recording") {
  MadeTone tone;
  tone.distorted = [](std::size_t k, RecordedSample& sample) {
    sample.in_phase = k < 20000 ? sample.in_phase : std::min(sample.in_phase, 0.95);
  };
  const std::vector<Finding> found = examined(made(tone), 1);
  REQUIRE(names(found) == "clipping");
  CHECK(found.front().where.kept().front().first >= 20000);
  CHECK(found.front().sees.find("stop at 0.95,") != std::string::npos);
}

TEST_CASE("a lower gain, which is the remedy, takes the finding away") {
  MadeTone tone;
  tone.amplitude = [](std::size_t) { return 0.85; };
  tone.distorted = [](std::size_t, RecordedSample& sample) {
    sample.in_phase = std::clamp(sample.in_phase, -0.9, 0.9);
  };
  CHECK(names(examined(made(tone), 1)) == "nothing");
}

}  // namespace
}  // namespace veritrack::reports
