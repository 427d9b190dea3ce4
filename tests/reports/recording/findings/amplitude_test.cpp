#include "reports/recording/findings/detectors.hpp"

#include <doctest/doctest.h>

#include "tests/reports/recording/findings/defective_tone.hpp"

namespace veritrack::reports {
namespace {

using test::examined;
using test::made;
using test::MadeTone;
using test::names;

TEST_CASE("an amplitude that drifts by a twentieth is found, and only that") {
  test::for_each_kind([](int channels, double decibels) {
    MadeTone tone;
    tone.channels = channels;
    tone.decibels = decibels;
    tone.amplitude = [](std::size_t k) { return 1.0 - 0.08 * static_cast<double>(k) / 40000.0; };
    const std::vector<Finding> found = examined(made(tone), channels);
    INFO(channels, " channels, ", decibels, " dB: ", names(found));
    CHECK(names(found) == "amplitude drift");
  });
}

TEST_CASE("the range that is the remedy takes the finding away") {
  MadeTone tone;
  tone.amplitude = [](std::size_t k) { return 1.0 - 0.2 * static_cast<double>(k) / 40000.0; };
  certificates::SignalAssumptions assume = test::audio_assumptions();
  assume.has_signal_key = true;
  const std::vector<Finding> found = examined(made(tone), 1, assume);
  REQUIRE(names(found) == "amplitude drift");
  INFO(found.front().remedy);
  CHECK(found.front().remedy.find("amplitude = [0.784, 1.02]") != std::string::npos);
  assume.amplitude = {0.784, 1.02};
  assume.amplitude_varies = true;
  CHECK(names(examined(made(tone), 1, assume)) == "nothing");
  assume.amplitude = {0.9, 1.02};
  CHECK(names(examined(made(tone), 1, assume)) == "amplitude drift");
}

}  // namespace
}  // namespace veritrack::reports
