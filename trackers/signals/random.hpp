// Random numbers that are identical bit for bit on every machine.
//
// The C++ standard fixes the stream of std::mt19937_64 but not the output of its distributions, and libm's
// logarithm differs between machines in the last bit. So only the engine's 64-bit words are used, with
// comparisons and a few additions and multiplications, whose rounding IEEE 754 fixes. Round to nearest,
// as everywhere outside analysis/rigor, is assumed.
#pragma once

#include <cstdint>
#include <random>
#include <utility>

namespace veritrack::trackers {

/// A seeded stream of uniform and normal deviates.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1): the upper 53 bits of a word, a multiple of 2^-53.
  [[nodiscard]] double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  /// A normal deviate with mean 0 and variance 1. Algorithm N of C. F. F. Karney, "Sampling exactly from the
  /// normal distribution", ACM Trans. Math. Software 42(1), article 3, 2016, with 53-bit uniform deviates in
  /// place of ones whose digits are drawn as needed: choose |deviate| = k + x with k an integer and x in [0,
  /// 1), by rejections that have exponential probabilities without computing an exponential. About 22 words a
  /// deviate.
  [[nodiscard]] double normal() {
    for (;;) {
      // k with probability (1 - e^{-1/2}) e^{-k/2}.
      int k = 0;
      while (event_of_probability_exp_minus_half()) {
        ++k;
      }
      // Keep k with probability e^{-k(k-1)/2}.
      bool kept = true;
      for (int i = 0; i < k * (k - 1) && kept; ++i) {
        kept = event_of_probability_exp_minus_half();
      }
      if (!kept) {
        continue;
      }
      // Keep x with probability e^{-x(2k+x)/2} = (e^{-x(2k+x)/(2k+2)})^{k+1}.
      const double x = uniform();
      for (int i = 0; i <= k && kept; ++i) {
        kept = event_of_probability_exp_minus_x(k, x);
      }
      if (!kept) {
        continue;
      }
      const double magnitude = static_cast<double>(k) + x;
      return (engine_() >> 63) != 0 ? -magnitude : magnitude;
    }
  }

  /// Uniform in the disc of this radius about the origin: from the square around it, by rejection.
  [[nodiscard]] std::pair<double, double> in_disc(double radius) {
    for (;;) {
      const double x = 2.0 * uniform() - 1.0;
      const double y = 2.0 * uniform() - 1.0;
      if (x * x + y * y <= 1.0) {
        return {radius * x, radius * y};
      }
    }
  }

 private:
  // Von Neumann: if 1/2 > u1 > u2 > ... > un is the longest such run of uniform deviates, then n >= m has the
  // probability 2^-m / m!, and n is even with probability sum (-1/2)^m / m! = e^{-1/2}.
  [[nodiscard]] bool event_of_probability_exp_minus_half() {
    bool even = true;
    double last = 0.5;
    for (;;) {
      const double next = uniform();
      if (!(next < last)) {
        return even;
      }
      last = next;
      even = !even;
    }
  }

  // The same with x > u1 > u2 > ..., each step allowed with probability p = (2k + x) / (2k + 2): e^{-px}.
  [[nodiscard]] bool event_of_probability_exp_minus_x(int k, double x) {
    const double twice = 2.0 * static_cast<double>(k);
    const double numerator = twice + x;
    const double denominator = twice + 2.0;
    bool even = true;
    double last = x;
    for (;;) {
      const double next = uniform();
      if (!(next < last) || !(uniform() * denominator < numerator)) {
        return even;
      }
      last = next;
      even = !even;
    }
  }

  std::mt19937_64 engine_;
};

}  // namespace veritrack::trackers
