#include "reports/recording/lock_indicator.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>

#include "tests/reports/recording/recorded_tone.hpp"
#include "tests/support/random.hpp"

namespace veritrack::reports {
namespace {

TEST_CASE("a tone whose frequency is known has all of the power, in noise SNR/(1 + SNR)") {
  for (const int channels : {1, 2}) {
    for (const double deviation : {0.0, 0.3, 1.0}) {
      const auto tone = test::recorded_tone(100000, channels, deviation, [](std::size_t) { return 0.7; });
      LockIndicator lock(64, channels, test::tone_waveform(channels));
      double sum = 0.0;
      for (std::size_t k = 0; k < tone.size(); ++k) {
        lock.push(tone[k], 0.7);
        CHECK(std::isnan(lock.share()) == (k < 15));
        sum += k < 1000 ? 0.0 : lock.share();
      }
      const double snr = 0.5 / (deviation * deviation);
      const double expected = deviation > 0.0 ? snr / (1.0 + snr) : 1.0;
      // A window of 64 samples finds about 1/64 of the noise in the tone, or twice that in one channel.
      CHECK(sum / 99000.0 == doctest::Approx(expected).epsilon(0.06));
    }
  }
}

TEST_CASE("a frequency that is wrong, silence and noise have no lock") {
  const auto tone = test::recorded_tone(1000, 2, 0.01, [](std::size_t) { return 0.7; });
  LockIndicator lock(64, 2, test::tone_waveform(2));
  for (const RecordedSample& sample : tone) {
    lock.push(sample, 0.9);
  }
  CHECK(lock.share() < 0.1);
  lock.clear();
  CHECK(std::isnan(lock.share()));
  for (int k = 0; k < 100; ++k) {
    lock.push({0.0, 0.0, true}, 0.7);
  }
  CHECK(lock.share() == 0.0);
}

TEST_CASE("running sums are those of the window, whatever came before") {
  test::Random random;
  LockIndicator lock(16, 2, test::tone_waveform(2));
  std::vector<RecordedSample> samples;
  std::vector<double> phases;
  double phase = 0.0;
  for (int k = 0; k < 5000; ++k) {
    const double scale = k < 2000 ? 1e9 : 1.0;  // what a loud beginning leaves behind
    samples.push_back({scale * random.uniform(-1.0, 1.0), scale * random.uniform(-1.0, 1.0), true});
    phases.push_back(phase);
    lock.push(samples.back(), 0.3);
    phase += 0.3;
  }
  std::complex<double> sum = 0.0;
  double power = 0.0;
  for (std::size_t k = samples.size() - 16; k < samples.size(); ++k) {
    const std::complex<double> value(samples[k].in_phase, samples[k].quadrature);
    sum += value * std::polar(1.0, -phases[k]);
    power += std::norm(value);
  }
  CHECK(lock.share() == doctest::Approx(std::norm(sum) / (16.0 * power)).epsilon(1e-6));
}

TEST_CASE("over a gap the tone turns on") {
  const auto tone = test::recorded_tone(400, 2, 0.0, [](std::size_t) { return 0.7; });
  LockIndicator lock(64, 2, test::tone_waveform(2));
  for (std::size_t k = 0; k < tone.size(); ++k) {
    if (k >= 200 && k < 230) {
      lock.pass(0.7);
    } else {
      lock.push(tone[k], 0.7);
    }
  }
  CHECK(lock.share() == doctest::Approx(1.0));
}

TEST_CASE("a note whose second harmonic is stronger is in lock at its fundamental, and nowhere else") {
  const Waveform note(std::vector<certificates::Harmonic>{{1, 0.45}, {2, std::polar(1.0, 1.2)}}, 1);
  const auto share_at = [&](const Waveform& waveform, double frequency) {
    LockIndicator lock(512, 1, waveform);
    for (std::size_t k = 0; k < 1024; ++k) {
      lock.push({note.at(0.2 * static_cast<double>(k)).real(), 0.0, true}, frequency);
    }
    return lock.share();
  };
  CHECK(share_at(note, 0.2) > 0.98);
  CHECK(share_at(note, 0.1) < 0.2);
  CHECK(share_at(note, 0.4) < 0.2);
  // For a tone alone, the fundamental has 17 % of the power.
  CHECK(share_at(test::tone_waveform(1), 0.2) == doctest::Approx(0.17).epsilon(0.05));
}

}  // namespace
}  // namespace veritrack::reports
