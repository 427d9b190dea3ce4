#include "reports/recording/tone_fit.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <span>

#include "tests/reports/recording/recorded_tone.hpp"
#include "tests/support/random.hpp"

namespace veritrack::reports {
namespace {

TEST_CASE("without noise a fit finds amplitude and frequency, from a rough frequency") {
  for (const int channels : {1, 2}) {
    const auto tone = test::recorded_tone(64, channels, 0.0, [](std::size_t) { return 0.5; });
    ToneFit fit(64, channels, false, test::tone_waveform(channels));
    const FittedTone& found = fit.fit(tone, 0.505);
    CHECK(found.amplitude == doctest::Approx(1.0).epsilon(1e-3));
    CHECK(found.frequency == doctest::Approx(0.5).epsilon(1e-4));
    CHECK(found.noise_deviation < 1e-2);
    const FittedTone& again = fit.fit(tone, found.frequency);
    CHECK(again.amplitude == doctest::Approx(1.0).epsilon(1e-6));
    CHECK(again.noise_deviation < 1e-6);
    CHECK(std::abs(fit.tone(10).real() - tone[10].in_phase) < 1e-6);
  }
}

TEST_CASE("a frequency that moves is that of the middle") {
  const auto tone =
      test::recorded_tone(64, 2, 0.0, [](std::size_t k) { return 0.5 + 1e-4 * static_cast<double>(k); });
  ToneFit fit(64, 2, false, test::tone_waveform(2));
  // The phase of sample k has 0.5 k + 1e-4 k (k - 1) / 2: its slope at 31.5.
  CHECK(fit.fit(tone, 0.503).frequency == doctest::Approx(0.5 + 1e-4 * 31.0).epsilon(1e-4));
}

TEST_CASE("in noise, its deviation and that of the frequency are what they are said to be") {
  constexpr double kDeviation = 0.05;
  const auto count = static_cast<std::size_t>(test::effort(2000));
  for (const int channels : {1, 2}) {
    const auto tone = test::recorded_tone(
        64 * count, channels, kDeviation, [](std::size_t) { return 0.7; }, 3);
    ToneFit fit(64, channels, false, test::tone_waveform(channels));
    double noise = 0.0;
    double error = 0.0;
    double said = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const FittedTone& found = fit.fit(std::span(tone).subspan(64 * i, 64), 0.7);
      noise += found.noise_deviation * found.noise_deviation;
      error += (found.frequency - 0.7) * (found.frequency - 0.7);
      said += found.frequency_deviation * found.frequency_deviation;
    }
    const auto n = static_cast<double>(count);
    INFO("channels ", channels);
    CHECK(std::sqrt(noise / n) == doctest::Approx(kDeviation).epsilon(0.05));
    CHECK(std::sqrt(error / said) == doctest::Approx(1.0).epsilon(0.1));
    // The Cramer-Rao bound on the frequency: 12 sigma^2 / n^3 for two channels, twice that for one.
    const double bound = std::sqrt(12.0 * (channels > 1 ? 1.0 : 2.0) / (64.0 * 64.0 * 64.0)) * kDeviation;
    CHECK(std::sqrt(error / n) == doctest::Approx(bound).epsilon(0.1));
  }
}

TEST_CASE("the signal of a design is fitted as a whole, from a rough frequency") {
  const Waveform note(std::vector<certificates::Harmonic>{{1, 0.45}, {2, std::polar(1.0, 1.2)}}, 1);
  std::vector<RecordedSample> samples;
  for (std::size_t k = 0; k < 128; ++k) {
    samples.push_back({1.5 * note.at(0.4 + 0.2 * static_cast<double>(k)).real(), 0.0, true});
  }
  ToneFit fit(128, 1, false, note);
  const FittedTone& found = fit.fit(samples, 0.203);
  CHECK(found.frequency == doctest::Approx(0.2).epsilon(1e-6));
  CHECK(found.amplitude == doctest::Approx(1.5).epsilon(1e-6));
  CHECK(found.noise_deviation < 1e-6);
  CHECK(std::abs(fit.tone(10)) == doctest::Approx(1.5).epsilon(1e-4));
  CHECK(std::remainder(std::arg(fit.tone(10)) - 2.4, kWholeTurn) == doctest::Approx(0.0).epsilon(1e-4));
}

}  // namespace
}  // namespace veritrack::reports
