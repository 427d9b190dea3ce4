#include "reports/recording/tone_search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace veritrack::reports {

namespace {

constexpr double kPeriods = 4.0;  ///< that a stretch must have for its periodogram to be trusted

/// sum of w(k) y(k) e^{-i frequency k}.
std::complex<double> transform_at(std::span<const std::complex<double>> weighted, double frequency) {
  const std::complex<double> turn = std::polar(1.0, -frequency);
  std::complex<double> sum = 0.0;
  for (auto sample = weighted.rbegin(); sample != weighted.rend(); ++sample) {
    sum = sum * turn + *sample;  // Horner's rule
  }
  return sum;
}

}  // namespace

ToneSearch::ToneSearch(const Waveform& waveform, int channels, const std::array<double, 2>& band)
    : waveform_(waveform), channels_(channels), band_(band), means_(waveform.harmonics().size()) {}

void ToneSearch::weigh(std::span<const RecordedSample> samples) {
  const auto count = static_cast<double>(samples.size());
  const double lowest = std::min(std::fabs(band_[0]), std::fabs(band_[1]));
  const bool has_zero = band_[0] * band_[1] <= 0.0 || lowest * count < 2.0 * kWholeTurn;
  // A constant would look like a low frequency, unless it is one or the design's own.
  const bool keeps_mean = waveform_.has(0) || (channels_ > 1 && has_zero);
  std::complex<double> mean = 0.0;
  weights_ = 0.0;
  weighted_.clear();
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double weight = 1.0 - std::cos(kWholeTurn * (static_cast<double>(k) + 0.5) / count);
    weighted_.emplace_back(samples[k].in_phase, channels_ > 1 ? samples[k].quadrature : 0.0);
    mean += weight * weighted_.back();
    weights_ += weight;
  }
  mean = keeps_mean ? 0.0 : mean / weights_;
  power_ = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double weight = 1.0 - std::cos(kWholeTurn * (static_cast<double>(k) + 0.5) / count);
    const std::complex<double> moved = weighted_[k] - mean;
    power_ += weight * std::norm(moved);
    weighted_[k] = weight * moved;
  }
}

double ToneSearch::power_at(double frequency) {
  const std::span<const certificates::Harmonic> harmonics = waveform_.harmonics();
  for (std::size_t i = 0; i < harmonics.size(); ++i) {
    means_[i] = transform_at(weighted_, harmonics[i].order * frequency) / weights_;
  }
  return waveform_.power(means_);
}

FoundTone ToneSearch::in(std::span<const RecordedSample> samples, double lowest) {
  FoundTone found;
  found.length = samples.size();
  const double low = std::max(band_[0], lowest);
  if (samples.empty() || low > band_[1]) {
    return found;
  }
  weigh(samples);
  if (!(power_ > 0.0)) {
    return found;
  }
  // A quarter of the distance of two bins: the peak is between the neighbours of the largest value.
  const std::size_t size = std::bit_ceil(4 * samples.size());
  padded_.assign(size, 0.0);
  std::copy(weighted_.begin(), weighted_.end(), padded_.begin());
  transform_.fwd(spectrum_, padded_);
  const double step = kWholeTurn / static_cast<double>(size);
  const auto places = static_cast<std::int64_t>(size);
  const std::span<const certificates::Harmonic> harmonics = waveform_.harmonics();
  double largest = -1.0;
  double best = low;
  const auto last = static_cast<std::int64_t>(std::ceil(band_[1] / step));
  for (auto i = static_cast<std::int64_t>(std::floor(low / step)); i <= last; ++i) {
    for (std::size_t h = 0; h < harmonics.size(); ++h) {
      const std::int64_t place = ((i * harmonics[h].order) % places + places) % places;
      means_[h] = spectrum_[static_cast<std::size_t>(place)];
    }
    const double power = waveform_.power(means_);
    if (power > largest) {
      largest = power;
      best = static_cast<double>(i) * step;
    }
  }
  constexpr double kGolden = 0.6180339887498949;
  double left = std::max(low, best - step);
  double right = std::min(band_[1], best + step);
  double first = right - kGolden * (right - left);
  double second = left + kGolden * (right - left);
  double first_power = power_at(first);
  double second_power = power_at(second);
  for (int i = 0; i < 28; ++i) {
    if (first_power < second_power) {
      left = first;
      first = second;
      first_power = second_power;
      second = left + kGolden * (right - left);
      second_power = power_at(second);
    } else {
      right = second;
      second = first;
      second_power = first_power;
      first = right - kGolden * (right - left);
      first_power = power_at(first);
    }
  }
  found.frequency = 0.5 * (left + right);
  found.share = std::clamp(power_at(found.frequency) * weights_ / power_, 0.0, 1.0);
  const double middle = 0.5 * static_cast<double>(samples.size() - 1);
  for (std::size_t i = 0; i < harmonics.size(); ++i) {
    means_[i] *= std::polar(1.0, harmonics[i].order * found.frequency * middle);
  }
  const MatchedTone matched = waveform_.match(means_);
  found.amplitude = matched.amplitude;
  found.phase = matched.phase;
  return found;
}

FoundTone ToneSearch::in_first(std::span<const RecordedSample> samples, std::size_t least) {
  // Shares in noise vary, most in short stretches: what is nearly as much in a longer one counts for more.
  constexpr double kNearly = 0.9;
  constexpr double kNoise = 4.0;
  constexpr double kDeviations = 3.0;
  std::vector<FoundTone> found;
  double wanted = 0.0;
  const auto add = [&](const FoundTone& each) {
    const double length = static_cast<double>(each.length);
    const double variance = 4.0 * std::max(0.0, each.share * (1.0 - each.share)) / length;
    wanted = std::max(wanted, kNearly * each.share - kNoise / length - kDeviations * std::sqrt(variance));
    found.push_back(each);
  };
  for (std::size_t length = least; length < samples.size(); length *= 2) {
    if (band_[0] > 0.0) {
      add(in(samples.first(length), kPeriods * kWholeTurn / static_cast<double>(length)));
    }
  }
  add(in(samples, band_[0]));
  const auto longest =
      std::find_if(found.rbegin(), found.rend(), [&](const FoundTone& each) { return each.share >= wanted; });
  return longest != found.rend() ? *longest : found.back();
}

}  // namespace veritrack::reports
