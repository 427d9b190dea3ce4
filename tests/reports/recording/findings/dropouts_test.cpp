#include "reports/recording/findings/detectors.hpp"

#include <doctest/doctest.h>

#include "tests/reports/recording/findings/defective_tone.hpp"

namespace veritrack::reports {
namespace {

using test::examined;
using test::made;
using test::MadeTone;
using test::names;

TEST_CASE("dropouts are found, and only they, with their samples") {
  test::for_each_kind([](int channels, double decibels) {
    for (const bool is_frozen : {false, true}) {
      MadeTone tone;
      tone.channels = channels;
      tone.decibels = decibels;
      RecordedSample last;
      tone.distorted = [&](std::size_t k, RecordedSample& sample) {
        if ((k >= 20000 && k < 20030) || (k >= 30000 && k < 30030)) {
          sample = is_frozen ? last : RecordedSample{0.0, 0.0, true};
        }
        last = sample;
      };
      const std::vector<Finding> found = examined(made(tone), channels);
      INFO(channels, " channels, ", decibels, " dB, frozen ", is_frozen, ": ", names(found));
      REQUIRE(names(found) == "dropouts");
      REQUIRE(found.front().where.count() == 2);
      CHECK(std::fabs(static_cast<double>(found.front().where.kept().front().first) - 20000.0) <= 2.0);
      CHECK(std::fabs(static_cast<double>(found.front().where.kept().back().last) - 30029.0) <= 2.0);
      CHECK(found.front().is_missing);
    }
  });
}

TEST_CASE("silence before, between and after") {
  MadeTone tone;
  tone.distorted = [random = trackers::RandomStream(3)](std::size_t k, RecordedSample& sample) mutable {
    if (k < 6000 || (k >= 15000 && k < 20000) || k >= 35000) {
      sample.in_phase = 1e-3 * random.normal();
    }
  };
  const std::vector<Finding> found = examined(made(tone), 1);
  REQUIRE(names(found) == "silence");
  REQUIRE(found.front().where.count() == 3);
  CHECK(found.front().where.kept()[0].first == 0);
  CHECK(found.front().where.kept()[0].last == 5999);
  CHECK(std::fabs(static_cast<double>(found.front().where.kept()[1].first) - 15000.0) <= 2.0);
  CHECK(found.front().where.kept()[2].last == 39999);
}

TEST_CASE("marked as missing, which is the remedy, a dropout is a gap") {
  MadeTone tone;
  tone.distorted = [](std::size_t k, RecordedSample& sample) { sample.is_present = k < 20000 || k >= 20030; };
  CHECK(names(examined(made(tone), 1)) == "gaps");
}

}  // namespace
}  // namespace veritrack::reports
