// The errors of the single-channel tracker in a window, as a recursion of numbers.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "checker/single_channel/covariance_window.hpp"

namespace veritrack::checker {

/// A verified window, and the recursion of the errors in it: x_k = |e_k| in the metric P_k^-1. As long as x
/// <= R, for m = 1, ..., n,
///   x_{k+m} <= kappa_m x_k + c sum_{j<m} kappa_{m-1-j} x_{k+j}^2 + g^m sqrt(m) u + rho sum_{j<m} kappa_j,
/// where a rounded step adds at most rho to e, and P changes by at most the part 1 - 1/g^2.
class ErrorSet {
 public:
  ErrorSet(WindowStatement window, const SingleChannelDesign& design, const Ball& noise, const Ball& start,
           const Ball& error_rounding)
      : window_(std::move(window)), noise_(noise), start_(start), kappa_{one} {
    const Ball growth = one / sqrt(one - window_.covariance_rounding);
    const Ball input = sqrt(square(noise) / design.r + square(window_.slew) / design.q2);
    Ball grown = one;
    for (const Ball& share : window_.shares) {
      grown = grown * growth;
      sum_ += kappa_.back();
      kappa_.push_back(grown * sqrt(one - share));
      pushed_.push_back(grown * sqrt(Ball(static_cast<double>(pushed_.size()))) * input +
                        error_rounding * sum_);
    }
    // |delta nu + i nu^2/2| falls short of the exact innovation by at most |nu|^3/6, |nu| <= x sqrt(P33).
    const Ball& variance = window_.frequency_variance;
    curvature_ = (window_.curvature + window_.radius * variance * sqrt(variance) / Ball(6.0)) /
                 sqrt(window_.signal_uncertainty) * growth;
  }

  [[nodiscard]] const WindowStatement& window() const { return window_; }
  [[nodiscard]] const Ball& noise() const { return noise_; }
  [[nodiscard]] const Ball& start() const { return start_; }
  [[nodiscard]] std::size_t samples() const { return window_.shares.size(); }
  /// The factor by which a window multiplies errors that are at most `level` throughout, and the resulting
  /// level.
  [[nodiscard]] Ball factor(const Ball& level) const { return kappa_.back() + curvature_ * sum_ * level; }
  [[nodiscard]] Ball after(const Ball& level) const { return factor(level) * level + pushed_.back(); }
  [[nodiscard]] Ball rate() const {
    return exp(log(factor(window_.radius)) / Ball(static_cast<double>(samples())));
  }
  [[nodiscard]] Ball frequency_error(const Ball& level) const {
    return level * sqrt(window_.frequency_variance);
  }
  /// Bounds on x_0, ..., x_samples for x_0 <= start; everything where they are not certainly within R.
  [[nodiscard]] std::vector<Ball> levels(const Ball& start, std::size_t samples) const {
    std::vector<Ball> x{start};
    for (std::size_t k = 1; k <= samples; ++k) {
      const std::size_t m = std::min(k, kappa_.size() - 1);
      Ball curved = zero;
      for (std::size_t j = 0; j < m; ++j) {
        curved += kappa_[m - 1 - j] * square(x[k - m + j]);
      }
      const Ball next = kappa_[m] * x[k - m] + curvature_ * curved + pushed_[m];
      x.push_back(certainly_at_most(next, window_.radius) ? next.upper() : Ball::everything());
    }
    return x;
  }
  /// Starts of that level are never above R: not in the first window, and so in none.
  [[nodiscard]] bool keeps(const Ball& start) const {
    return certainly_less(after(window_.radius), window_.radius) &&
           certainly_at_most(start, window_.radius) && levels(start, samples()).back().finite();
  }
  /// limsup x_k for starts that are kept: L with L <= after(L) and L <= R, where after(L) - L is convex and
  /// negative at R, is at most the smaller root.
  [[nodiscard]] Ball ultimate() const {
    const Ball room = one - kappa_.back();
    const Ball& pushed = pushed_.back();
    return two * pushed / (room + sqrt(square(room) - four * curvature_ * sum_ * pushed));
  }
  /// sup x_k for starts of that level: a window that starts at a level between the smaller root and R keeps
  /// that level.
  [[nodiscard]] Ball largest(const Ball& start) const {
    Ball most = ultimate();
    for (const Ball& level : levels(start, samples())) {
      most = max(most, level);
    }
    return most;
  }
  /// From that sample on |nu| <= frequency_error: this is true for a window, and the level is kept.
  [[nodiscard]] bool settled(const Ball& start, const Ball& frequency_error, std::size_t sample) const {
    const Ball target = frequency_error / sqrt(window_.frequency_variance);
    const std::vector<Ball> x = levels(start, sample + samples() - 1);
    return certainly_at_most(ultimate(), target) &&
           std::all_of(x.begin() + static_cast<std::ptrdiff_t>(sample), x.end(),
                       [&](const Ball& level) { return certainly_at_most(level, target); });
  }

 private:
  WindowStatement window_;
  Ball noise_, start_;
  std::vector<Ball> kappa_;         ///< kappa_0 = 1, ..., kappa_n
  Ball sum_ = zero;                 ///< of kappa_0, ..., kappa_{n-1}
  Ball curvature_;                  ///< c
  std::vector<Ball> pushed_{zero};  ///< what noise, slew and rounding add in 0, ..., n samples
};

}  // namespace veritrack::checker
