#include "reports/recording/tone_start.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace veritrack::reports {

namespace {

using certificates::ToneAtSample;

constexpr double kTurn = 2.0 * std::numbers::pi;

/// |sum of w(k) y(k) e^{-i frequency k}|^2.
double power_at(const std::vector<std::complex<double>>& weighted, double frequency) {
  const std::complex<double> turn = std::polar(1.0, frequency);
  std::complex<double> sum = 0.0;
  for (auto sample = weighted.rbegin(); sample != weighted.rend(); ++sample) {
    sum = sum * std::conj(turn) + *sample;  // Horner's rule
  }
  return std::norm(sum);
}

double peak_of(const std::vector<std::complex<double>>& weighted, const std::array<double, 2>& band) {
  // A quarter of the distance of two bins: the peak is between the neighbours of the largest value.
  const double distance = 0.25 * kTurn / static_cast<double>(weighted.size());
  const int places = 1 + static_cast<int>(std::ceil((band[1] - band[0]) / distance));
  const double step = places > 1 ? (band[1] - band[0]) / (places - 1) : 0.0;
  double best = band[0];
  double largest = -1.0;
  for (int i = 0; i < places; ++i) {
    const double power = power_at(weighted, band[0] + i * step);
    if (power > largest) {
      largest = power;
      best = band[0] + i * step;
    }
  }
  double low = std::max(band[0], best - distance);
  double high = std::min(band[1], best + distance);
  for (int i = 0; i < 40; ++i) {
    const double first = low + (high - low) / 3.0;
    const double second = high - (high - low) / 3.0;
    (power_at(weighted, first) < power_at(weighted, second) ? low : high) =
        power_at(weighted, first) < power_at(weighted, second) ? first : second;
  }
  return 0.5 * (low + high);
}

/// a of the a e^{i frequency k} that is closest to the samples; of one channel its real part is.
std::complex<double> closest_tone(std::span<const RecordedSample> samples, int channels, double frequency) {
  std::complex<double> sum = 0.0;
  double cc = 0.0;
  double cs = 0.0;
  double ss = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double cosine = std::cos(frequency * static_cast<double>(k));
    const double sine = std::sin(frequency * static_cast<double>(k));
    const std::complex<double> sample(samples[k].in_phase, channels > 1 ? samples[k].quadrature : 0.0);
    sum += sample * std::complex<double>(cosine, -sine);
    cc += cosine * cosine;
    cs += cosine * sine;
    ss += sine * sine;
  }
  if (channels > 1) {
    return sum / static_cast<double>(samples.size());
  }
  // y = p cos - q sin: normal equations.
  const double determinant = cc * ss - cs * cs;
  if (!(determinant > 1e-9 * cc * cc)) {
    return {samples.front().in_phase, 0.0};
  }
  const double y_cosine = sum.real();
  const double y_sine = -sum.imag();
  return {(y_cosine * ss - y_sine * cs) / determinant, -(y_sine * cc - y_cosine * cs) / determinant};
}

}  // namespace

std::size_t start_length(double lowest) {
  constexpr double kLeast = 256.0;
  constexpr double kMost = 2048.0;
  return static_cast<std::size_t>(
      std::clamp(lowest > 0.0 ? std::ceil(4.0 * kTurn / lowest) : kMost, kLeast, kMost));
}

ToneAtSample find_tone(std::span<const RecordedSample> samples, int channels,
                       const std::array<double, 2>& band, std::optional<double> frequency) {
  ToneAtSample tone;
  if (frequency) {
    tone.frequency = *frequency;
  } else {
    double mean = 0.0;
    for (const RecordedSample& sample : samples) {
      mean += sample.in_phase / static_cast<double>(samples.size());
    }
    std::vector<std::complex<double>> weighted;
    weighted.reserve(samples.size());
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const double weight =
          1.0 - std::cos(kTurn * (static_cast<double>(k) + 0.5) / static_cast<double>(samples.size()));
      // Of one channel, a constant would look like a low frequency.
      weighted.push_back(weight * (channels > 1
                                       ? std::complex<double>(samples[k].in_phase, samples[k].quadrature)
                                       : std::complex<double>(samples[k].in_phase - mean, 0.0)));
    }
    tone.frequency = peak_of(weighted, band);
  }
  const double periods = std::ceil(2.0 * kTurn / std::max(std::fabs(tone.frequency), 1e-6));
  const std::size_t length =
      std::min(samples.size(), static_cast<std::size_t>(std::clamp(periods, 32.0, 4096.0)));
  const std::complex<double> closest = closest_tone(samples.first(length), channels, tone.frequency);
  tone.amplitude = std::abs(closest);
  tone.phase = std::arg(closest);
  return tone;
}

}  // namespace veritrack::reports
