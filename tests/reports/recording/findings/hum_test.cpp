#include "reports/recording/findings/detectors.hpp"

#include <doctest/doctest.h>

#include "tests/reports/recording/findings/defective_tone.hpp"

namespace veritrack::reports {
namespace {

using test::examined;
using test::made;
using test::MadeTone;
using test::names;

TEST_CASE("mains hum is found, and only it, and of which mains") {
  test::for_each_kind([](int channels, double decibels) {
    for (const double mains : {50.0, 60.0}) {
      MadeTone tone;
      tone.channels = channels;
      tone.decibels = decibels;
      tone.added = [mains](std::size_t k, double) {
        return 0.06 * std::cos(test::radians(mains) * static_cast<double>(k));
      };
      const std::vector<Finding> found = examined(made(tone), channels);
      INFO(channels, " channels, ", decibels, " dB, ", mains, " Hz: ", names(found));
      REQUIRE(names(found) == "hum");
      CHECK(found.front().sees.find(mains < 55.0 ? "at 50 Hz" : "at 60 Hz") != std::string::npos);
    }
  });
}

TEST_CASE("without a sample rate no line is the mains'; a tone at 50 Hz is none") {
  MadeTone tone;
  tone.added = [](std::size_t k, double) {
    return 0.06 * std::cos(test::radians(50.0) * static_cast<double>(k));
  };
  CHECK(names(examined(made(tone), 1, test::audio_assumptions(), std::nullopt)).find("hum") ==
        std::string::npos);
  MadeTone grid;
  grid.hertz = [](std::size_t) { return 50.0; };
  certificates::SignalAssumptions assume = test::audio_assumptions();
  assume.frequency = {test::radians(45.0), test::radians(55.0)};
  CHECK(names(examined(made(grid), 1, assume)) == "nothing");
}

TEST_CASE("low noise of all frequencies, as of breath, is no hum") {
  MadeTone tone;
  tone.added = [random = trackers::RandomStream(5), low = 0.0](std::size_t, double) mutable {
    low = 0.97 * low + 0.01 * random.normal();
    return low;
  };
  CHECK(names(examined(made(tone), 1)).find("hum") == std::string::npos);
}

}  // namespace
}  // namespace veritrack::reports
