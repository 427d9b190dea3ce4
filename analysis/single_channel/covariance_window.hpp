// Bounds on the covariance of the single-channel tracker from a window of its past, in the frame of the true
// phase.
//
// One step maps P to update(U(nu) F(z) P F(z)' U(nu)' + Q), F(z) = [[I, J z], [0, 1]], by the measurement in
// the direction (cos phi, -sin phi) of the new phase. For estimates near the true signal, z near 1 and nu
// near 0, U F differs little from F = F(1). The step is monotone in the Loewner order, so that bounds on an
// old covariance become, run through a window of phases, bounds on the new one that hardly depend on the old
// one. docs/single-channel.md, section 4.
//
// The template runs on double, to propose, and on Taylor models in (phase, frequency), for bounds that hold
// over a cell of both.
#pragma once

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/taylor_model.hpp"
#include "analysis/single_channel/step_rounding.hpp"
#include "trackers/scalar_functions.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::single_channel {

/// A symmetric 3 x 3 matrix: covariance in the frame of the true phase, relative to the amplitude.
template <typename Scalar>
struct PhaseCovariance {
  Scalar p11, p12, p13, p22, p23, p33;
};

/// a + factor b.
template <typename Scalar>
[[nodiscard]] PhaseCovariance<Scalar> combined(const PhaseCovariance<Scalar>& a, const Scalar& factor,
                                               const PhaseCovariance<Scalar>& b) {
  return {a.p11 + factor * b.p11, a.p12 + factor * b.p12, a.p13 + factor * b.p13,
          a.p22 + factor * b.p22, a.p23 + factor * b.p23, a.p33 + factor * b.p33};
}

/// factor p.
template <typename Scalar>
[[nodiscard]] PhaseCovariance<Scalar> scaled(const Scalar& factor, const PhaseCovariance<Scalar>& p) {
  return {factor * p.p11, factor * p.p12, factor * p.p13, factor * p.p22, factor * p.p23, factor * p.p33};
}

/// diag(signal, signal, frequency).
template <typename Scalar>
[[nodiscard]] PhaseCovariance<Scalar> diagonal(const Scalar& signal, const Scalar& frequency) {
  return {signal, Scalar(0.0), Scalar(0.0), signal, Scalar(0.0), frequency};
}

/// keep F P F' + Q + added diag(1, 1, 0).
template <typename Scalar>
[[nodiscard]] PhaseCovariance<Scalar> predicted(const PhaseCovariance<Scalar>& p, const Scalar& keep,
                                                const Scalar& added,
                                                const trackers::ToneModel<Scalar>& design) {
  const Scalar p23 = p.p23 + p.p33;
  return {keep * p.p11 + design.q1 + added,
          keep * (p.p12 + p.p13),
          keep * p.p13,
          keep * (p.p22 + p.p23 + p23) + design.q1 + added,
          keep * p23,
          keep * p.p33 + design.q2};
}

/// The measurement update in the direction (cos phase, -sin phase); the caller sees to it that the innovation
/// variance is positive.
template <typename Scalar>
[[nodiscard]] PhaseCovariance<Scalar> updated(const PhaseCovariance<Scalar>& p, const Scalar& phase,
                                              const Scalar& r) {
  using trackers::detail::sin_cos;
  using trackers::detail::square;
  const auto [sine, cosine] = sin_cos(phase);
  const Scalar b1 = p.p11 * cosine - p.p12 * sine;
  const Scalar b2 = p.p12 * cosine - p.p22 * sine;
  const Scalar b3 = p.p13 * cosine - p.p23 * sine;
  const Scalar reciprocal = Scalar(1.0) / (b1 * cosine - b2 * sine + r);
  const Scalar c1 = b1 * reciprocal;
  const Scalar c2 = b2 * reciprocal;
  return {p.p11 - b1 * c1, p.p12 - b2 * c1, p.p13 - b3 * c1,
          p.p22 - b2 * c2, p.p23 - b3 * c2, p.p33 - square(b3) * reciprocal};
}

/// What is supposed of the estimates, at every sample: e' P^-1 e <= radius^2 for the error e = (delta, nu) in
/// the frame of the true phase, P33 <= frequency_variance, and P <= signal_variance on the first two
/// components. All are exact doubles, positive and finite.
struct WindowAssumption {
  double radius = 0.0;
  double frequency_variance = 0.0;  ///< (rad/sample)^2
  double signal_variance = 0.0;     ///< relative to the amplitude, squared
  double loosening = 0.0;  ///< eta in (0, 1): (F + E) P (F + E)' <= (1 + eta) F P F' + (1 + 1/eta) E P E'
  /// What the program's step adds to the exact one; zero for a tracker in real arithmetic.
  StepRounding rounding = {};
};

/// A bound t with E P E' <= t diag(1, 1, 0), E = U(nu) F(z) - F, for every covariance P that is at most
/// `bound` and satisfies the assumption. |E x| <= |nu| |x_z| + (|delta| + |nu|) |x_3|. Needs the upward mode.
[[nodiscard]] rigor::Interval disturbance(const WindowAssumption& assumption,
                                          const PhaseCovariance<rigor::Interval>& bound);

/// How long the windows are, and how fast the frequency changes in them.
struct WindowLength {
  int settling = 0;   ///< samples before the lower bound starts, from 0
  int window = 0;     ///< samples after that
  double slew = 0.0;  ///< |omega(k+1) - omega(k)|, rad/sample
};

namespace detail {

/// Functions of (phase, frequency) over a cell.
using OverPhaseAndFrequency = rigor::TaylorModel<2, 4>;

inline rigor::Interval range_of(double x) {
  return rigor::Interval(x);
}
inline rigor::Interval range_of(const OverPhaseAndFrequency& x) {
  return x.range();
}

template <typename Scalar>
[[nodiscard]] PhaseCovariance<rigor::Interval> ranges_of(const PhaseCovariance<Scalar>& p) {
  return {range_of(p.p11), range_of(p.p12), range_of(p.p13),
          range_of(p.p22), range_of(p.p23), range_of(p.p33)};
}

/// How far the phase may be off so many samples after (before, when negative) one where it and the frequency
/// are known, when the frequency changes by at most `slew` a sample. Needs the upward mode.
[[nodiscard]] double phase_drift(int samples, double slew);

/// Matrices without remainder, all of them at least (sign = 1) or at most (sign = -1) those in `p`: a
/// symmetric matrix whose entries are at most those of `remainders` lies between -D and D, D the diagonal of
/// the sums of rows. So remainders do not grow from step to step as interval arithmetic would have it, but
/// decay with the covariance. Nothing is known where a remainder is not.
[[nodiscard]] PhaseCovariance<OverPhaseAndFrequency> without_remainder(
    const PhaseCovariance<OverPhaseAndFrequency>& p, double sign, double drift);
/// For a proposal: about as much more or less as the verification will need.
[[nodiscard]] PhaseCovariance<double> without_remainder(const PhaseCovariance<double>& p, double sign,
                                                        double drift);

/// The phase so many samples after `phase` (before it, when negative), when the frequency is `frequency`
/// there, up to the drift.
[[nodiscard]] OverPhaseAndFrequency advanced(const OverPhaseAndFrequency& phase,
                                             const OverPhaseAndFrequency& frequency, int samples,
                                             double drift);
inline double advanced(double phase, double frequency, int samples, double /*drift*/) {
  return phase + samples * frequency;
}

}  // namespace detail

/// Calls visit(m, upper, lower, predicted_lower) for m = 1, ..., window: bounds lower <= P <= upper on every
/// covariance m samples after that of phase `phase` and frequency `frequency`; `lower` bounds what these m
/// samples make of any covariance, from zero on; predicted_lower bounds the prediction from `lower` on. Stops
/// when visit returns false. Needs the upward mode.
template <typename Scalar, typename Visit>
void follow_window(const trackers::ToneModel<Scalar>& design, const WindowAssumption& assumption,
                   const WindowLength& length, const Scalar& phase, const Scalar& frequency,
                   const Visit& visit) {
  using rigor::Interval;
  const Interval eta(assumption.loosening);
  const Interval one(1.0);
  const Scalar more = Scalar(1.0) + Scalar(assumption.loosening);
  const Scalar less = Scalar(1.0) - Scalar(assumption.loosening);
  const Interval rounding(assumption.rounding.covariance);
  const Scalar rounded_up((one + rounding).upper());
  const Scalar rounded_down((one - rounding).lower());
  const auto above = [&](const PhaseCovariance<Scalar>& p) {
    const Interval added = (one + one / eta) * disturbance(assumption, detail::ranges_of(p));
    return predicted(p, more, Scalar(added.upper()), design);
  };
  const auto beneath = [&](const PhaseCovariance<Scalar>& p) {
    const Interval removed = (one / eta - one) * disturbance(assumption, detail::ranges_of(p));
    return predicted(p, less, Scalar(-removed.upper()), design);
  };
  // [[A, x], [x', c]] <= 2 diag(A, c).
  PhaseCovariance<Scalar> upper =
      diagonal(Scalar(2.0 * assumption.signal_variance), Scalar(2.0 * assumption.frequency_variance));
  PhaseCovariance<Scalar> lower = diagonal(Scalar(0.0), Scalar(0.0));
  PhaseCovariance<Scalar> predicted_lower = beneath(lower);
  for (int step = 1; step <= length.settling + length.window; ++step) {
    const int samples = step - length.settling;
    const double drift = detail::phase_drift(samples, length.slew);
    const Scalar here = detail::advanced(phase, frequency, samples, drift);
    upper = detail::without_remainder(scaled(rounded_up, updated(above(upper), here, design.r)), 1.0, drift);
    if (step <= length.settling) {
      continue;
    }
    lower = detail::without_remainder(scaled(rounded_down, updated(predicted_lower, here, design.r)), -1.0,
                                      drift);
    predicted_lower = beneath(lower);
    if (!visit(step - length.settling, upper, lower, predicted_lower)) {
      return;
    }
  }
}

}  // namespace veritrack::single_channel
