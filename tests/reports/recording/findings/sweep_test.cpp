#include "reports/recording/findings/detectors.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "tests/reports/recording/findings/defective_tone.hpp"

namespace veritrack::reports {
namespace {

using test::examined;
using test::made;
using test::MadeTone;
using test::names;

TEST_CASE("a sweep faster than the slew is found, and only it, where it is") {
  test::for_each_kind([](int channels, double decibels) {
    MadeTone tone;
    tone.channels = channels;
    tone.decibels = decibels;
    // 300 Hz in a second.
    tone.hertz = [](std::size_t k) {
      return 440.0 + 300.0 * std::clamp((static_cast<double>(k) - 16000.0) / 8000.0, 0.0, 1.0);
    };
    const std::vector<Finding> found = examined(made(tone), channels);
    INFO(channels, " channels, ", decibels, " dB: ", names(found));
    REQUIRE(names(found) == "fast sweep");
    CHECK(std::fabs(static_cast<double>(found.front().where.kept().front().first) - 16000.0) < 1000.0);
    CHECK(std::fabs(static_cast<double>(found.front().where.kept().back().last) - 24000.0) < 1000.0);
    CHECK(found.front().is_slew);
    // The remedy: the slew that it names, and a random walk, of which no slew is assumed.
    certificates::SignalAssumptions assume = test::audio_assumptions();
    assume.slew = 5e-5;
    CHECK(names(examined(made(tone), channels, assume)) == "nothing");
    assume.slew.reset();
    CHECK(names(examined(made(tone), channels, assume)) == "nothing");
  });
}

TEST_CASE("a tone that a long look would smear is followed through a steep sweep") {
  MadeTone tone;
  tone.channels = 2;
  tone.samples = 20000;
  tone.hertz = [](std::size_t k) {
    return 320.0 + 850.0 * std::fabs(std::sin(static_cast<double>(k) / 4000.0));
  };
  CHECK(names(examined(made(tone), 2)) == "fast sweep");
}

}  // namespace
}  // namespace veritrack::reports
