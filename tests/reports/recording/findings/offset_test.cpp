#include "reports/recording/findings/detectors.hpp"

#include <doctest/doctest.h>

#include "tests/reports/recording/findings/defective_tone.hpp"

namespace veritrack::reports {
namespace {

using test::examined;
using test::made;
using test::MadeTone;
using test::names;

TEST_CASE("a DC offset is found, and only it, and its size") {
  test::for_each_kind([](int channels, double decibels) {
    MadeTone tone;
    tone.channels = channels;
    tone.decibels = decibels;
    tone.added = [](std::size_t, double) { return 0.05; };
    const std::vector<Finding> found = examined(made(tone), channels);
    INFO(channels, " channels, ", decibels, " dB: ", names(found));
    REQUIRE(names(found) == "DC offset");
    CHECK(found.front().where.samples() > 30000);
    CHECK((decibels < 200.0 || found.front().sees.find("0.05") != std::string::npos));
    CHECK(found.front().is_signal);
  });
}

TEST_CASE("an offset that comes late is found where it is") {
  MadeTone tone;
  tone.added = [](std::size_t k, double) { return k < 20000 ? 0.0 : 0.15; };
  const std::vector<Finding> found = examined(made(tone), 1);
  REQUIRE(names(found) == "DC offset");
  CHECK(std::fabs(static_cast<double>(found.front().where.kept().front().first) - 20000.0) < 2500.0);
}

TEST_CASE("the key that is the remedy takes the finding away") {
  MadeTone tone;
  tone.added = [](std::size_t, double) { return -0.15; };
  certificates::SignalAssumptions assume = test::audio_assumptions();
  assume.has_signal_key = true;
  const std::vector<Finding> found = examined(made(tone), 1, assume);
  REQUIRE(names(found) == "DC offset");
  CHECK(found.front().remedy.find("signal = 'A*cos(phi) - 0.15'") != std::string::npos);
  assume.signal = {{0, -0.15}, {1, 1.0}};
  CHECK(names(examined(made(tone), 1, assume)) == "nothing");
}

}  // namespace
}  // namespace veritrack::reports
