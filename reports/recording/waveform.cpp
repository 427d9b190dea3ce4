#include "reports/recording/waveform.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace veritrack::reports {

Waveform::Waveform(std::span<const certificates::Harmonic> signal, int channels) : channels_(channels) {
  std::map<int, std::complex<double>> values;
  for (const certificates::Harmonic& each : signal) {
    // The real part of a harmonic that turns backwards is that of its conjugate.
    const bool is_mirrored = channels == 1 && each.order < 0;
    values[is_mirrored ? -each.order : each.order] += is_mirrored ? std::conj(each.value) : each.value;
  }
  for (const auto& [order, value] : values) {
    const bool is_real_turn = channels == 1 && order != 0;
    harmonics_.push_back({order, channels == 1 && order == 0 ? std::complex<double>(value.real()) : value});
    gains_.push_back(is_real_turn ? 2.0 : 1.0);
    parts_.push_back(is_real_turn ? 0.5 : 1.0);
    power_ += parts_.back() * std::norm(harmonics_.back().value);
  }
}

bool Waveform::has(int order) const {
  return std::any_of(harmonics_.begin(), harmonics_.end(),
                     [order](const certificates::Harmonic& each) { return each.order == order; });
}

std::complex<double> Waveform::at(double phase) const {
  std::complex<double> sum = 0.0;
  for (const certificates::Harmonic& each : harmonics_) {
    sum += each.value * std::polar(1.0, each.order * phase);
  }
  return channels_ == 1 ? std::complex<double>(sum.real()) : sum;
}

std::complex<double> Waveform::derivative(double phase) const {
  std::complex<double> sum = 0.0;
  for (const certificates::Harmonic& each : harmonics_) {
    sum += std::complex<double>(0.0, each.order) * each.value * std::polar(1.0, each.order * phase);
  }
  return channels_ == 1 ? std::complex<double>(sum.real()) : sum;
}

double Waveform::power(std::span<const std::complex<double>> means) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < harmonics_.size(); ++i) {
    sum += parts_[i] * gains_[i] * std::abs(harmonics_[i].value) * std::abs(means[i]);
  }
  return sum * sum / power_;
}

MatchedTone Waveform::match(std::span<const std::complex<double>> means) const {
  const auto score = [&](double phase) {
    double sum = 0.0;
    for (std::size_t i = 0; i < harmonics_.size(); ++i) {
      const std::complex<double> turned =
          std::conj(harmonics_[i].value) * std::polar(1.0, -harmonics_[i].order * phase);
      sum += parts_[i] * gains_[i] * (turned * means[i]).real();
    }
    return sum;
  };
  if (is_tone()) {
    const double phase = std::arg(std::conj(harmonics_.front().value) * means.front());
    return {score(phase) / power_, phase};
  }
  constexpr int kPhases = 128;
  double best = 0.0;
  for (int i = 1; i < kPhases; ++i) {
    const double phase = kWholeTurn * i / kPhases;
    best = score(phase) > score(best) ? phase : best;
  }
  double low = best - kWholeTurn / kPhases;
  double high = best + kWholeTurn / kPhases;
  for (int i = 0; i < 40; ++i) {
    const double first = low + (high - low) / 3.0;
    const double second = high - (high - low) / 3.0;
    (score(first) < score(second) ? low : high) = score(first) < score(second) ? first : second;
  }
  const double phase = std::remainder(0.5 * (low + high), kWholeTurn);
  return {score(phase) / power_, phase};
}

}  // namespace veritrack::reports
