// A real recording as in-phase and quadrature samples: a Hilbert transformer of finite length.
//
// The ideal transformer turns cos(w k) into sin(w k) for every frequency w in (0, pi) rad/sample. Its
// response is h(n) = 2 / (pi n) for odd n and 0 for even n (A. V. Oppenheim and R. W. Schafer, Discrete-Time
// Signal Processing, section 12.4). Here it is cut off at |n| = M and multiplied by Blackman's window
//     w(n) = 0.42 + 0.5 cos(pi n / (M + 1)) + 0.08 cos(2 pi n / (M + 1)).
// The response is odd about its middle, so that phases are exact at every frequency: a tone A cos(w k + p)
// becomes A g(w) sin(w k + p) with the gain g(w) = 2 sum of h(n) sin(n w) over n = 1, ..., M, which `gain`
// evaluates. The result for a sample is known M samples later.
//
// White noise becomes noise that is white in each channel but not as a pair: the quadrature noise of a sample
// depends on the in-phase noise of its neighbours.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "trackers/signals/phasor.hpp"

namespace veritrack::trackers {

/// The transformer with its memory. It does not allocate after its construction.
class HilbertFilter {
 public:
  /// `half_length` is M, odd and at least 1. Throws std::invalid_argument.
  explicit HilbertFilter(int half_length) : half_length_(half_length) {
    if (half_length < 1 || half_length % 2 == 0) {
      throw std::invalid_argument("the half length of a Hilbert filter must be odd and at least 1");
    }
    constexpr double kPi = 2.0 * kHalfPi;
    response_.reserve(static_cast<std::size_t>(half_length / 2 + 1));
    for (int n = 1; n <= half_length; n += 2) {
      const double angle = kPi * n / (half_length + 1);
      const double window = 0.42 + 0.5 * std::cos(angle) + 0.08 * std::cos(2.0 * angle);
      response_.push_back(2.0 / (kPi * n) * window);
    }
    memory_.assign(2 * length(), 0.0);
  }

  /// M: the result belongs to the sample pushed this many samples before the last one.
  [[nodiscard]] int delay() const { return half_length_; }

  /// g at a frequency in rad/sample: the factor of the quadrature part's amplitude.
  [[nodiscard]] double gain(double frequency) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < response_.size(); ++i) {
      sum += response_[i] * std::sin((2.0 * static_cast<double>(i) + 1.0) * frequency);
    }
    return 2.0 * sum;
  }

  /// The largest |gain - 1| over the frequencies from `low` to `high`, rad/sample, on a grid.
  [[nodiscard]] double gain_error(double low, double high) const {
    const int places = 4 * half_length_ + 1;
    double largest = 0.0;
    for (int i = 0; i <= places; ++i) {
      largest = std::max(largest, std::fabs(gain(low + (high - low) * i / places) - 1.0));
    }
    return largest;
  }

  /// One sample more, signal units. True once there is a result: from sample 2 M + 1 on.
  bool push(double sample) {
    memory_[next_] = memory_[next_ + length()] = sample;
    next_ = (next_ + 1) % length();
    count_ = std::min(count_ + 1, length());
    return count_ == length();
  }

  /// The sample that was pushed `delay()` samples before the last one.
  [[nodiscard]] double in_phase() const { return memory_[next_ + static_cast<std::size_t>(half_length_)]; }

  /// Its quadrature part, signal units.
  [[nodiscard]] double quadrature() const {
    const double* middle = memory_.data() + next_ + half_length_;
    double sum = 0.0;
    for (std::size_t i = 0; i < response_.size(); ++i) {
      const auto n = static_cast<std::ptrdiff_t>(2 * i + 1);
      sum += response_[i] * (middle[-n] - middle[n]);
    }
    return sum;
  }

  /// Forgets all samples.
  void clear() { count_ = 0; }

 private:
  [[nodiscard]] std::size_t length() const { return 2 * static_cast<std::size_t>(half_length_) + 1; }

  int half_length_;
  std::vector<double> response_;  ///< h(1), h(3), ..., h(M)
  std::vector<double> memory_;    ///< the last 2 M + 1 samples, twice: one stretch holds them in their order
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

/// The least half length, of those that grow by about a quarter from 7 on, whose gain differs from 1 by at
/// most `tolerance` for all frequencies from `low` to `high`, rad/sample; `longest` (odd) if there is none.
[[nodiscard]] inline int hilbert_half_length(double low, double high, double tolerance, int longest = 2047) {
  int half_length = 7;
  while (half_length < longest && !(HilbertFilter(half_length).gain_error(low, high) <= tolerance)) {
    half_length = std::min(longest, (half_length + half_length / 4) | 1);
  }
  return half_length;
}

}  // namespace veritrack::trackers
