#include "reports/recording/assumption_check.hpp"

#include <algorithm>
#include <cmath>

#include "reports/recording/chi_square.hpp"

namespace veritrack::reports {

namespace {

constexpr double kSure = 5.0;  // deviations of an estimate

}  // namespace

AssumptionCheck::AssumptionCheck(const certificates::SignalAssumptions& assume, std::size_t length,
                                 int channels, bool is_derived)
    : assume_(assume),
      length_(length),
      channels_(channels),
      waveform_(assume.signal, channels),
      fit_(length, channels, is_derived, waveform_) {
  const auto bridge = static_cast<std::int64_t>(length);
  findings_.noise_exceeded = findings_.slew_exceeded = findings_.frequency_exceeded =
      findings_.amplitude_exceeded = SampleRanges(bridge);
  samples_.reserve(length);
}

void AssumptionCheck::interrupt() {
  samples_.clear();
  frequency_sum_ = 0.0;
  previous_.first = -1;
}

void AssumptionCheck::push(std::int64_t index, const RecordedSample& sample, double frequency) {
  if (samples_.empty()) {
    first_ = index;
  }
  samples_.push_back(sample);
  frequency_sum_ += frequency;
  if (samples_.size() == length_) {
    judge();
    samples_.clear();
    frequency_sum_ = 0.0;
  }
}

void AssumptionCheck::judge() {
  const auto length = static_cast<std::int64_t>(length_);
  const double estimate = frequency_sum_ / static_cast<double>(length_);
  const Stretch current{fit_.fit(samples_, estimate), first_};
  const FittedTone& tone = current.tone;
  if (!std::isfinite(tone.frequency) || !std::isfinite(tone.noise_deviation)) {
    interrupt();
    return;
  }
  findings_.judged += length;
  findings_.amplitude.add(tone.amplitude);
  findings_.frequency.add(tone.frequency);
  noise_squares_ += tone.noise_deviation * tone.noise_deviation;
  differences_ += estimate - tone.frequency;
  difference_squares_ += (estimate - tone.frequency) * (estimate - tone.frequency);
  ++stretches_;
  const double size_margin = kSure * tone.noise_deviation * std::sqrt(2.0 / static_cast<double>(length_));
  if (tone.amplitude + size_margin < assume_.amplitude[0] ||
      tone.amplitude - size_margin > assume_.amplitude[1]) {
    findings_.amplitude_exceeded.add(first_, first_ + length - 1);
  }
  const double margin = kSure * tone.frequency_deviation;
  if (tone.frequency + margin < assume_.frequency[0] || tone.frequency - margin > assume_.frequency[1]) {
    findings_.frequency_exceeded.add(first_, first_ + length - 1);
  }
  judge_noise(first_);
  judge_slew(current);
  previous_ = current;
}

void AssumptionCheck::judge_noise(std::int64_t first) {
  double squares = 0.0;
  for (std::size_t k = 0; k < length_; ++k) {
    const RecordedSample& sample = samples_[k];
    const std::complex<double> seen(sample.in_phase, sample.quadrature);
    const double size = std::abs(fit_.tone(k));
    const std::complex<double> shape = waveform_.at(std::arg(fit_.tone(k)));
    const std::complex<double> fitted = size * shape;
    const std::complex<double> assumed = std::clamp(size, assume_.amplitude[0], assume_.amplitude[1]) * shape;
    const double residual = channels_ > 1 ? std::abs(seen - fitted) : std::fabs(seen.real() - fitted.real());
    const double distance =
        channels_ > 1 ? std::abs(seen - assumed) : std::fabs(seen.real() - assumed.real());
    findings_.largest_residual = std::max(findings_.largest_residual, residual);
    findings_.largest_distance = std::max(findings_.largest_distance, distance);
    squares += distance * distance;
    if (assume_.noise && distance > *assume_.noise) {
      const std::int64_t index = first + static_cast<std::int64_t>(k);
      findings_.noise_exceeded.add(index, index);
    }
  }
  distance_squares_ += squares;
  if (assume_.noise_deviation) {
    const double freedom = static_cast<double>(channels_) * static_cast<double>(length_);
    const double variance = *assume_.noise_deviation * *assume_.noise_deviation;
    if (squares / freedom > variance * mean_square_quantile(freedom, kSure)) {
      findings_.noise_exceeded.add(first, first + static_cast<std::int64_t>(length_) - 1);
    }
  }
}

void AssumptionCheck::judge_slew(const Stretch& current) {
  const auto length = static_cast<std::int64_t>(length_);
  if (previous_.first < 0 || previous_.first + length != current.first) {
    return;
  }
  const double distance = static_cast<double>(length);
  const double slew = std::fabs(current.tone.frequency - previous_.tone.frequency) / distance;
  const double deviation =
      std::hypot(current.tone.frequency_deviation, previous_.tone.frequency_deviation) / distance;
  slew_squares_ += slew * slew;
  ++slews_;
  if (slew > findings_.largest_slew) {
    findings_.largest_slew = slew;
    findings_.slew_deviation = deviation;
  }
  if (assume_.slew && slew - kSure * deviation > *assume_.slew) {
    findings_.slew_exceeded.add(previous_.first + length / 2, current.first + length / 2);
  }
}

AssumptionFindings AssumptionCheck::findings() const {
  AssumptionFindings findings = findings_;
  if (stretches_ > 0) {
    findings.noise_deviation = std::sqrt(noise_squares_ / static_cast<double>(stretches_));
    findings.distance_deviation = std::sqrt(
        distance_squares_ / (static_cast<double>(channels_) * static_cast<double>(findings.judged)));
  }
  if (stretches_ > 0) {
    const double count = static_cast<double>(stretches_);
    findings.bias = differences_ / count;
    findings.bias_deviation =
        std::sqrt(std::max(0.0, difference_squares_ / count - findings.bias * findings.bias) / count);
  }
  if (slews_ > 0) {
    findings.slew_root_mean_square = std::sqrt(slew_squares_ / static_cast<double>(slews_));
  }
  return findings;
}

}  // namespace veritrack::reports
