// What the steps of a set around the steady state have in common, over different scalars.
#pragma once

#include "analysis/quadrature/leak/steady_gain.hpp"
#include "analysis/rigor/secant.hpp"

namespace veritrack::quadrature {

/// T = [[t11, t12, t13], [0, t22, t23], [0, 0, t33]], scaled such that level 1 is |T b| <= 1.
template <typename Scalar>
struct TriangularMetric {
  Scalar t11, t12, t13, t22, t23, t33;
};

/// What the steps of a whole set have in common.
template <typename Scalar>
struct SteadySetting {
  trackers::ToneModel<Scalar> design;
  SteadyState<Scalar> steady;
  TriangularMetric<Scalar> metric;
  CovarianceBand<Scalar> band;
  /// |T b| <= 1 implies alpha = a11 x, c = a21 x + a22 y with x^2 + y^2 <= 1.
  Scalar a11, a21, a22;
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
          Scalar::of(s.a11),
          Scalar::of(s.a21),
          Scalar::of(s.a22),
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
