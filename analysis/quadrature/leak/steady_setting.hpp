// The data common to all steps of a set around the steady state, over different scalars.
#pragma once

#include <array>
#include <cmath>

#include "analysis/quadrature/leak/steady_gain.hpp"
#include "analysis/rigor/secant.hpp"

namespace veritrack::quadrature {

/// T = [[t11, t12, t13], [0, t22, t23], [0, 0, t33]], scaled such that level 1 is |T b| <= 1.
template <typename Scalar>
struct TriangularMetric {
  Scalar t11, t12, t13, t22, t23, t33;
};

/// An orthonormal basis u1, u2, n of the space of u = T b in which alpha and c depend on x and y only: with u
/// = x u1 + y u2 + t n the error b = (alpha, c - m, m) has alpha = a11 x, c = a21 x + a22 y and m = m1 x + m2
/// y
/// + m3 t.
template <typename Scalar>
struct SteadyDirections {
  Scalar a11, a21, a22, m1, m2, m3;
};

/// The directions of a metric: Gram and Schmidt on the rows of T^-1 that belong to alpha and to c.
template <typename Scalar>
[[nodiscard]] SteadyDirections<Scalar> directions_of(const TriangularMetric<Scalar>& t) {
  using std::sqrt;
  using trackers::detail::square;
  const Scalar one(1.0);
  const Scalar zero(0.0);
  const std::array<Scalar, 3> alpha{one / t.t11, -(t.t12 / (t.t11 * t.t22)),
                                    (t.t12 * t.t23 - t.t13 * t.t22) / (t.t11 * t.t22 * t.t33)};
  const std::array<Scalar, 3> c{zero, one / t.t22, (one - t.t23 / t.t22) / t.t33};
  SteadyDirections<Scalar> d;
  d.a11 = sqrt(square(alpha[0]) + square(alpha[1]) + square(alpha[2]));
  const std::array<Scalar, 3> u1{alpha[0] / d.a11, alpha[1] / d.a11, alpha[2] / d.a11};
  d.a21 = c[1] * u1[1] + c[2] * u1[2];
  const std::array<Scalar, 3> rest{-(d.a21 * u1[0]), c[1] - d.a21 * u1[1], c[2] - d.a21 * u1[2]};
  d.a22 = sqrt(square(rest[0]) + square(rest[1]) + square(rest[2]));
  d.m1 = u1[2] / t.t33;
  d.m2 = rest[2] / (d.a22 * t.t33);
  d.m3 = (u1[0] * rest[1] - u1[1] * rest[0]) / (d.a22 * t.t33);
  return d;
}

/// The data common to all steps of a set.
template <typename Scalar>
struct SteadySetting {
  trackers::ToneModel<Scalar> design;
  SteadyState<Scalar> steady;
  TriangularMetric<Scalar> metric;
  CovarianceBand<Scalar> band;
  SteadyDirections<Scalar> directions;
  // Functions of the steady state: sines and cosines of psi* and of nu*.
  Scalar sine_phase, cosine_phase, sine_turn, cosine_turn;
};

namespace detail {

template <typename To>
struct ScalarOf;
template <>
struct ScalarOf<double> {
  static double of(const rigor::Interval& x) { return midpoint(x); }
};
template <>
struct ScalarOf<rigor::Interval> {
  static rigor::Interval of(const rigor::Interval& x) { return x; }
};
template <int N>
struct ScalarOf<rigor::Secant<N>> {
  static rigor::Secant<N> of(const rigor::Interval& x) { return rigor::Secant<N>(x); }
};

}  // namespace detail

/// A symmetric matrix over another scalar: the midpoints over double.
template <typename To>
[[nodiscard]] Symmetric<To> convert(const Symmetric<rigor::Interval>& p) {
  using Scalar = detail::ScalarOf<To>;
  return {Scalar::of(p.p11), Scalar::of(p.p12), Scalar::of(p.p13),
          Scalar::of(p.p22), Scalar::of(p.p23), Scalar::of(p.p33)};
}

/// A setting over another scalar: the midpoints over double, constants over secants.
template <typename To>
[[nodiscard]] SteadySetting<To> convert(const SteadySetting<rigor::Interval>& s) {
  using Scalar = detail::ScalarOf<To>;
  return {{Scalar::of(s.design.q1), Scalar::of(s.design.q2), Scalar::of(s.design.r),
           Scalar::of(s.design.epsilon)},
          {Scalar::of(s.steady.rho), Scalar::of(s.steady.phase), Scalar::of(s.steady.frequency),
           convert<To>(s.steady.covariance)},
          {Scalar::of(s.metric.t11), Scalar::of(s.metric.t12), Scalar::of(s.metric.t13),
           Scalar::of(s.metric.t22), Scalar::of(s.metric.t23), Scalar::of(s.metric.t33)},
          {convert<To>(s.band.below), convert<To>(s.band.above)},
          {Scalar::of(s.directions.a11), Scalar::of(s.directions.a21), Scalar::of(s.directions.a22),
           Scalar::of(s.directions.m1), Scalar::of(s.directions.m2), Scalar::of(s.directions.m3)},
          Scalar::of(s.sine_phase),
          Scalar::of(s.cosine_phase),
          Scalar::of(s.sine_turn),
          Scalar::of(s.cosine_turn)};
}

/// Fills the sines and cosines of the steady state.
template <typename Scalar>
void fill_turns(SteadySetting<Scalar>& setting) {
  using trackers::detail::sin_cos;
  const auto phase = sin_cos(setting.steady.phase);
  const auto turn = sin_cos(setting.steady.frequency);
  setting.sine_phase = phase.first;
  setting.cosine_phase = phase.second;
  setting.sine_turn = turn.first;
  setting.cosine_turn = turn.second;
}

}  // namespace veritrack::quadrature
