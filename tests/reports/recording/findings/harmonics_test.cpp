#include "reports/recording/findings/detectors.hpp"

#include <doctest/doctest.h>

#include "tests/reports/recording/findings/defective_tone.hpp"

namespace veritrack::reports {
namespace {

using test::examined;
using test::made;
using test::MadeTone;
using test::names;

TEST_CASE("harmonics are found, and only they, with their share") {
  test::for_each_kind([](int channels, double decibels) {
    for (const int order : {2, 3, 5}) {
      MadeTone tone;
      tone.channels = channels;
      tone.decibels = decibels;
      tone.added = [order](std::size_t, double phase) { return 0.05 * std::cos(order * phase + 0.5); };
      const std::vector<Finding> found = examined(made(tone), channels);
      INFO(channels, " channels, ", decibels, " dB, order ", order, ": ", names(found));
      REQUIRE(names(found) == "harmonics");
      CHECK(found.front().where.samples() > 20000);
      CHECK(found.front().is_signal);
    }
  });
}

TEST_CASE("the formula that is the remedy takes the finding away") {
  MadeTone tone;
  tone.decibels = 80.0;
  tone.added = [](std::size_t, double phase) { return 0.05 * std::cos(3.0 * phase + 0.5); };
  certificates::SignalAssumptions assume = test::audio_assumptions();
  assume.has_signal_key = true;
  const std::vector<Finding> found = examined(made(tone), 1, assume);
  REQUIRE(names(found) == "harmonics");
  CHECK(found.front().sees.find("the third with 5 % of the tone's amplitude (0.25 % of its power)") !=
        std::string::npos);
  INFO(found.front().remedy);
  CHECK(found.front().remedy.find("signal = 'A*cos(phi) + 0.05*A*cos(3*phi + 0.5)'") != std::string::npos);
  assume.signal = {{1, 1.0}, {3, std::polar(0.05, 0.5)}};
  CHECK(names(examined(made(tone), 1, assume)) == "nothing");
}

TEST_CASE("a filter that is the remedy takes the finding away") {
  // A resonator at the tone: poles at radius 0.99, zeros at 0 Hz and half the sample rate.
  MadeTone tone;
  tone.decibels = 60.0;
  tone.added = [](std::size_t, double phase) { return 0.05 * std::cos(3.0 * phase); };
  std::vector<RecordedSample> recording = made(tone);
  double x1 = 0.0;
  double x2 = 0.0;
  double y1 = 0.0;
  double y2 = 0.0;
  for (RecordedSample& sample : recording) {
    const double y =
        0.01 * (sample.in_phase - x2) + 2.0 * 0.99 * std::cos(test::radians(440.0)) * y1 - 0.99 * 0.99 * y2;
    x2 = x1;
    x1 = sample.in_phase;
    y2 = y1;
    y1 = y;
    sample.in_phase = y;
  }
  recording.erase(recording.begin(), recording.begin() + 2000);
  const std::vector<Finding> found = examined(recording, 1);
  // Of 5 % it leaves 0.05 %, which is below the smallest part that counts.
  CHECK(names(found) == "nothing");
}

}  // namespace
}  // namespace veritrack::reports
