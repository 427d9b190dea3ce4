#include "reports/recording/tone_search.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "reports/recording/tone_start.hpp"
#include "tests/reports/recording/recorded_tone.hpp"

namespace veritrack::reports {
namespace {

TEST_CASE("a tone in noise is found with its share, amplitude and phase in the middle") {
  for (const int channels : {1, 2}) {
    const auto tone = test::recorded_tone(1024, channels, 0.1, [](std::size_t) { return 0.7; });
    const FoundTone found = ToneSearch(test::tone_waveform(channels), channels, {0.1, 3.0}).in(tone, 0.0);
    CHECK(found.frequency == doctest::Approx(0.7).epsilon(1e-3));
    CHECK(found.amplitude == doctest::Approx(1.0).epsilon(0.02));
    CHECK(std::fabs(std::remainder(found.phase - (0.3 + 0.7 * 511.5), kWholeTurn)) < 0.02);
    CHECK(found.share == doctest::Approx(1.0 / 1.02).epsilon(0.02));
  }
}

TEST_CASE("a constant is no slow tone, and no tone is found where all is silent or the band is above") {
  auto tone = test::recorded_tone(512, 1, 0.0, [](std::size_t) { return 0.7; });
  for (RecordedSample& sample : tone) {
    sample.in_phase += 20.0;
  }
  CHECK(ToneSearch(test::tone_waveform(1), 1, {0.001, 3.0}).in(tone, 0.0).frequency ==
        doctest::Approx(0.7).epsilon(1e-3));
  CHECK(ToneSearch(test::tone_waveform(1), 1, {0.1, 3.0}).in(tone, 3.1).share < 0.0);
  CHECK(ToneSearch(test::tone_waveform(1), 1, {0.1, 3.0}).in(std::vector<RecordedSample>(100), 0.0).share <
        0.0);
}

TEST_CASE("a long look for a slow tone, a short one for a tone that moves") {
  ToneSearch search(test::tone_waveform(1), 1, {1e-3, 3.0});
  const auto slow = test::recorded_tone(32768, 1, 0.01, [](std::size_t) { return 2e-3; });
  CHECK(search.in_first(slow, 64).length == 32768);
  CHECK(search.in_first(slow, 64).frequency == doctest::Approx(2e-3).epsilon(1e-2));
  const auto fast = test::recorded_tone(
      32768, 1, 0.01, [](std::size_t k) { return 1.0 + 0.5 * std::sin(1e-3 * static_cast<double>(k)); });
  const FoundTone found = search.in_first(fast, 64);
  CHECK(found.length <= 256);
  CHECK(found.frequency == doctest::Approx(1.03).epsilon(0.05));
}

TEST_CASE("a start: a period longer than 2048 samples, and a note whose second harmonic is stronger") {
  CHECK(start_length(1e-3) == 25133);
  CHECK(start_length(1.0) == 256);
  CHECK(start_length(0.0) == 2048);
  const auto slow = test::recorded_tone(25133, 1, 0.01, [](std::size_t) { return 1.5e-3; });
  const certificates::ToneAtSample start =
      find_tone(slow, test::tone_waveform(1), 1, {1e-3, 3.0}, std::nullopt);
  CHECK(start.frequency == doctest::Approx(1.5e-3).epsilon(1e-2));
  CHECK(start.amplitude == doctest::Approx(1.0).epsilon(1e-2));
  CHECK(start.phase == doctest::Approx(0.3).epsilon(0.05));

  const Waveform note(std::vector<certificates::Harmonic>{{1, 0.45}, {2, std::polar(1.0, 1.2)}}, 1);
  std::vector<RecordedSample> samples;
  for (std::size_t k = 0; k < 512; ++k) {
    samples.push_back({0.1 + 2.0 * note.at(0.4 + 0.2 * static_cast<double>(k)).real(), 0.0, true});
  }
  const certificates::ToneAtSample found = find_tone(samples, note, 1, {0.1, 1.0}, std::nullopt);
  CHECK(found.frequency == doctest::Approx(0.2).epsilon(1e-3));
  CHECK(found.amplitude == doctest::Approx(2.0).epsilon(1e-3));
  CHECK(found.phase == doctest::Approx(0.4).epsilon(1e-2));
  // For a tone alone the second harmonic would be the tone.
  CHECK(find_tone(samples, test::tone_waveform(1), 1, {0.1, 1.0}, std::nullopt).frequency ==
        doctest::Approx(0.4).epsilon(1e-3));
}

}  // namespace
}  // namespace veritrack::reports
