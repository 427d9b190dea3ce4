// Mean and deviation of numbers as they come in.
#pragma once

#include <cmath>

namespace veritrack::search {

/// One that is not a number spoils both, as it should; before the first both are NaN or zero.
class RunningStatistics {
 public:
  void add(double value) {
    ++count_;
    const double from_mean = value - mean_;
    mean_ += from_mean / count_;
    squares_ += from_mean * (value - mean_);
  }
  [[nodiscard]] double count() const { return count_; }
  [[nodiscard]] double mean() const { return mean_; }
  /// Root mean square about the mean.
  [[nodiscard]] double deviation() const { return std::sqrt(squares_ / count_); }

 private:
  double count_ = 0.0;
  double mean_ = 0.0;
  double squares_ = 0.0;
};

}  // namespace veritrack::search
