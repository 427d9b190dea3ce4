// The four extended Kalman filters of a noisy sine wave that P. Zarchan's slides "Tracking a Sine Wave"
// compare.
//
//   SinePhaseEkf               (phi, omega, A): y = A sin phi + noise, phi' = omega
//   SineKnownAmplitudeEkf      (phi, omega), A known
//   OscillatorEkf              (x, v, omega): y = x + noise, x'' = -omega^2 x
//   SquaredFrequencyEkf        (x, v, z): the same with z = omega^2
//
// All predict the covariance with the two-term fundamental matrix I + F TS, with the process noise integrated
// over a sample, and update it with one scalar measurement. The first two predict the state with that matrix
// too, which is exact. The others predict it by `euler_steps` semi-implicit Euler steps of x'' (100 of 0.001
// s in the slides), and evaluate their matrices at the filtered state.
//
// Symmetries, which a test checks as identities: OscillatorEkf with the sign of omega reversed does the same
// with the sign of omega reversed, and started at omega = 0 it stays there, so that it never estimates a
// sign. SinePhaseEkf is the same at (-phi, -omega, -A), and at (phi + pi, omega, -A). -y gives -x, -v.
//
// What the slides print differently: TS = 1 in the first two listings is 0.1; Q(1,2) of the second listing
// has a minus sign, against its derivation (without effect, since PHIS = 0); Q(2,2) of the fourth listing has
// TS^2 for TS^3 (without effect, too); H of the second listing lacks the factor A = 1.
//
// Templates over the scalar; a step does not allocate. Assumed, not checked: measurement variance > 0, P(0)
// symmetric and positive semidefinite, all finite.
#pragma once

#include <Eigen/Core>

#include "trackers/scalar_functions.hpp"

namespace veritrack::trackers {

/// The inputs of all four. Units: of the signal, s, rad/s.
template <typename Scalar>
struct ZarchanDesign {
  Scalar interval;              ///< TS, s; > 0
  Scalar measurement_variance;  ///< sigma^2, signal units squared; > 0
  Scalar frequency_noise;       ///< spectral density of the last state's noise (that of omega, or of z); >= 0
  Scalar amplitude_noise;  ///< PHIS2, spectral density of the amplitude's noise; only for SinePhaseEkf; >= 0
  int euler_steps = 100;   ///< steps of the state's prediction in a sample, for the last two; >= 1
};

/// Filtered state and covariance.
template <typename Scalar, int Size>
struct ZarchanEstimate {
  Eigen::Matrix<Scalar, Size, 1> state;
  Eigen::Matrix<Scalar, Size, Size> covariance;
};

namespace detail {

/// F P F', symmetric to the last bit when P is.
template <typename Scalar, int Size>
[[nodiscard]] inline Eigen::Matrix<Scalar, Size, Size> propagated(
    const Eigen::Matrix<Scalar, Size, Size>& f, const Eigen::Matrix<Scalar, Size, Size>& p) {
  const Eigen::Matrix<Scalar, Size, Size> fp = f * p;
  Eigen::Matrix<Scalar, Size, Size> result;
  for (int i = 0; i < Size; ++i) {
    for (int j = i; j < Size; ++j) {
      Scalar sum(0.0);
      for (int k = 0; k < Size; ++k) {
        sum = sum + fp(i, k) * f(j, k);
      }
      result(i, j) = sum;
      result(j, i) = sum;
    }
  }
  return result;
}

/// The update of a predicted estimate with one number: P(k|k) = M - (M h)(M h)' / s, s = h'M h + r.
template <typename Scalar, int Size>
inline void scalar_update(ZarchanEstimate<Scalar, Size>& estimate, const Eigen::Matrix<Scalar, Size, 1>& h,
                          const Scalar& innovation, const Scalar& r) {
  const Eigen::Matrix<Scalar, Size, 1> mh = estimate.covariance * h;
  Scalar s = r;
  for (int i = 0; i < Size; ++i) {
    s = s + h(i) * mh(i);
  }
  for (int i = 0; i < Size; ++i) {
    const Scalar gain = mh(i) / s;
    estimate.state(i) = estimate.state(i) + gain * innovation;
    for (int j = i; j < Size; ++j) {
      estimate.covariance(i, j) = estimate.covariance(i, j) - gain * mh(j);
      estimate.covariance(j, i) = estimate.covariance(i, j);
    }
  }
}

/// Zero.
template <typename Scalar, int Size>
[[nodiscard]] inline Eigen::Matrix<Scalar, Size, Size> zero_matrix() {
  Eigen::Matrix<Scalar, Size, Size> result;
  result.fill(Scalar(0.0));
  return result;
}

/// The process noise of (phi, omega) over one sample, PHIS (TS^3/3, TS^2/2; TS^2/2, TS), in the upper left
/// corner.
template <typename Scalar, int Size>
inline void add_phase_noise(Eigen::Matrix<Scalar, Size, Size>& m, const ZarchanDesign<Scalar>& design) {
  const Scalar& ts = design.interval;
  const Scalar corner = Scalar(0.5) * (ts * ts) * design.frequency_noise;
  m(0, 0) = m(0, 0) + ts * ts * ts / Scalar(3.0) * design.frequency_noise;
  m(0, 1) = m(0, 1) + corner;
  m(1, 0) = m(0, 1);
  m(1, 1) = m(1, 1) + ts * design.frequency_noise;
}

/// One sample of x'' = -z x: semi-implicit Euler, v first, as the slides' PROJECT.
template <typename Scalar>
inline void project(Scalar& x, Scalar& v, const Scalar& z, const ZarchanDesign<Scalar>& design) {
  const Scalar h = design.interval / Scalar(static_cast<double>(design.euler_steps));
  for (int i = 0; i < design.euler_steps; ++i) {
    v = v - h * (z * x);
    x = x + h * v;
  }
}

/// One step of the two filters with the state (x, v, w), whose model is x'' = -z x with z and its derivative
/// by w.
template <typename Scalar>
inline void oscillator_step(ZarchanEstimate<Scalar, 3>& estimate, const Scalar& z, const Scalar& slope,
                            const Scalar& measurement, const ZarchanDesign<Scalar>& design) {
  const Scalar& ts = design.interval;
  const Scalar coupling = -(slope * estimate.state(0));  // of v' with w
  Eigen::Matrix<Scalar, 3, 3> f = zero_matrix<Scalar, 3>();
  f(0, 0) = Scalar(1.0);
  f(0, 1) = ts;
  f(1, 0) = -(z * ts);
  f(1, 1) = Scalar(1.0);
  f(1, 2) = coupling * ts;
  f(2, 2) = Scalar(1.0);
  Eigen::Matrix<Scalar, 3, 3> m = propagated<Scalar, 3>(f, estimate.covariance);
  m(1, 1) = m(1, 1) + coupling * coupling * (ts * ts * ts / Scalar(3.0) * design.frequency_noise);
  m(1, 2) = m(1, 2) + coupling * (Scalar(0.5) * (ts * ts) * design.frequency_noise);
  m(2, 1) = m(1, 2);
  m(2, 2) = m(2, 2) + ts * design.frequency_noise;
  estimate.covariance = m;
  project(estimate.state(0), estimate.state(1), z, design);
  Eigen::Matrix<Scalar, 3, 1> h;
  h.fill(Scalar(0.0));
  h(0) = Scalar(1.0);
  const Scalar innovation = measurement - estimate.state(0);
  scalar_update<Scalar, 3>(estimate, h, innovation, design.measurement_variance);
}

}  // namespace detail

/// State (phi in rad, omega in rad/s, A in signal units).
template <typename Scalar = double>
class SinePhaseEkf {
 public:
  SinePhaseEkf(const ZarchanDesign<Scalar>& design, const ZarchanEstimate<Scalar, 3>& start)
      : design_(design), estimate_(start) {}

  /// One sample: prediction, then the measurement, signal units.
  void step(const Scalar& measurement) {
    using detail::sin_cos;
    Eigen::Matrix<Scalar, 3, 3> f = detail::zero_matrix<Scalar, 3>();
    f(0, 0) = Scalar(1.0);
    f(0, 1) = design_.interval;
    f(1, 1) = Scalar(1.0);
    f(2, 2) = Scalar(1.0);
    estimate_.covariance = detail::propagated<Scalar, 3>(f, estimate_.covariance);
    detail::add_phase_noise(estimate_.covariance, design_);
    estimate_.covariance(2, 2) = estimate_.covariance(2, 2) + design_.interval * design_.amplitude_noise;
    estimate_.state(0) = estimate_.state(0) + design_.interval * estimate_.state(1);
    const auto [sine, cosine] = sin_cos(estimate_.state(0));
    Eigen::Matrix<Scalar, 3, 1> h;
    h(0) = estimate_.state(2) * cosine;
    h(1) = Scalar(0.0);
    h(2) = sine;
    const Scalar innovation = measurement - estimate_.state(2) * sine;
    detail::scalar_update<Scalar, 3>(estimate_, h, innovation, design_.measurement_variance);
  }

  [[nodiscard]] const ZarchanEstimate<Scalar, 3>& filtered() const { return estimate_; }

 private:
  ZarchanDesign<Scalar> design_;
  ZarchanEstimate<Scalar, 3> estimate_;
};

/// State (phi in rad, omega in rad/s); the amplitude is known.
template <typename Scalar = double>
class SineKnownAmplitudeEkf {
 public:
  /// `amplitude` in signal units.
  SineKnownAmplitudeEkf(const ZarchanDesign<Scalar>& design, const Scalar& amplitude,
                        const ZarchanEstimate<Scalar, 2>& start)
      : design_(design), amplitude_(amplitude), estimate_(start) {}

  /// One sample: prediction, then the measurement, signal units.
  void step(const Scalar& measurement) {
    using detail::sin_cos;
    Eigen::Matrix<Scalar, 2, 2> f;
    f(0, 0) = Scalar(1.0);
    f(0, 1) = design_.interval;
    f(1, 0) = Scalar(0.0);
    f(1, 1) = Scalar(1.0);
    estimate_.covariance = detail::propagated<Scalar, 2>(f, estimate_.covariance);
    detail::add_phase_noise(estimate_.covariance, design_);
    estimate_.state(0) = estimate_.state(0) + design_.interval * estimate_.state(1);
    const auto [sine, cosine] = sin_cos(estimate_.state(0));
    Eigen::Matrix<Scalar, 2, 1> h;
    h(0) = amplitude_ * cosine;
    h(1) = Scalar(0.0);
    const Scalar innovation = measurement - amplitude_ * sine;
    detail::scalar_update<Scalar, 2>(estimate_, h, innovation, design_.measurement_variance);
  }

  [[nodiscard]] const ZarchanEstimate<Scalar, 2>& filtered() const { return estimate_; }

 private:
  ZarchanDesign<Scalar> design_;
  Scalar amplitude_;
  ZarchanEstimate<Scalar, 2> estimate_;
};

/// State (x in signal units, its derivative per s, omega in rad/s).
template <typename Scalar = double>
class OscillatorEkf {
 public:
  OscillatorEkf(const ZarchanDesign<Scalar>& design, const ZarchanEstimate<Scalar, 3>& start)
      : design_(design), estimate_(start) {}

  /// One sample: prediction, then the measurement, signal units.
  void step(const Scalar& measurement) {
    const Scalar omega = estimate_.state(2);
    detail::oscillator_step<Scalar>(estimate_, omega * omega, omega + omega, measurement, design_);
  }

  [[nodiscard]] const ZarchanEstimate<Scalar, 3>& filtered() const { return estimate_; }

 private:
  ZarchanDesign<Scalar> design_;
  ZarchanEstimate<Scalar, 3> estimate_;
};

/// State (x in signal units, its derivative per s, z = omega^2 in (rad/s)^2).
template <typename Scalar = double>
class SquaredFrequencyEkf {
 public:
  SquaredFrequencyEkf(const ZarchanDesign<Scalar>& design, const ZarchanEstimate<Scalar, 3>& start)
      : design_(design), estimate_(start) {}

  /// One sample: prediction, then the measurement, signal units.
  void step(const Scalar& measurement) {
    const Scalar z = estimate_.state(2);
    detail::oscillator_step<Scalar>(estimate_, z, Scalar(1.0), measurement, design_);
  }

  [[nodiscard]] const ZarchanEstimate<Scalar, 3>& filtered() const { return estimate_; }

 private:
  ZarchanDesign<Scalar> design_;
  ZarchanEstimate<Scalar, 3> estimate_;
};

}  // namespace veritrack::trackers
