// One step of the quadrature tracker without a leak, in the frame of the estimated phase: the checker's own
// implementation, from the equations of docs/contraction.md. Signals have amplitude 1.
//
// The step is written with secants: for two points f and g of the plane, f . g > 0,
//     |g| - |f|         = (f + g) . (g - f) / (|f| + |g|)
//     arg g - arg f     = (atan(t)/t) f x (g - f) / (f . g),   t = f x g / f . g,
// so that the errors after a step are exactly linear in the errors before it, the noise and the spread of the
// gain, with coefficients that depend on the place of the step.
#pragma once

#include <array>

#include "checker/numbers/slope.hpp"

namespace veritrack::checker {

/// A covariance [[p11, 0, 0], [0, p22, p23], [0, p23, p33]]: rows amplitude, phase, frequency.
template <typename S>
struct Covariance {
  S p11, p22, p23, p33;
};

/// T = [[amplitude, 0, 0], [0, phase, coupling], [0, 0, frequency]].
struct Metric {
  Ball amplitude, phase, coupling, frequency;
};

/// A set to be checked: Omega = {|T e| <= R} x {lower <= P <= upper}, with the noise, slew and rounding
/// assumed in it.
struct Setting {
  Ball q1, q2, r;
  Metric metric;
  Covariance<Ball> lower, upper;
  Ball largest_amplitude, largest_chi;  ///< of |a| and |psi + nu| over the set
  Ball radius, noise, slew;
  Ball rate, noise_gain, slew_gain;
  bool noisy = false, slewing = false;
  /// Bounds on what rounding adds to |T e| in a step, and to P as a share of `lower` (rounded_step.hpp).
  Ball error_rounding, covariance_rounding;
};

/// The gains and the covariance after prediction with F(rho) and update.
template <typename S>
struct Update {
  Covariance<S> filtered;
  S amplitude, phase, frequency;  ///< K11, K22, K32
};

template <typename S>
Update<S> update(const Setting& setting, const Covariance<Ball>& p, const S& rho) {
  const Ball p11 = p.p11 + setting.q1;
  const S p23 = p.p23 + rho * p.p33;
  const S p22 = p.p22 + setting.q1 + rho * (p.p23 + p23);
  const S over = reciprocal(p22 + setting.r);
  const S k1 = p11 / (p11 + setting.r);
  const S k2 = one - setting.r * over;
  const S k3 = p23 * over;
  return {
      {setting.r * k1, setting.r * k2, setting.r * k3, p.p33 + setting.q2 - square(p23) * over}, k1, k2, k3};
}

/// The two rows that take g - f to |g| - |f| and to arg g - arg f. `dot` must be certainly positive. Among
/// all such rows, these are the same for f and g exchanged, and so differ from the derivatives in the middle
/// by terms of the second order: less is lost where they multiply vectors other than g - f.
template <typename S>
struct Secant {
  std::array<S, 2> length, angle;
  S dot;
};

template <typename S>
Secant<S> secant(const std::array<S, 2>& f, const std::array<S, 2>& g) {
  const S over = reciprocal(sqrt(square(f[0]) + square(f[1])) + sqrt(square(g[0]) + square(g[1])));
  const S dot = f[0] * g[0] + f[1] * g[1];
  const S tangent = (f[0] * g[1] - f[1] * g[0]) / dot;
  // f x (g - f) = (f + g)/2 x (g - f).
  const S turn = half * arctangent_over(tangent) / dot;
  const std::array<S, 2> both{f[0] + g[0], f[1] + g[1]};
  return {{both[0] * over, both[1] * over}, {-(turn * both[1]), turn * both[0]}, dot};
}

/// The correction at amplitude error a and predicted phase error chi, in the frame of the predicted phase,
/// where the prediction is (1 + a, 0) and the signal (cos chi, -sin chi).
template <typename S>
struct Correction {
  Covariance<S> spread;           ///< (Phi_upper - Phi_lower)/2
  S k1, k2, k3;                   ///< the mean gains
  S cosine_slope, sine_slope;     ///< (1 - cos chi)/chi, sin(chi)/chi
  std::array<S, 2> signal, mean;  ///< the signal; the estimate corrected by the mean gain, without noise
  std::array<Ball, 2> reach;      ///< how far the corrected estimate can be from it
  /// The innovation of errors (a, chi): linear in them.
  [[nodiscard]] std::array<S, 2> innovation(const Ball& a, const Ball& chi) const {
    return {-(a + cosine_slope * chi), -(sine_slope * chi)};
  }
};

template <typename S>
Correction<S> correction(const Setting& setting, const S& a, const S& chi) {
  const S rho = a + one;
  const Update<S> low = update(setting, setting.lower, rho);
  const Update<S> high = update(setting, setting.upper, rho);
  Correction<S> c;
  c.spread = {half * (high.filtered.p11 - low.filtered.p11), half * (high.filtered.p22 - low.filtered.p22),
              half * (high.filtered.p23 - low.filtered.p23), half * (high.filtered.p33 - low.filtered.p33)};
  c.k1 = half * (low.amplitude + high.amplitude);
  c.k2 = half * (low.phase + high.phase);
  c.k3 = half * (low.frequency + high.frequency);
  c.sine_slope = sine_over(chi);
  c.cosine_slope = half * chi * square(sine_over(half * chi));
  c.signal = {cos(chi), -sin(chi)};
  const std::array<S, 2> innovation{c.signal[0] - rho, c.signal[1]};
  c.mean = {rho + c.k1 * innovation[0], c.k2 * innovation[1]};
  // |(K - K_mean) i| by the spread of the gain, |K v| by the norm of the upper gain.
  const Ball along = root_of_non_negative(value_of(c.spread.p11));
  const Ball across = root_of_non_negative(value_of(c.spread.p22));
  const Ball size = root_of_non_negative(square(along * value_of(innovation[0])) +
                                         square(across * value_of(innovation[1]))) /
                    setting.r;
  const Ball noise = max(value_of(high.amplitude), value_of(high.phase)) * setting.noise;
  c.reach = {(along * size + noise).upper(), (across * size + noise).upper()};
  return c;
}

}  // namespace veritrack::checker
