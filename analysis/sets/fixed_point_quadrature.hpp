// The quadrature tracker as a closed loop of fixed_point.hpp, in the rotating frame and in the polar frame;
// the parameter is the signal's frequency omega, rad/sample.
#pragma once

#include "analysis/rigor/dual.hpp"
#include "analysis/sets/fixed_point.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"

namespace veritrack::sets {

namespace detail {

/// A design value as a constant of the scalar in use: its midpoint in double, the interval otherwise.
template <typename Scalar>
struct Embedding;
template <>
struct Embedding<double> {
  static double of(const rigor::Interval& value) { return midpoint(value); }
};
template <>
struct Embedding<rigor::Interval> {
  static rigor::Interval of(const rigor::Interval& value) { return value; }
};
template <typename Scalar, int N>
struct Embedding<rigor::Dual<Scalar, N>> {
  static rigor::Dual<Scalar, N> of(const rigor::Interval& value) {
    return rigor::Dual<Scalar, N>(Embedding<Scalar>::of(value));
  }
};

template <typename Scalar>
[[nodiscard]] trackers::ToneModel<Scalar> embed(const trackers::ToneModel<rigor::Interval>& design) {
  return {Embedding<Scalar>::of(design.q1), Embedding<Scalar>::of(design.q2), Embedding<Scalar>::of(design.r),
          Embedding<Scalar>::of(design.epsilon)};
}

}  // namespace detail

/// X+ = G(X; v', w, omega) of trackers/quadrature/quadrature_rotating_frame.hpp for a signal of amplitude 1:
/// nine states, the noise v' in the plane, and the slew w of the frequency.
struct QuadratureRotatingLoop {
  static constexpr int kStates = 9;
  static constexpr int kNoises = 2;

  trackers::ToneModel<rigor::Interval> design;

  template <typename Scalar>
  [[nodiscard]] Column<Scalar, kStates> operator()(const Column<Scalar, kStates>& state,
                                                   const Scalar& frequency,
                                                   const Column<Scalar, kNoises + 1>& disturbance) const {
    return trackers::rotating_frame_map<Scalar>(
        state, {disturbance[0], disturbance[1], disturbance[2], frequency}, detail::embed<Scalar>(design));
  }
};

/// The same closed loop in the polar frame of trackers/quadrature/quadrature_polar_frame.hpp: the state is
/// (a, psi, nu, P11, P12, P13, P22, P23, P33), and the noise is turned into the frame of the predicted phase.
struct QuadraturePolarLoop {
  static constexpr int kStates = 9;
  static constexpr int kNoises = 2;

  trackers::ToneModel<rigor::Interval> design;

  template <typename Scalar>
  [[nodiscard]] Column<Scalar, kStates> operator()(const Column<Scalar, kStates>& state,
                                                   const Scalar& frequency,
                                                   const Column<Scalar, kNoises + 1>& disturbance) const {
    const trackers::PolarFrameState<Scalar> next = trackers::polar_frame_map<Scalar>(
        {{state[0], state[1], state[2]}, {state[3], state[4], state[5], state[6], state[7], state[8]}},
        {disturbance[0], disturbance[1], disturbance[2], frequency}, detail::embed<Scalar>(design));
    Column<Scalar, kStates> result;
    result[0] = next.error.amplitude;
    result[1] = next.error.phase;
    result[2] = next.error.frequency;
    result[3] = next.covariance.p11;
    result[4] = next.covariance.p12;
    result[5] = next.covariance.p13;
    result[6] = next.covariance.p22;
    result[7] = next.covariance.p23;
    result[8] = next.covariance.p33;
    return result;
  }
};

/// The covariance while the estimate is exact: the six entries of P, with no error at the frequency 0, where
/// exactness lasts (the innovation is zero). `Loop` is one of the two above.
template <typename Loop>
struct LockedCovarianceLoop {
  static constexpr int kStates = 6;
  static constexpr int kNoises = 0;

  Loop loop;

  /// X with no error and this covariance.
  template <typename Scalar>
  [[nodiscard]] static Column<Scalar, Loop::kStates> without_error(
      const Column<Scalar, kStates>& covariance) {
    Column<Scalar, Loop::kStates> state;
    for (int i = 0; i < 3; ++i) {
      state[i] = Scalar(0.0);
    }
    for (int i = 0; i < kStates; ++i) {
      state[3 + i] = covariance[i];
    }
    return state;
  }

  template <typename Scalar>
  [[nodiscard]] Column<Scalar, kStates> operator()(const Column<Scalar, kStates>& covariance,
                                                   const Scalar& /*parameter*/,
                                                   const Column<Scalar, 1>& /*disturbance*/) const {
    const Column<Scalar, 3> quiet = Column<Scalar, 3>::Constant(Scalar(0.0));
    const Column<Scalar, Loop::kStates> image = loop(without_error(covariance), Scalar(0.0), quiet);
    Column<Scalar, kStates> next;
    for (int i = 0; i < kStates; ++i) {
      next[i] = image[3 + i];
    }
    return next;
  }
};

}  // namespace veritrack::sets
