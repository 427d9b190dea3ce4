// Bounds on the covariance of the single-channel tracker from a window of its past, in the frame of the true
// phase.
//
// One step maps P to update(U(nu) F(z) P F(z)' U(nu)' + Q), F(z) = [[I, J z], [0, 1]], by the measurement in
// the direction (cos phi, -sin phi) of the new phase. For estimates near the true signal, z near 1 and nu
// near 0, U F differs little from F = F(1). The step is monotone in the Loewner order, so that bounds on an
// old covariance become, run through a window of phases, bounds on the new one that hardly depend on the old
// one. docs/single-channel.md, section 4.
//
// The template runs on double, to propose, and on Taylor models in (phase, frequency), one or several side by
// side, for bounds that hold over a cell of both.
#pragma once

#include <cmath>
#include <utility>

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

/// The measurement update in the direction (cosine, -sine) of the phase; the caller sees to it that the
/// innovation variance is positive.
template <typename Scalar>
[[nodiscard]] PhaseCovariance<Scalar> updated(const PhaseCovariance<Scalar>& p, const Scalar& sine,
                                              const Scalar& cosine, const Scalar& r) {
  using trackers::detail::square;
  const Scalar b1 = p.p11 * cosine - p.p12 * sine;
  const Scalar b2 = p.p12 * cosine - p.p22 * sine;
  const Scalar b3 = p.p13 * cosine - p.p23 * sine;
  const Scalar reciprocal = Scalar(1.0) / (b1 * cosine - b2 * sine + r);
  const Scalar c1 = b1 * reciprocal;
  const Scalar c2 = b2 * reciprocal;
  return {p.p11 - b1 * c1, p.p12 - b2 * c1, p.p13 - b3 * c1,
          p.p22 - b2 * c2, p.p23 - b3 * c2, p.p33 - square(b3) * reciprocal};
}

/// The assumption on the estimates, at every sample: e' P^-1 e <= radius^2 for the error e = (delta, nu) in
/// the frame of the true phase, P33 <= frequency_variance, and P <= signal_variance on the first two
/// components. All are exact doubles, positive and finite.
struct WindowAssumption {
  double radius = 0.0;
  double frequency_variance = 0.0;  ///< (rad/sample)^2
  double signal_variance = 0.0;     ///< relative to the amplitude, squared
  double loosening = 0.0;  ///< eta in (0, 1): (F + E) P (F + E)' <= (1 + eta) F P F' + (1 + 1/eta) E P E'
  /// Rounding of the program's step; zero for a tracker in real arithmetic.
  StepRounding rounding = {};
};

/// How long the windows are, and how fast the frequency changes in them.
struct WindowLength {
  int settling = 0;   ///< samples before the lower bound starts, from 0
  int window = 0;     ///< samples after that
  double slew = 0.0;  ///< |omega(k+1) - omega(k)|, rad/sample
};

namespace detail {

/// Functions of (phase, frequency) over a cell.
using OverPhaseAndFrequency = rigor::TaylorModel<2, 4>;

template <typename Scalar>
struct WindowScalar;

/// Matrices without remainder, all of them at least (sign = 1) or at most (sign = -1) those in `p`: a
/// symmetric matrix whose entries are at most those of `remainders` lies between -D and D, D the diagonal of
/// the sums of rows. So remainders do not grow from step to step as interval arithmetic would have it, but
/// decay with the covariance. Nothing is known where a remainder is not.
template <typename Model>
[[nodiscard]] PhaseCovariance<Model> remainder_on_diagonal(const PhaseCovariance<Model>& p, double sign) {
  using Of = WindowScalar<Model>;
  const auto cleared = [&](const Model& entry, const Model& a, const Model& b, const Model& c) {
    const Model row = Of::upper_end(Of::remainder(a) + Of::remainder(b) + Of::remainder(c));
    return entry.polynomial() + (sign > 0.0 ? row : -row);
  };
  return {cleared(p.p11, p.p11, p.p12, p.p13), p.p12.polynomial(), p.p13.polynomial(),
          cleared(p.p22, p.p12, p.p22, p.p23), p.p23.polynomial(), cleared(p.p33, p.p13, p.p23, p.p33)};
}

/// About the share of the variances that the verification will need when the phase is off by `drift`.
[[nodiscard]] inline double proposed_remainder(double drift) {
  constexpr double kTruncation = 4e-4;
  constexpr double kPerRadian = 4.0;
  return kTruncation + kPerRadian * drift;
}
/// For a proposal: about as much more or less as the verification will need.
template <typename Number>
[[nodiscard]] PhaseCovariance<Number> proposed_without_remainder(const PhaseCovariance<Number>& p,
                                                                 const Number& share) {
  using std::abs;
  const Number a12 = abs(p.p12);
  const Number a13 = abs(p.p13);
  const Number a23 = abs(p.p23);
  return {p.p11 + share * (p.p11 + a12 + a13), p.p12, p.p13,
          p.p22 + share * (p.p22 + a12 + a23), p.p23, p.p33 + share * (p.p33 + a13 + a23)};
}

/// Functions that follow_window needs of its scalar beyond + - * /: a range, of which `kept_within` is the
/// part in [0, limit], or the limit where nothing is known; a scalar from the upper end of a range; and of
/// Taylor models the remainder, as a range. Those of several lanes are in window_cell_lanes.hpp and
/// window_grid_lanes.hpp.
template <typename Scalar>
struct WindowScalar {};

template <>
struct WindowScalar<double> {
  using Range = double;
  static double range(double x) { return x; }
  static double kept_within(double value, double limit) {
    return value > 0.0 ? (value < limit ? value : limit) : 0.0;
  }
  static double upper_end(double range) { return range; }
  static PhaseCovariance<double> without_remainder(const PhaseCovariance<double>& p, double sign,
                                                   double drift) {
    return proposed_without_remainder(p, sign * proposed_remainder(drift));
  }
};

template <>
struct WindowScalar<OverPhaseAndFrequency> {
  using Range = rigor::Interval;
  static Range range(const OverPhaseAndFrequency& x) { return x.range(); }
  static Range kept_within(const Range& value, const Range& limit) {
    return is_finite(value) ? min(max(value, Range(0.0)), limit) : limit;
  }
  static OverPhaseAndFrequency upper_end(const Range& range) { return OverPhaseAndFrequency(range.upper()); }
  static Range remainder(const OverPhaseAndFrequency& x) { return Range(x.remainder()); }
  static PhaseCovariance<OverPhaseAndFrequency> without_remainder(
      const PhaseCovariance<OverPhaseAndFrequency>& p, double sign, double /*drift*/) {
    return remainder_on_diagonal(p, sign);
  }
};

/// How far the phase may be off this many samples after (before, when negative) one where it and the
/// frequency are known, when the frequency changes by at most `slew` a sample. Needs the upward mode.
[[nodiscard]] double phase_drift(int samples, double slew);

/// The phase this many samples after `phase` (before it, when negative), when the frequency is `frequency`
/// there, up to the drift.
template <typename Model>
[[nodiscard]] Model advanced(const Model& phase, const Model& frequency, int samples, double drift) {
  using Range = typename WindowScalar<Model>::Range;
  return phase + Model(static_cast<double>(samples)) * frequency + Model(Range::from_bounds(-drift, drift));
}
inline double advanced(double phase, double frequency, int samples, double /*drift*/) {
  return phase + samples * frequency;
}

}  // namespace detail

/// A bound t with E P E' <= t diag(1, 1, 0), E = U(nu) F(z) - F, for every covariance P that is at most
/// `bound` and satisfies the assumption. |E x| <= |nu| |x_z| + (|delta| + |nu|) |x_3|. Over intervals it
/// needs the upward mode.
template <typename Scalar, typename Range = typename detail::WindowScalar<Scalar>::Range>
[[nodiscard]] Range disturbance(const WindowAssumption& assumption, const PhaseCovariance<Range>& bound) {
  using Of = detail::WindowScalar<Scalar>;
  using std::sqrt;
  using trackers::detail::square;
  // The assumption on every covariance is also a bound, and the only one where the other is not finite.
  const Range signal_limit(assumption.signal_variance);
  const Range frequency_limit(assumption.frequency_variance);
  const Range half(0.5);
  const Range largest =
      half * (bound.p11 + bound.p22) + sqrt(square(half * (bound.p11 - bound.p22)) + square(bound.p12));
  const Range frequency = sqrt(frequency_limit);
  const Range signal = sqrt(signal_limit);
  return square(Range(assumption.radius) *
                (frequency * sqrt(Of::kept_within(largest, signal_limit)) +
                 (signal + frequency) * sqrt(Of::kept_within(bound.p33, frequency_limit))));
}

/// Calls visit(m, upper, lower, predicted_lower) for m = 1, ..., window: bounds lower <= P <= upper on every
/// covariance m samples after one of a phase and a frequency; `lower` bounds the covariance that these m
/// samples make of any covariance, from zero on; predicted_lower bounds the prediction from `lower` on.
/// `direction(samples, drift)` is (sine, cosine) of the phase this many samples after that, to within the
/// drift. Stops when visit returns false. Needs the upward mode.
template <typename Scalar, typename Direction, typename Visit>
void follow_window(const trackers::ToneModel<Scalar>& design, const WindowAssumption& assumption,
                   const WindowLength& length, const Direction& direction, const Visit& visit) {
  using rigor::Interval;
  using Of = detail::WindowScalar<Scalar>;
  using Range = typename Of::Range;
  const Range one(1.0);
  const Range eta(assumption.loosening);
  const Scalar more = Scalar(1.0) + Scalar(assumption.loosening);
  const Scalar less = Scalar(1.0) - Scalar(assumption.loosening);
  const Range more_disturbed = one + one / eta;
  const Range less_disturbed = one / eta - one;
  const Interval rounding(assumption.rounding.covariance);
  const Scalar rounded_up((Interval(1.0) + rounding).upper());
  const Scalar rounded_down((Interval(1.0) - rounding).lower());
  const auto disturbed = [&](const PhaseCovariance<Scalar>& p, const Range& factor) {
    const PhaseCovariance<Range> ranges{Of::range(p.p11), Of::range(p.p12), Of::range(p.p13),
                                        Of::range(p.p22), Of::range(p.p23), Of::range(p.p33)};
    return Of::upper_end(factor * disturbance<Scalar>(assumption, ranges));
  };
  const auto beneath = [&](const PhaseCovariance<Scalar>& p) {
    return predicted(p, less, -disturbed(p, less_disturbed), design);
  };
  // [[A, x], [x', c]] <= 2 diag(A, c).
  PhaseCovariance<Scalar> upper =
      diagonal(Scalar(2.0 * assumption.signal_variance), Scalar(2.0 * assumption.frequency_variance));
  PhaseCovariance<Scalar> lower = diagonal(Scalar(0.0), Scalar(0.0));
  PhaseCovariance<Scalar> predicted_lower = beneath(lower);
  for (int step = 1; step <= length.settling + length.window; ++step) {
    const int samples = step - length.settling;
    const double drift = detail::phase_drift(samples, length.slew);
    const auto [sine, cosine] = direction(samples, drift);
    const PhaseCovariance<Scalar> above = predicted(upper, more, disturbed(upper, more_disturbed), design);
    upper = Of::without_remainder(scaled(rounded_up, updated(above, sine, cosine, design.r)), 1.0, drift);
    if (step <= length.settling) {
      continue;
    }
    lower = Of::without_remainder(scaled(rounded_down, updated(predicted_lower, sine, cosine, design.r)),
                                  -1.0, drift);
    predicted_lower = beneath(lower);
    if (!visit(step - length.settling, upper, lower, predicted_lower)) {
      return;
    }
  }
}

/// The same from the phase and the frequency, rad and rad/sample.
template <typename Scalar, typename Visit>
void follow_window(const trackers::ToneModel<Scalar>& design, const WindowAssumption& assumption,
                   const WindowLength& length, const Scalar& phase, const Scalar& frequency,
                   const Visit& visit) {
  follow_window<Scalar>(
      design, assumption, length,
      [&](int samples, double drift) {
        using trackers::detail::sin_cos;
        return sin_cos(detail::advanced(phase, frequency, samples, drift));
      },
      visit);
}

}  // namespace veritrack::single_channel
