#include "reports/recording/waveform.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace veritrack::reports {
namespace {

using Means = std::vector<std::complex<double>>;

/// Means over whole periods.
Means means_of(const Waveform& of, const Waveform& signal, double amplitude, double phase) {
  constexpr int kPlaces = 360;
  Means means(of.harmonics().size());
  for (int k = 0; k < kPlaces; ++k) {
    const double turned = kWholeTurn * k / kPlaces;
    for (std::size_t i = 0; i < means.size(); ++i) {
      means[i] += amplitude * signal.at(turned + phase) *
                  std::polar(1.0 / kPlaces, -of.harmonics()[i].order * turned);
    }
  }
  return means;
}

/// A note: 17 % of its power is in the fundamental.
Waveform note(int channels) {
  return {std::vector<certificates::Harmonic>{{1, 0.45}, {2, std::polar(1.0, 1.2)}}, channels};
}

TEST_CASE("a waveform has all of its own power, and its amplitude and phase are found") {
  for (const int channels : {1, 2}) {
    const Waveform waveform = note(channels);
    const Means means = means_of(waveform, waveform, 0.7, 2.5);
    const double power = 0.49 * (0.45 * 0.45 + 1.0) / (channels == 1 ? 2.0 : 1.0);
    CHECK(waveform.power(means) == doctest::Approx(power));
    const MatchedTone matched = waveform.match(means);
    CHECK(matched.amplitude == doctest::Approx(0.7));
    CHECK(matched.phase == doctest::Approx(2.5));
  }
}

TEST_CASE("of another signal it has less: of its own at half or twice the frequency hardly any") {
  const Waveform waveform = note(1);
  const double whole = waveform.power(means_of(waveform, waveform, 1.0, 0.4));
  const Waveform half(std::vector<certificates::Harmonic>{{2, 0.45}, {4, 1.0}}, 1);
  const Waveform twice(std::vector<certificates::Harmonic>{{1, 1.0}}, 1);
  CHECK(waveform.power(means_of(waveform, half, 1.0, 0.4)) < 0.2 * whole);
  CHECK(waveform.power(means_of(waveform, twice, 1.0, 0.4)) < 0.2 * whole);
}

TEST_CASE("with one channel, what turns backwards is the real part of what turns forwards") {
  const Waveform waveform(std::vector<certificates::Harmonic>{{-1, {0.0, 1.0}}, {0, {2.0, 3.0}}}, 1);
  CHECK(waveform.has(1));
  CHECK_FALSE(waveform.has(-1));
  CHECK_FALSE(waveform.is_tone());
  CHECK(waveform.at(0.3).real() == doctest::Approx(2.0 + std::sin(0.3)));
  CHECK(waveform.at(0.3).imag() == 0.0);
  CHECK(waveform.derivative(0.3).real() == doctest::Approx(std::cos(0.3)));
}

}  // namespace
}  // namespace veritrack::reports
