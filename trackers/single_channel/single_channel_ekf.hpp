// The extended Kalman filter that tracks the frequency of a sinusoid of which only one channel is measured.
//
// S. Bittanti and S. M. Savaresi, "On the parameterization and design of an extended Kalman filter frequency
// tracker", IEEE Trans. Automatic Control 45(9), 2000. Equation numbers are the paper's.
//
// State (x1, x2, x3): in-phase and quadrature part in signal units, frequency in rad/sample. With z = x1 + i
// x2,
//     z(k+1) = e^{i x3(k)} z(k),   x3(k+1) = (1 - epsilon) x3(k) + noise,   y(k) = x1(k) + noise,         (1)
// process noise covariance Q, measurement noise variance r, and the EKF recursion (2).
//
// The paper prints Q as q I_3 with "I_3" = diag(0, 0, 1). Both readings are here by name
// (frequency_only_process_noise, identity_process_noise), and so is Q = diag(q1, q1, q2); any other symmetric
// Q >= 0 enters through FactoredCovariance::from_matrix.
//
// The paper defines F(t) of the Riccati equation at the estimate x(t-1|t-1), twice, and uses it for P(t+1).
// That is one sample late: with it the tracker locks on both frequencies of the paper's Example 1 for none of
// 20 noise seeds, whichever Q (`veritrack reproduce`, docs/reports/bittanti-savaresi-2000/report.md). Here F
// is evaluated at x(t|t), the estimate from which the state is predicted, as in every extended Kalman filter.
//
// To use it in a program of your own, copy the folder trackers/; it needs a C++20 compiler and Eigen's
// headers:
//
//     using namespace veritrack::trackers;
//     SingleChannelEkf<double> tracker({.process_noise = identity_process_noise(0.005), .r = 0.01, .epsilon =
//                                       0.0},
//                                      {.in_phase = 1.0, .quadrature = 0.0, .frequency = 0.5,
//                                       .covariance = identity_process_noise(0.005)});
//     for (const double y : samples) {
//       tracker.step(y);
//       use(tracker.filtered().frequency);
//     }
//
// A template over the scalar: the code that tracks in double is the code that encloses over intervals and
// differentiates over dual numbers. The certified map is this step in the frame of the signal,
// single_channel_rotating_frame.hpp; a test shows that the two are identical. It does not allocate. The only
// failure of a step is an innovation variance of exactly zero, with which the gain is 0/0:
// ZeroInnovationVariance. It takes r = 0 and a prediction that is certain of x1, such as P(0|0) = 0 with the
// frequency-only process noise.
//
// Numerics. As in the quadrature tracker the covariance is kept factored, and both updates are sums and
// quotients of non-negative terms: symmetry holds by construction, and the variances keep their sign for r =
// 0 too, where P(k|k) is singular. Expanding the factors gives back (2); a test compares it with the textbook
// matrices.
//
// Rounding. Certificates of this tracker (docs/rounding.md) are about `step` in double precision, under these
// conditions on the program that includes this file: + - * / round to nearest in IEEE 754 double precision,
// so no -ffast-math and nothing that it contains, no flush-to-zero set at run time, and no excess precision
// (x87); std::sin and std::cos are within one unit in the last place. Whether products and sums are fused
// (-ffp-contract) does not matter.
//
// Assumed, not checked: r >= 0, Q and P(0) symmetric and positive semidefinite, 0 <= epsilon < 1, all finite.
#pragma once

#include <stdexcept>

#include "trackers/factored_covariance.hpp"
#include "trackers/scalar_functions.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::trackers {

/// The engineer's choices.
template <typename Scalar>
struct SingleChannelEkfDesign {
  FactoredCovariance<Scalar> process_noise;  ///< Q
  Scalar r;                                  ///< measurement noise variance, signal units squared; >= 0
  Scalar epsilon;                            ///< leak of the frequency towards zero per sample; in [0, 1)
};

/// Q = diag(q1, q1, q2): q1 in signal units squared, q2 in (rad/sample)^2.
template <typename Scalar>
[[nodiscard]] inline FactoredCovariance<Scalar> diagonal_process_noise(const Scalar& q1, const Scalar& q2) {
  return {q1, Scalar(0.0), q1, Scalar(0.0), Scalar(0.0), q2};
}

/// Q = q diag(0, 0, 1), as the paper prints it.
template <typename Scalar>
[[nodiscard]] inline FactoredCovariance<Scalar> frequency_only_process_noise(const Scalar& q) {
  return diagonal_process_noise(Scalar(0.0), q);
}

/// Q = q diag(1, 1, 1).
template <typename Scalar>
[[nodiscard]] inline FactoredCovariance<Scalar> identity_process_noise(const Scalar& q) {
  return diagonal_process_noise(q, q);
}

/// The tracker with one knob, (15): epsilon = 0, r = lambda = r/q, and Q that of q = 1.
template <typename Scalar>
[[nodiscard]] inline SingleChannelEkfDesign<Scalar> single_channel_design_of_ratio(
    const FactoredCovariance<Scalar>& unit_process_noise, const Scalar& lambda) {
  return {unit_process_noise, lambda, Scalar(0.0)};
}

/// A state estimate with its covariance: filtered, (k|k), or predicted, (k+1|k).
template <typename Scalar>
using SingleChannelEstimate = ToneEstimate<Scalar>;

/// Thrown by a measurement update whose innovation variance H P H' + r is exactly zero.
class ZeroInnovationVariance : public std::domain_error {
 public:
  ZeroInnovationVariance()
      : std::domain_error(
            "the innovation variance P11(k|k-1) + r is exactly zero: with r = 0 the tracker needs a "
            "prediction that is not certain of x1; choose r above zero, or a start or process noise with "
            "some variance") {}
};

/// From (k|k) to (k+1|k): the prediction and the time update of P in (2).
template <typename Scalar>
[[nodiscard]] inline SingleChannelEstimate<Scalar> time_update(const SingleChannelEstimate<Scalar>& filtered,
                                                               const SingleChannelEkfDesign<Scalar>& design) {
  using detail::sin_cos;
  using detail::square;
  const FactoredCovariance<Scalar>& p = filtered.covariance;
  const Scalar retention = Scalar(1.0) - design.epsilon;
  // In the frame that turns with the estimate F = [[I, Jz], [0, 1 - epsilon]]: per unit of frequency error z
  // errs by u + Jz after the step, and per unit of the frequency error that is left by 1 / (1 - epsilon)
  // times that.
  const SingleChannelEstimate<Scalar> predicted{
      filtered.in_phase,
      filtered.quadrature,
      retention * filtered.frequency,
      {p.conditional_11, p.conditional_12, p.conditional_22,
       (p.regression_1 - filtered.quadrature) / retention, (p.regression_2 + filtered.in_phase) / retention,
       square(retention) * p.frequency_variance}};
  const auto [sine, cosine] = sin_cos(filtered.frequency);
  SingleChannelEstimate<Scalar> result = turned(predicted, sine, cosine);
  result.covariance = sum(result.covariance, design.process_noise);
  return result;
}

/// From (k|k-1) to (k|k) with the measurement y(k), signal units: the gain and the corrections in (2). Throws
/// ZeroInnovationVariance.
template <typename Scalar>
[[nodiscard]] inline SingleChannelEstimate<Scalar> measurement_update(
    const SingleChannelEstimate<Scalar>& predicted, const Scalar& measurement,
    const SingleChannelEkfDesign<Scalar>& design) {
  using detail::not_negative;
  using detail::square;
  const FactoredCovariance<Scalar>& p = predicted.covariance;
  const Scalar& r = design.r;
  // w would be the innovation variance if the frequency were known; s is the actual one.
  const Scalar w = not_negative(p.conditional_11) + r;
  const Scalar p11 = p.conditional_11 + p.frequency_variance * square(p.regression_1);
  const Scalar p13 = p.frequency_variance * p.regression_1;
  const Scalar s = w + p.frequency_variance * square(p.regression_1);
  if (s == Scalar(0.0)) {
    throw ZeroInnovationVariance();
  }
  const Scalar weighted = (measurement - predicted.in_phase) / s;
  SingleChannelEstimate<Scalar> filtered{
      predicted.in_phase + p11 * weighted,
      predicted.quadrature + (p.conditional_12 + p13 * p.regression_2) * weighted,
      predicted.frequency + p13 * weighted, p};
  const Scalar variance = p.frequency_variance * (w / s);
  if (w == Scalar(0.0)) {
    // x1 was certain except for the frequency, so the measurement determines both.
    filtered.covariance = {p.conditional_11, p.conditional_12, p.conditional_22,
                           Scalar(0.0),      Scalar(0.0),      variance};
    return filtered;
  }
  // Given the frequency, x1 is corrected by m11/w of the innovation and x2 by m12/w.
  const Scalar left = r / w;
  const Scalar gain2 = p.conditional_12 / w;
  const Scalar determinant = p.conditional_11 * p.conditional_22 - square(p.conditional_12);
  filtered.covariance = {left * p.conditional_11,
                         left * p.conditional_12,
                         left * p.conditional_22 + determinant / w,
                         left * p.regression_1,
                         p.regression_2 - gain2 * p.regression_1,
                         variance};
  return filtered;
}

/// The tracker with its memory. It starts from one estimate, which is x(0|0) when `step` or
/// `time_update` comes first, and as x(1|0) when `measurement_update` does.
template <typename Scalar = double>
class SingleChannelEkf {
 public:
  SingleChannelEkf(const SingleChannelEkfDesign<Scalar>& design, const SingleChannelEstimate<Scalar>& start)
      : design_(design), predicted_(start), filtered_(start) {}

  /// predicted() becomes (k+1|k), from filtered() at (k|k).
  void time_update() { predicted_ = trackers::time_update(filtered_, design_); }

  /// filtered() becomes (k|k), from predicted() at (k|k-1) and the measurement y(k) in signal units. Throws
  /// ZeroInnovationVariance.
  void measurement_update(const Scalar& measurement) {
    filtered_ = trackers::measurement_update(predicted_, measurement, design_);
  }

  /// One sample: time_update, then measurement_update with y(k+1). Throws ZeroInnovationVariance.
  void step(const Scalar& measurement) {
    time_update();
    measurement_update(measurement);
  }

  [[nodiscard]] const SingleChannelEkfDesign<Scalar>& design() const { return design_; }
  [[nodiscard]] const SingleChannelEstimate<Scalar>& predicted() const { return predicted_; }
  [[nodiscard]] const SingleChannelEstimate<Scalar>& filtered() const { return filtered_; }

 private:
  SingleChannelEkfDesign<Scalar> design_;
  SingleChannelEstimate<Scalar> predicted_;
  SingleChannelEstimate<Scalar> filtered_;
};

}  // namespace veritrack::trackers
