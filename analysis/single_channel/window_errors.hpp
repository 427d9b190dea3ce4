// How the error of the single-channel tracker moves from sample to sample, as a recursion of numbers that
// follows from a verified window (window_claim.hpp). docs/single-channel.md, section 4; docs/rounding.md,
// "The single-channel tracker".
//
// With x_k = |e_k| in the metric P_k^-1, rounding that adds at most rho to e in it and mu P to P in a step,
// g = 1/sqrt(1 - mu), kappa_m = g^m sqrt(1 - shares_m), c = g curvature / sqrt(signal_uncertainty) and u^2 =
// V^2/r + W^2/q2, as long as x_k <= R, for m = 1, ..., n,
//     x_{k+m} <= kappa_m x_k + c sum_{j<m} kappa_{m-1-j} x_{k+j}^2 + g^m sqrt(m) u + rho sum_{j<m} kappa_j.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/rigor/interval.hpp"
#include "analysis/single_channel/window_claim.hpp"

namespace veritrack::single_channel {

/// The numbers of the recursion. Needs the upward mode.
class WindowErrors {
 public:
  /// For a claim verified for this design, under noise |v| <= V (relative to the amplitude) and slew |w| <= W
  /// (rad/sample per sample).
  WindowErrors(const trackers::ToneModel<rigor::Interval>& design, const WindowClaim& claim,
               const rigor::Interval& noise, const rigor::Interval& slew);

  /// True only when errors of at most R for a window are followed by errors of at most R for ever.
  [[nodiscard]] bool keeps_radius() const;
  /// A bound on the error after a window in which errors are at most `level`.
  [[nodiscard]] rigor::Interval after_window(const rigor::Interval& level) const;
  /// kappa_n + c R sum kappa, to the power 1/n: by which errors shrink a sample, in the mean over a window.
  [[nodiscard]] rigor::Interval rate() const;
  /// An upper bound on u for which keeps_radius would be true; below zero or not finite when there is none.
  [[nodiscard]] rigor::Interval largest_input() const;
  /// Bounds on x_0, ..., x_samples for x_0 <= start; nothing unless all of them are at most R.
  [[nodiscard]] std::optional<std::vector<double>> levels(double start, int samples) const;
  /// A bound on limsup x_k, for errors of at most R for a window.
  [[nodiscard]] double ultimate() const;
  /// True only when errors of at most `level` for a window are followed by such errors for ever.
  [[nodiscard]] bool keeps(double level) const;
  [[nodiscard]] int window() const { return static_cast<int>(shrinkage_.size()) - 1; }

 private:
  /// kappa_n + c sum kappa level: what n samples make of errors of at most `level`, in terms of it.
  [[nodiscard]] rigor::Interval factor(const rigor::Interval& level) const;
  /// The contributions of rounding, and of noise, slew and rounding, in this many samples.
  [[nodiscard]] rigor::Interval pushed_by_rounding(std::size_t samples) const;
  [[nodiscard]] rigor::Interval pushed(std::size_t samples) const;
  [[nodiscard]] double next(const std::vector<double>& levels) const;
  [[nodiscard]] bool is_constant(const std::vector<double>& levels) const;

  rigor::Interval radius_;
  std::vector<rigor::Interval> shrinkage_;  ///< kappa_0 = 1, ..., kappa_n
  rigor::Interval curvature_;               ///< c
  rigor::Interval input_;                   ///< u
  std::vector<rigor::Interval> growth_;     ///< g^0, ..., g^n
  rigor::Interval error_rounding_;          ///< rho
};

}  // namespace veritrack::single_channel
