#include "reports/recording/findings/recording_examiner.hpp"

#include <doctest/doctest.h>

#include "tests/reports/recording/findings/defective_tone.hpp"
#include "tests/support/random.hpp"

namespace veritrack::reports {
namespace {

using test::examined;
using test::made;
using test::MadeTone;
using test::names;

TEST_CASE("a tone in white noise has nothing to find, at any ratio, frequency and seed") {
  // About 15 000 blocks of 1600 samples with some 15 tests each: at 1e-6 a test, 0.2 findings are expected,
  // and these seeds have none.
  trackers::RandomStream random(test::kSeed);
  const auto runs = static_cast<std::uint64_t>(test::effort(75));
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    for (const int channels : {1, 2}) {
      for (const double decibels : {0.0, 10.0, 20.0, 40.0, 200.0}) {
        const double hertz = 320.0 + 860.0 * random.uniform();
        MadeTone tone;
        tone.channels = channels;
        tone.decibels = decibels;
        tone.seed = seed;
        tone.samples = 20000;
        tone.hertz = [hertz](std::size_t) { return hertz; };
        INFO("seed ", seed, ", ", channels, " channels, ", decibels, " dB, ", hertz, " Hz");
        CHECK(names(examined(made(tone), channels)) == "nothing");
      }
    }
  }
}

TEST_CASE("noise without a tone, and whole numbers of samples in a period, have nothing to find") {
  for (const double hertz : {400.0, 500.0, 800.0, 1000.0}) {
    MadeTone tone;
    tone.decibels = 300.0;
    tone.hertz = [hertz](std::size_t) { return hertz; };
    CHECK(names(examined(made(tone), 1)) == "nothing");
  }
  MadeTone noise;
  noise.amplitude = [](std::size_t) { return 0.0; };
  CHECK(names(examined(made(noise), 1)) == "nothing");
  CHECK(names(examined({}, 1)) == "nothing");
  noise.samples = 10;
  CHECK(names(examined(made(noise), 1)) == "nothing");
}

TEST_CASE("sixteen bits are enough, in a slow tone, too") {
  for (const double hertz : {5.0, 440.0}) {
    MadeTone tone;
    tone.decibels = 90.0;
    tone.hertz = [hertz](std::size_t) { return hertz; };
    tone.distorted = [](std::size_t, RecordedSample& sample) {
      sample.in_phase = std::round(sample.in_phase * 32000.0) / 32768.0;
    };
    certificates::SignalAssumptions assume = test::audio_assumptions();
    assume.frequency[0] = test::radians(3.0);
    CHECK(names(examined(made(tone), 1, assume)) == "nothing");
  }
}

TEST_CASE("missing samples are gaps, and what is between them is still looked at") {
  MadeTone tone;
  tone.distorted = [](std::size_t k, RecordedSample& sample) {
    sample.in_phase += 0.1;
    sample.is_present = k < 10000 || k >= 10100;
  };
  const std::vector<Finding> found = examined(made(tone), 1);
  CHECK(names(found) == "DC offset, gaps");
  CHECK(found.back().is_missing);
  CHECK(found.back().where.kept().front().first == 10000);
  CHECK(found.back().where.kept().front().last == 10099);
}

TEST_CASE("a tone of two defects has two findings") {
  MadeTone tone;
  tone.added = [](std::size_t k, double phase) {
    return 0.05 * std::cos(2.0 * phase) + 0.04 * std::cos(test::radians(60.0) * static_cast<double>(k));
  };
  CHECK(names(examined(made(tone), 1)) == "harmonics, hum");
}

}  // namespace
}  // namespace veritrack::reports
