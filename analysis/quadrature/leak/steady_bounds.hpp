// What the spread of the gain and the noise add to the smooth part of a step (steady_step.hpp).
#pragma once

#include <cmath>

#include "analysis/quadrature/contraction/polar_step_form.hpp"
#include "analysis/quadrature/leak/steady_step.hpp"

namespace veritrack::quadrature {

/// Bounds over everything that covariance and noise may do at a step.
template <typename Scalar>
struct SteadyBounds {
  /// Upper bound, in the Loewner order, on T J spread J' T' / r^2 for every J: gram_factor times that of the
  /// step plus gram_rest on the diagonal.
  Symmetric<Scalar> gram;
  Scalar gram_factor, gram_rest;
  Scalar noise_gain;     ///< upper bound on |T J K|: what the noise adds to T e+ is T J K v
  Scalar least_along;    ///< lower bound on the component of z along the steady one
  Scalar tangent_reach;  ///< how far the tangent of the turn, over s, may be from that of the mean gain
};

namespace detail {

/// A positive number near the square root of a/b: over intervals any will do.
inline double balance(double a, double b) {
  return std::sqrt(std::fmax(a, 1e-300) / std::fmax(b, 1e-300));
}
inline rigor::Interval balance(const rigor::Interval& a, const rigor::Interval& b) {
  return rigor::Interval(balance(midpoint(a), midpoint(b)));
}

}  // namespace detail

/// The z that a step leaves lies within `radius` of the mean one, z_bar = rho* + s shift, on which the
/// Jacobian J of (|z|, arg z) depends: its rows are the radial unit vector, which turns by at most 1/|z| per
/// unit, and the transverse one over |z|, which changes by 1/|z|^2. The spread of the gain and the noise
/// share one segment: it leads from z_bar, the estimate after the mean gain without noise, to the z that the
/// step leaves, so that `radius` is the sum of what both do, and one averaged J multiplies both. Averaged
/// over that segment, J is J(z_bar) + E with rows of E up to half of that times `radius`; `gram` (the spread)
/// and `noise_gain` (the noise) both contain E. And (X + Y)(X + Y)' <= (1 + theta) X X' + (1 + 1/theta) |Y|^2
/// I for every theta > 0.
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
  const Scalar eta = detail::root(step.eta_squared) * over_r;
  const Scalar spread = detail::larger_eigenvalue(step.spread11, step.spread12, step.spread22);
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

  const Scalar rest = square(Scalar(bent * over_r)) * spread;
  const auto& g = step.gram;
  const Scalar theta = detail::balance(rest, Scalar(g.p11 + g.p22 + g.p33));
  bounds.gram_factor = one + theta;
  bounds.gram_rest = (one + one / theta) * rest;
  const Scalar& more = bounds.gram_factor;
  const Scalar& diagonal = bounds.gram_rest;
  bounds.gram = {more * g.p11 + diagonal, more * g.p12, more * g.p13,
                 more * g.p22 + diagonal, more * g.p23, more * g.p33 + diagonal};

  // |T J K| for every gain K = P+ H' / r: that of the mean one, and of the spread.
  const auto& n = step.noise;
  const Scalar mean_squared = detail::larger_eigenvalue(Scalar(square(n[0]) + square(n[2]) + square(n[4])),
                                                        Scalar(n[0] * n[1] + n[2] * n[3] + n[4] * n[5]),
                                                        Scalar(square(n[1]) + square(n[3]) + square(n[5])));
  const auto& b = bounds.gram;
  const Scalar spread_squared =
      detail::larger(detail::larger(Scalar(b.p11 + detail::size(b.p12) + detail::size(b.p13)),
                                    Scalar(b.p22 + detail::size(b.p12) + detail::size(b.p23))),
                     Scalar(b.p33 + detail::size(b.p13) + detail::size(b.p23)));
  bounds.noise_gain = detail::root(mean_squared) + bent * largest_gain +
                      level * detail::root(Scalar(spread_squared * spread));
  return bounds;
}

}  // namespace veritrack::quadrature
