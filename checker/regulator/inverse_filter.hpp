// The inverse of a polynomial in the delay: whether it is stable, and the sum of the sizes of its impulse
// response (docs/regulator.md, section 2).
#pragma once

#include <cstddef>
#include <vector>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

class InverseFilter {
 public:
  /// The inverse of a_0 + a_1 q^-1 + ...
  explicit InverseFilter(const std::vector<Ball>& coefficients);

  /// Certainly no zero on or outside the unit circle.
  [[nodiscard]] bool is_stable() const { return stable_; }
  /// Upper bounds on the sum of |g_i| over all i, and over i >= first. Balls of everything unless stable.
  [[nodiscard]] const Ball& norm() const { return norm_; }
  /// Likewise on the largest |g_i|.
  [[nodiscard]] const Ball& peak() const { return peak_; }
  /// Likewise on the sum of (i + 1) |g_i|.
  [[nodiscard]] const Ball& delay_norm() const { return delay_norm_; }
  [[nodiscard]] Ball tail(std::size_t first) const;

 private:
  std::vector<double> response_;
  bool stable_ = false;
  Ball norm_ = Ball::everything();
  Ball peak_ = Ball::everything();
  Ball delay_norm_ = Ball::everything();
  Ball off_ = Ball::everything();
};

}  // namespace veritrack::checker
