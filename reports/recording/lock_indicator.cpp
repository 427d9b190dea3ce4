#include "reports/recording/lock_indicator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace veritrack::reports {

LockIndicator::LockIndicator(std::size_t window, int channels, const Waveform& waveform)
    : channels_(channels),
      waveform_(waveform),
      turned_(waveform.harmonics().size(), std::vector<std::complex<double>>(window)),
      power_(window),
      turned_sums_(waveform.harmonics().size()) {}

void LockIndicator::clear() {
  for (std::vector<std::complex<double>>& turned : turned_) {
    std::fill(turned.begin(), turned.end(), 0.0);
  }
  std::fill(power_.begin(), power_.end(), 0.0);
  std::fill(turned_sums_.begin(), turned_sums_.end(), 0.0);
  next_ = count_ = 0;
  power_sum_ = 0.0;
}

void LockIndicator::pass(double frequency) {
  phase_ = std::remainder(phase_ + frequency, 2.0 * std::numbers::pi);
}

void LockIndicator::push(const RecordedSample& sample, double frequency) {
  const std::complex<double> seen(sample.in_phase, channels_ > 1 ? sample.quadrature : 0.0);
  for (std::size_t i = 0; i < turned_.size(); ++i) {
    const std::complex<double> turned = seen * std::polar(1.0, -waveform_.harmonics()[i].order * phase_);
    turned_sums_[i] += turned - turned_[i][next_];
    turned_[i][next_] = turned;
  }
  pass(frequency);
  power_sum_ += std::norm(seen) - power_[next_];
  power_[next_] = std::norm(seen);
  count_ = std::min(count_ + 1, power_.size());
  if (++next_ == power_.size()) {
    next_ = 0;
    // The rounding left in the running sums goes with every round.
    for (std::size_t i = 0; i < turned_.size(); ++i) {
      turned_sums_[i] = std::accumulate(turned_[i].begin(), turned_[i].end(), std::complex<double>(0.0));
    }
    power_sum_ = std::accumulate(power_.begin(), power_.end(), 0.0);
  }
}

double LockIndicator::share() const {
  if (4 * count_ < power_.size()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (!(power_sum_ > 0.0)) {
    return 0.0;
  }
  return std::clamp(waveform_.power(turned_sums_) / (static_cast<double>(count_) * power_sum_), 0.0, 1.0);
}

}  // namespace veritrack::reports
