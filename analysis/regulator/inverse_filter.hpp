// The inverse 1/A of a polynomial A = a_0 + a_1 q^-1 + ... + a_p q^-p, whose coefficients are intervals:
// whether it is stable, and its gain for bounded signals.
//
// A finite filter h, in doubles, stands for 1/A. With r = A h - 1, also finite, |r|_1 < 1 implies that A h,
// and so A, has no zero with |z^-1| <= 1 (|1 + r| >= 1 - |r|_1 there), and the impulse response g of 1/A
// obeys g = h - g r,
//     |g|_1 <= |h|_1 / (1 - |r|_1),   |g - h|_1 <= |g|_1 |r|_1.
// The same with the weights i + 1 in the sums, since i + j + 1 <= (i + 1)(j + 1).
// Nothing is iterated in intervals, so nothing grows. docs/regulator.md, section 2.
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/rigor/interval.hpp"

namespace veritrack::regulator {

/// The proved bounds on 1/A, from above.
class InverseFilter {
 public:
  /// `coefficients` a_0, ..., a_p. Needs the upward mode.
  explicit InverseFilter(const std::vector<rigor::Interval>& coefficients);

  /// A is Schur: all its zeros in z lie inside the unit circle. False also where h was not good enough.
  [[nodiscard]] bool is_stable() const { return stable_; }
  /// |g|_1: the largest |output| for |input| <= 1. Empty unless stable.
  [[nodiscard]] const rigor::Interval& norm() const { return norm_; }
  /// The largest |g_i|. Empty unless stable.
  [[nodiscard]] const rigor::Interval& peak() const { return peak_; }
  /// sum of (i + 1) |g_i|. Empty unless stable.
  [[nodiscard]] const rigor::Interval& weighted_norm() const { return weighted_norm_; }
  /// sum of |g_i| over i >= `first`. Empty unless stable. Needs the upward mode.
  [[nodiscard]] rigor::Interval tail(std::size_t first) const;
  /// The number of coefficients of h: the tail is not smaller behind them.
  [[nodiscard]] std::size_t size() const { return response_.size(); }

 private:
  std::vector<double> response_;  // h
  bool stable_ = false;
  rigor::Interval norm_;
  rigor::Interval peak_;
  rigor::Interval weighted_norm_;
  rigor::Interval error_;  // |g - h|_1
};

}  // namespace veritrack::regulator
