#include "reports/recording/lock_indicator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace veritrack::reports {

LockIndicator::LockIndicator(std::size_t window, int channels)
    : channels_(channels), turned_(window), power_(window) {}

void LockIndicator::clear() {
  std::fill(turned_.begin(), turned_.end(), 0.0);
  std::fill(power_.begin(), power_.end(), 0.0);
  next_ = count_ = 0;
  turned_sum_ = 0.0;
  power_sum_ = 0.0;
}

void LockIndicator::pass(double frequency) {
  phase_ = std::remainder(phase_ + frequency, 2.0 * std::numbers::pi);
}

void LockIndicator::push(const RecordedSample& sample, double frequency) {
  const double cosine = std::cos(phase_);
  const double sine = std::sin(phase_);
  const std::complex<double> turned(sample.in_phase * cosine + sample.quadrature * sine,
                                    sample.quadrature * cosine - sample.in_phase * sine);
  const double power = sample.in_phase * sample.in_phase + sample.quadrature * sample.quadrature;
  pass(frequency);
  turned_sum_ += turned - turned_[next_];
  power_sum_ += power - power_[next_];
  turned_[next_] = turned;
  power_[next_] = power;
  count_ = std::min(count_ + 1, power_.size());
  if (++next_ == power_.size()) {
    next_ = 0;
    // What rounding has left in the running sums goes with every round.
    turned_sum_ = std::accumulate(turned_.begin(), turned_.end(), std::complex<double>(0.0));
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
  const double whole = static_cast<double>(count_) * power_sum_;
  return std::clamp((channels_ > 1 ? 1.0 : 2.0) * std::norm(turned_sum_) / whole, 0.0, 1.0);
}

}  // namespace veritrack::reports
