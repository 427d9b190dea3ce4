#include "reports/recording/findings/block_fit.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "tests/reports/recording/findings/defective_tone.hpp"
#include "tests/reports/recording/recorded_tone.hpp"

namespace veritrack::reports {
namespace {

/// Stretches of 256 samples as they were made.
std::vector<ToneStretch> stretches_of(std::size_t samples, double frequency) {
  std::vector<ToneStretch> stretches;
  for (std::size_t first = 0; first + 256 <= samples; first += 256) {
    ToneStretch each;
    each.first = static_cast<std::int64_t>(first);
    each.length = 256;
    each.frequency = frequency;
    each.amplitude = 1.0;
    each.phase = 0.3 + frequency * (static_cast<double>(first) + 127.5);
    stretches.push_back(each);
  }
  return stretches;
}

TEST_CASE("every part has its size, and the noise the rest") {
  const double frequency = test::radians(440.0);
  for (const int channels : {1, 2}) {
    test::MadeTone tone;
    tone.channels = channels;
    tone.samples = 1792;
    tone.added = [](std::size_t k, double phase) {
      return 0.1 + 0.05 * std::cos(3.0 * phase) +
             0.02 * std::cos(test::radians(50.0) * static_cast<double>(k));
    };
    const auto samples = test::made(tone);
    BlockFit fit(test::tone_waveform(channels), channels, test::audio_assumptions(), test::kRate);
    CHECK(fit.length() == 1600);
    const auto block = fit.fit(stretches_of(samples.size(), frequency), samples);
    REQUIRE(block);
    CHECK(block->amplitude == doctest::Approx(1.0).epsilon(0.002));
    CHECK(block->noise_deviation == doctest::Approx(0.01 / std::sqrt(2.0)).epsilon(0.1));
    CHECK(block->offset.value.real() == doctest::Approx(0.1).epsilon(0.02));
    const auto third = std::find_if(block->harmonics.begin(), block->harmonics.end(),
                                    [](const FittedPart& each) { return each.order == 3; });
    REQUIRE(third != block->harmonics.end());
    CHECK(third->size == doctest::Approx(0.05).epsilon(0.05));
    REQUIRE(block->hum.size() == 4);
    CHECK(block->hum.front().hertz == 50.0);
    CHECK(block->hum.front().size == doctest::Approx(0.02).epsilon(0.1));
    CHECK(block->hum.back().size < 0.003);
    CHECK(std::fabs(block->amplitudes.front().size - 1.0) < 5.0 * block->amplitudes.front().deviation);
  }
}

TEST_CASE(
    "a block that is too short for its parts has no fit; lines that cannot be told apart are left out") {
  test::MadeTone tone;
  tone.samples = 256;
  const auto samples = test::made(tone);
  BlockFit fit(test::tone_waveform(1), 1, test::audio_assumptions(), std::nullopt);
  CHECK(fit.length() == 1024);
  const double frequency = test::radians(440.0);
  CHECK_FALSE(fit.fit(
      stretches_of(64, frequency).empty() ? stretches_of(256, frequency) : stretches_of(64, frequency),
      std::span(samples).first(64)));
  // 7 * 440 Hz fits below 4 kHz; at 1200 Hz the third is at 3600 Hz, the fourth folds to 3200 Hz, and so on.
  const auto block = fit.fit(stretches_of(256, frequency), samples);
  REQUIRE(block);
  CHECK(block->hum.empty());
  CHECK(block->harmonics.size() == 6);
}

}  // namespace
}  // namespace veritrack::reports
