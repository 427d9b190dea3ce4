// The extended Kalman filter that tracks the frequency of a quadrature (complex) sinusoid.
//
// B. F. La Scala, "Approaches to Frequency Tracking and Vibration Control", PhD thesis, Australian National
// University, 1994, chapter 3; and B. F. La Scala and R. R. Bitmead, "Design of an extended Kalman filter
// frequency tracker", IEEE Trans. Signal Processing 44(3), 1996. Equation numbers are the thesis's.
//
// State (x1, x2, x3): in-phase and quadrature part in signal units, frequency in rad/sample. With z = x1 + i
// x2,
//     z(k+1) = e^{i x3(k)} z(k),   x3(k+1) = (1 - epsilon) x3(k) + noise,   y(k) = z(k) + noise,     (3.1),
//     (3.2)
// Q = diag(q1, q1, q2), R = r I, and the EKF recursion (2.3)-(2.7) with F of (3.8) and H = [I 0] of (3.9).
//
// To use it in a program of your own, copy the folder trackers/; it needs a C++20 compiler and Eigen's
// headers:
//
//     using namespace veritrack::trackers;
//     QuadratureEkf<double> tracker({.q1 = 0.0023, .q2 = 0.0023, .r = 0.05, .epsilon = 0.0},
//                                   {.in_phase = 1.0, .quadrature = 0.0, .frequency = 0.3,
//                                    .covariance =
//                                    FactoredCovariance<double>::from_matrix(initial_covariance)});
//     for (const auto& [in_phase, quadrature] : samples) {
//       tracker.step(in_phase, quadrature);
//       use(tracker.filtered().frequency);
//     }
//
// Everything is a template over the scalar, free of branches on scalar values: the code that tracks in double
// is the code that encloses over intervals and differentiates over dual numbers. The certified map is this
// step in the coordinates of the errors, quadrature_polar_frame.hpp; a test shows that the two are identical.
// It does not allocate, and it never throws unless the scalar does.
//
// Numerics. The covariance is kept factored (see FactoredCovariance), and both updates are written as sums
// and quotients of non-negative terms, so that symmetry holds by construction and positive definiteness
// survives any number of steps and any size of P(0). Expanding the factors gives back (2.4), (2.6) and (2.7);
// a test compares them with the textbook matrices.
//
// Rounding. Certificates of this tracker (docs/rounding.md) are about `step` in double precision, under these
// conditions on the program that includes this file: + - * / round to nearest in IEEE 754 double precision,
// so no -ffast-math and nothing that it contains, no flush-to-zero set at run time, and no excess precision
// (x87); std::sin and std::cos are within one unit in the last place. Whether products and sums are fused
// (-ffp-contract) does not matter.
//
// Assumed, not checked: r > 0, q1 >= 0, q2 > 0, 0 <= epsilon < 1, P(0) symmetric and positive semidefinite,
// all finite.
#pragma once

#include "trackers/factored_covariance.hpp"
#include "trackers/scalar_functions.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::trackers {

/// A state estimate with its covariance: filtered, (k|k), or predicted, (k+1|k).
template <typename Scalar>
using QuadratureEstimate = ToneEstimate<Scalar>;

namespace detail {

/// The time update in the frame that turns with the estimate, in which F = [[I, Jz], [0, 1 - epsilon]], J the
/// quarter turn.
template <typename Scalar>
[[nodiscard]] inline QuadratureEstimate<Scalar> predicted_in_own_frame(
    const QuadratureEstimate<Scalar>& filtered, const ToneModel<Scalar>& design) {
  const FactoredCovariance<Scalar>& p = filtered.covariance;
  const Scalar retention = Scalar(1.0) - design.epsilon;

  // Per unit of frequency error e3, z errs by h = u + Jz after the step.
  const Scalar h1 = p.regression_1 - filtered.quadrature;
  const Scalar h2 = p.regression_2 + filtered.in_phase;

  // Condition on the predicted frequency error (1 - epsilon) e3 + w3 in place of e3: what remains of e3 has
  // the variance d q2 / ((1 - epsilon)^2 d + q2), and spreads z along h.
  const Scalar variance = square(retention) * p.frequency_variance + design.q2;
  const Scalar fraction = p.frequency_variance / variance;
  const Scalar regression = retention * fraction;
  const Scalar remaining = design.q2 * fraction;
  return {
      filtered.in_phase,
      filtered.quadrature,
      retention * filtered.frequency,
      {p.conditional_11 + design.q1 + remaining * square(h1), p.conditional_12 + remaining * h1 * h2,
       p.conditional_22 + design.q1 + remaining * square(h2), regression * h1, regression * h2, variance}};
}

}  // namespace detail

/// From (k|k) to (k+1|k): equations (2.5) and (2.6) with F of (3.8).
template <typename Scalar>
[[nodiscard]] inline QuadratureEstimate<Scalar> time_update(const QuadratureEstimate<Scalar>& filtered,
                                                            const ToneModel<Scalar>& design) {
  using detail::sin_cos;
  const auto [sine, cosine] = sin_cos(filtered.frequency);
  return turned(detail::predicted_in_own_frame(filtered, design), sine, cosine);
}

/// From (k|k-1) to (k|k) with the measurement y(k) = (in_phase, quadrature), signal units: equations (2.3),
/// (2.4) and (2.7) with H of (3.9).
template <typename Scalar>
[[nodiscard]] inline QuadratureEstimate<Scalar> measurement_update(
    const QuadratureEstimate<Scalar>& predicted, const Scalar& in_phase, const Scalar& quadrature,
    const ToneModel<Scalar>& design) {
  using detail::not_negative;
  using detail::square;
  const FactoredCovariance<Scalar>& p = predicted.covariance;
  const Scalar& r = design.r;
  const Scalar innovation1 = in_phase - predicted.in_phase;
  const Scalar innovation2 = quadrature - predicted.quadrature;

  // W = M + r I is the innovation covariance if the frequency were known. det W is a sum of non-negative
  // terms.
  const Scalar w11 = p.conditional_11 + r;
  const Scalar w22 = p.conditional_22 + r;
  const Scalar determinant_m =
      not_negative(Scalar(p.conditional_11 * p.conditional_22 - square(p.conditional_12)));
  const Scalar determinant_w = determinant_m + r * (p.conditional_11 + w22);
  const Scalar inverse = Scalar(1.0) / determinant_w;

  // The gain for z with the frequency known, M W^-1 = (det(M) I + r M) / det W.
  const Scalar scaled = r * inverse;
  const Scalar isotropic = determinant_m * inverse;
  const Scalar gain11 = isotropic + scaled * p.conditional_11;
  const Scalar gain12 = scaled * p.conditional_12;
  const Scalar gain22 = isotropic + scaled * p.conditional_22;

  // t = W^-1 u. The innovation informs the frequency with u'W^-1 u = u't.
  const Scalar t1 = (w22 * p.regression_1 - p.conditional_12 * p.regression_2) * inverse;
  const Scalar t2 = (w11 * p.regression_2 - p.conditional_12 * p.regression_1) * inverse;
  const Scalar information = not_negative(Scalar(p.regression_1 * t1 + p.regression_2 * t2));
  const Scalar variance = p.frequency_variance / (Scalar(1.0) + p.frequency_variance * information);
  const Scalar u1 = r * t1;
  const Scalar u2 = r * t2;
  const Scalar correction = variance * (t1 * innovation1 + t2 * innovation2);
  return {predicted.in_phase + gain11 * innovation1 + gain12 * innovation2 + u1 * correction,
          predicted.quadrature + gain12 * innovation1 + gain22 * innovation2 + u2 * correction,
          predicted.frequency + correction,
          {r * gain11, r * gain12, r * gain22, u1, u2, variance}};
}

/// A prediction and its update by the measurement.
template <typename Scalar>
struct QuadratureStep {
  QuadratureEstimate<Scalar> predicted;  ///< (k+1|k)
  QuadratureEstimate<Scalar> filtered;   ///< (k+1|k+1)
};

/// One sample, from (k|k) to (k+1|k+1) with the measurement y(k+1), signal units: time_update, then
/// measurement_update. The measurement is turned into the frame of the estimate and the result turned back,
/// which is the same thing (the filter commutes with rotations) and lets the covariances be computed while
/// sine and cosine are still on their way.
template <typename Scalar>
[[nodiscard]] inline QuadratureStep<Scalar> step(const QuadratureEstimate<Scalar>& filtered,
                                                 const Scalar& in_phase, const Scalar& quadrature,
                                                 const ToneModel<Scalar>& design) {
  using detail::sin_cos;
  const auto [sine, cosine] = sin_cos(filtered.frequency);
  const QuadratureEstimate<Scalar> predicted = detail::predicted_in_own_frame(filtered, design);
  const Scalar own_in_phase = in_phase * cosine + quadrature * sine;
  const Scalar own_quadrature = quadrature * cosine - in_phase * sine;
  return {turned(predicted, sine, cosine),
          turned(measurement_update(predicted, own_in_phase, own_quadrature, design), sine, cosine)};
}

/// The tracker with its memory. It starts from one estimate, which is x(0|0) when `step` or
/// `time_update` comes first, and as x(1|0) when `measurement_update` does.
template <typename Scalar = double>
class QuadratureEkf {
 public:
  QuadratureEkf(const ToneModel<Scalar>& design, const QuadratureEstimate<Scalar>& start)
      : design_(design), current_{start, start} {}

  /// predicted() becomes (k+1|k), from filtered() at (k|k).
  void time_update() { current_.predicted = trackers::time_update(current_.filtered, design_); }

  /// filtered() becomes (k|k), from predicted() at (k|k-1) and the measurement y(k) in signal units.
  void measurement_update(const Scalar& in_phase, const Scalar& quadrature) {
    current_.filtered = trackers::measurement_update(current_.predicted, in_phase, quadrature, design_);
  }

  /// One sample: time_update, then measurement_update with y(k+1).
  void step(const Scalar& in_phase, const Scalar& quadrature) {
    current_ = trackers::step(current_.filtered, in_phase, quadrature, design_);
  }

  [[nodiscard]] const ToneModel<Scalar>& design() const { return design_; }
  [[nodiscard]] const QuadratureEstimate<Scalar>& predicted() const { return current_.predicted; }
  [[nodiscard]] const QuadratureEstimate<Scalar>& filtered() const { return current_.filtered; }

 private:
  ToneModel<Scalar> design_;
  QuadratureStep<Scalar> current_;
};

}  // namespace veritrack::trackers
