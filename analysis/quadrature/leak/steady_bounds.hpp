// The contribution of gain spread and noise to a step, beside its smooth part (steady_step.hpp).
#pragma once

#include <cmath>

#include "analysis/quadrature/contraction/polar_step_form.hpp"
#include "analysis/quadrature/leak/steady_step.hpp"

namespace veritrack::quadrature {

/// Bounds over everything that covariance and noise may do at a step.
template <typename Scalar>
struct SteadyBounds {
  /// |y|^2 <= eta_factor eta^2 + eta_rest for the eta^2 of the step, which is without noise.
  Scalar eta_factor, eta_rest;
  /// Upper bound on what T J (D y / r + K v / s) exceeds in length, with the J of the step instead of the
  /// averaged one.
  Scalar remainder;
  Scalar least_along;    ///< lower bound on the component of z along the steady one
  Scalar tangent_reach;  ///< how far the tangent of the turn, over s, may be from that of the mean gain
};

namespace detail {

/// A positive number near the square root of a/b, where that is neither very large nor very small: over
/// intervals any will do.
inline double balance(double a, double b) {
  constexpr double kLeast = 1e-6;
  constexpr double kMost = 100.0;
  return std::fmin(std::fmax(std::sqrt(std::fmax(a, 1e-300) / std::fmax(b, 1e-300)), kLeast), kMost);
}
inline rigor::Interval balance(const rigor::Interval& a, const rigor::Interval& b) {
  return rigor::Interval(balance(midpoint(a), midpoint(b)));
}

}  // namespace detail

/// The gain is K + s D Y D' H' / r, |Y| <= 1, with the mean gain K. So y = Y D' H' (i + v), |y| <= eta + m
/// |v| with m^2 the largest eigenvalue of the spread of the plane, and (a + b)^2 <= (1 + theta) a^2 + (1 +
/// 1/theta) b^2 for every theta > 0. The corrected z lies within `radius` of the mean one, z_bar = rho* + s
/// shift, on which the Jacobian J of (|z|, arg z) depends: its rows are the radial unit vector, which turns
/// by at most 1/|z| per unit, and the transverse one over |z|, which changes by 1/|z|^2. The spread of the
/// gain and the noise share one segment, from z_bar to the z that the step leaves, and one averaged J
/// multiplies both. Averaged over that segment, J is J(z_bar) + E with rows of E up to half of that times
/// `radius`, and E multiplies what leads from z_bar to z: no more than `radius`, too.
template <typename Scalar>
[[nodiscard]] SteadyBounds<Scalar> steady_bounds(const SteadyStep<Scalar>& step,
                                                 const SteadySetting<Scalar>& setting, const Scalar& level,
                                                 const Scalar& noise) {
  using trackers::detail::square;
  const Scalar one(1.0);
  const Scalar half(0.5);
  const auto& t = setting.metric;
  const Scalar over_r = one / setting.design.r;
  SteadyBounds<Scalar> bounds;
  const Scalar spread = detail::larger_eigenvalue(step.spread11, step.spread12, step.spread22);
  const Scalar more_eta = spread * square(noise);
  const Scalar theta = detail::balance(more_eta, step.eta_squared);
  bounds.eta_factor = one + theta;
  bounds.eta_rest = (one + one / theta) * more_eta;
  const Scalar eta = detail::root(step.eta_squared) * over_r;
  const Scalar largest_gain = detail::larger_eigenvalue(step.largest11, step.largest12, step.largest22);
  const Scalar noise_reach = largest_gain * noise;
  const Scalar radius = level * detail::root(spread) * eta + noise_reach;
  const Scalar reach1 = detail::root(step.spread11) * eta + noise_reach / level;
  const Scalar reach2 = detail::root(step.spread22) * eta + noise_reach / level;
  bounds.least_along = setting.steady.rho + level * step.shift1 - radius;
  // (a + o2)/(b + o1) - a/b = (o2 - (a/b) o1)/(b + o1).
  bounds.tangent_reach =
      (reach2 + detail::size(Scalar(level * turn_tangent(setting, step, level))) * reach1) /
      bounds.least_along;
  const Scalar bend = half * radius / bounds.least_along;
  const Scalar bent =
      t.t11 * bend + detail::root(Scalar(square(t.t12) + square(t.t22))) * bend / bounds.least_along;
  bounds.remainder = bent * radius / level;
  return bounds;
}

}  // namespace veritrack::quadrature
