#include "reports/recording/tone_start.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "reports/recording/tone_search.hpp"

namespace veritrack::reports {

namespace {

using certificates::Harmonic;
using certificates::ToneAtSample;

constexpr std::size_t kLeast = 256;

/// The harmonics closest to the samples, with a constant beside them where that can be told apart, as the
/// means that Waveform::match takes.
std::vector<std::complex<double>> closest_means(std::span<const RecordedSample> samples,
                                                const Waveform& waveform, int channels, double frequency) {
  const std::span<const Harmonic> harmonics = waveform.harmonics();
  const bool has_constant =
      !waveform.has(0) && std::fabs(frequency) * static_cast<double>(samples.size()) > 1.5 * kWholeTurn;
  const auto unknowns = static_cast<Eigen::Index>(2 * harmonics.size() + (has_constant ? 2 : 0));
  const auto rows = static_cast<Eigen::Index>(samples.size()) * channels;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, unknowns);
  Eigen::VectorXd right(rows);
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(samples.size()); ++k) {
    const RecordedSample& sample = samples[static_cast<std::size_t>(k)];
    const Eigen::Index row = k * channels;
    right(row) = sample.in_phase;
    for (Eigen::Index i = 0; i < unknowns / 2; ++i) {
      const bool is_constant = i == static_cast<Eigen::Index>(harmonics.size());
      const int order = is_constant ? 0 : harmonics[static_cast<std::size_t>(i)].order;
      const std::complex<double> turn = std::polar(1.0, order * frequency * static_cast<double>(k));
      matrix(row, 2 * i) = turn.real();
      matrix(row, 2 * i + 1) = -turn.imag();
      if (channels > 1) {
        matrix(row + 1, 2 * i) = turn.imag();
        matrix(row + 1, 2 * i + 1) = turn.real();
      }
    }
    if (channels > 1) {
      right(row + 1) = sample.quadrature;
    }
  }
  // Tones that cannot be told apart get the shortest solution.
  const Eigen::VectorXd found = matrix.completeOrthogonalDecomposition().solve(right);
  std::vector<std::complex<double>> means;
  for (std::size_t i = 0; i < harmonics.size(); ++i) {
    const auto place = static_cast<Eigen::Index>(2 * i);
    const double gain = channels == 1 && harmonics[i].order != 0 ? 2.0 : 1.0;
    means.emplace_back(found(place) / gain, found(place + 1) / gain);
  }
  return means;
}

}  // namespace

std::size_t start_length(double lowest) {
  constexpr double kMost = 65536.0;
  constexpr std::size_t kUnknown = 2048;
  return lowest > 0.0 ? static_cast<std::size_t>(std::clamp(std::ceil(4.0 * kWholeTurn / lowest),
                                                            static_cast<double>(kLeast), kMost))
                      : kUnknown;
}

ToneAtSample find_tone(std::span<const RecordedSample> samples, const Waveform& waveform, int channels,
                       const std::array<double, 2>& band, std::optional<double> frequency) {
  constexpr double kMostFitted = 65536.0;
  ToneAtSample tone;
  tone.frequency =
      frequency ? *frequency : ToneSearch(waveform, channels, band).in_first(samples, kLeast).frequency;
  const double periods = std::ceil(2.0 * kWholeTurn / std::max(std::fabs(tone.frequency), 1e-6));
  const std::size_t length =
      std::min(samples.size(), static_cast<std::size_t>(std::clamp(periods, 32.0, kMostFitted)));
  const MatchedTone matched =
      waveform.match(closest_means(samples.first(length), waveform, channels, tone.frequency));
  tone.amplitude = matched.amplitude;
  tone.phase = matched.phase;
  return tone;
}

}  // namespace veritrack::reports
