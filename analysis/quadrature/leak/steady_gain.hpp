// Deviations of the covariance from its steady state, as divided differences of the Riccati step.
//
// All in one frame: that of the steady state's estimated phase after the step, into which the prediction is
// turned by the angle nu* (the steady turn of the estimate is -nu*, which is what keeps the phase error
// constant). There the filtered covariance of a steady step is P* itself, and its gain is P* H' / r.
//
// Let P = P* + s Y and rho = rho* + s alpha, Y between -below and above. With Phi the filtered covariance,
//     Phi(P, rho) - P* = (I - K H) (Pp - Pp*) (I - K* H)',   Pp the predicted covariance, K the gain of Pp,
// is an identity: multiply out, with Phi H' = r K and H P* = r K*'. Pp - Pp* is s times a matrix that is
// written down without a division, and so is everything below. docs/leak.md, section 3.
#pragma once

#include "trackers/quadrature/quadrature_polar_frame.hpp"

namespace veritrack::quadrature {

/// A symmetric 3x3 matrix: amplitude, phase, frequency.
template <typename Scalar>
using Symmetric = trackers::PolarCovariance<Scalar>;

/// a + factor b.
template <typename Scalar>
[[nodiscard]] Symmetric<Scalar> plus(const Symmetric<Scalar>& a, const Symmetric<Scalar>& b,
                                     const Scalar& factor) {
  return {a.p11 + factor * b.p11, a.p12 + factor * b.p12, a.p13 + factor * b.p13,
          a.p22 + factor * b.p22, a.p23 + factor * b.p23, a.p33 + factor * b.p33};
}

/// The fixed point of the loop at one frequency, or all of them over a range.
template <typename Scalar>
struct SteadyState {
  Scalar rho;                    ///< |z*|
  Scalar phase, frequency;       ///< psi*, rad, and nu*, rad/sample
  Symmetric<Scalar> covariance;  ///< P*
};

/// The deviations from P* that belong to level 1.
template <typename Scalar>
struct CovarianceBand {
  Symmetric<Scalar> below, above;
};

/// (I - K H) M (I - L H)' for gains K and L, where the product is known to be symmetric.
template <typename Scalar>
[[nodiscard]] Symmetric<Scalar> corrected(const trackers::PolarGain<Scalar>& k, const Symmetric<Scalar>& m,
                                          const trackers::PolarGain<Scalar>& l) {
  const Scalar one(1.0);
  const Scalar k11 = one - k.k11;
  const Scalar k22 = one - k.k22;
  const Scalar l11 = one - l.k11;
  const Scalar l22 = one - l.k22;
  // The rows of (I - K H) M.
  const Scalar r11 = k11 * m.p11 - k.k12 * m.p12;
  const Scalar r12 = k11 * m.p12 - k.k12 * m.p22;
  const Scalar r13 = k11 * m.p13 - k.k12 * m.p23;
  const Scalar r21 = k22 * m.p12 - k.k12 * m.p11;
  const Scalar r22 = k22 * m.p22 - k.k12 * m.p12;
  const Scalar r23 = k22 * m.p23 - k.k12 * m.p13;
  const Scalar r31 = m.p13 - k.k31 * m.p11 - k.k32 * m.p12;
  const Scalar r32 = m.p23 - k.k31 * m.p12 - k.k32 * m.p22;
  const Scalar r33 = m.p33 - k.k31 * m.p13 - k.k32 * m.p23;
  return {r11 * l11 - r12 * l.k12, r12 * l22 - r11 * l.k12,         r13 - r11 * l.k31 - r12 * l.k32,
          r22 * l22 - r21 * l.k12, r23 - r21 * l.k31 - r22 * l.k32, r33 - r31 * l.k31 - r32 * l.k32};
}

/// The range of the filtered covariance at a level s and an amplitude rho* + s alpha: between P* + s low and
/// P* + s high in the Loewner order.
template <typename Scalar>
struct CovarianceImage {
  Symmetric<Scalar> low, high;
  /// (low + high)/2 = mean_of_band + alpha mean_by_alpha.
  Symmetric<Scalar> mean_of_band, mean_by_alpha;
  Symmetric<Scalar> spread;  ///< (high - low)/2, positive semidefinite
};

/// See CovarianceImage. The turn by nu* is given by its sine and cosine.
template <typename Scalar>
[[nodiscard]] CovarianceImage<Scalar> covariance_image(const SteadyState<Scalar>& steady, const Scalar& sine,
                                                       const Scalar& cosine,
                                                       const CovarianceBand<Scalar>& band,
                                                       const trackers::ToneModel<Scalar>& design,
                                                       const Scalar& level, const Scalar& alpha) {
  const Scalar zero(0.0);
  const Scalar one(1.0);
  const Scalar half(0.5);
  const Symmetric<Scalar>& p = steady.covariance;
  const Scalar rho = steady.rho + level * alpha;
  const Scalar retention = one - design.epsilon;
  const trackers::ToneModel<Scalar> quiet{zero, zero, design.r, design.epsilon};
  const auto predict = [&](const Symmetric<Scalar>& deviation) {
    return trackers::turned(trackers::predicted_covariance(deviation, rho, quiet), sine, cosine);
  };
  // (F(rho) P* F(rho)' - F(rho*) P* F(rho*)') / (s alpha).
  const Symmetric<Scalar> drift =
      trackers::turned(Symmetric<Scalar>{zero, p.p13, zero, p.p23 + p.p23 + (rho + steady.rho) * p.p33,
                                         retention * p.p33, zero},
                       sine, cosine);
  const Symmetric<Scalar> start =
      trackers::turned(trackers::predicted_covariance(p, steady.rho, design), sine, cosine);
  const Symmetric<Scalar> below = predict(band.below);
  const Symmetric<Scalar> above = predict(band.above);
  const Scalar shift = level * alpha;
  const Symmetric<Scalar> moved = plus(start, drift, shift);
  const Scalar over_r = one / design.r;
  const trackers::PolarGain<Scalar> steady_gain{over_r * p.p11, over_r * p.p12, over_r * p.p22,
                                                over_r * p.p13, over_r * p.p23};
  const trackers::PolarGain<Scalar> low_gain = trackers::gain(plus(moved, below, Scalar(-level)), design.r);
  const trackers::PolarGain<Scalar> high_gain = trackers::gain(plus(moved, above, level), design.r);
  const Symmetric<Scalar> up = corrected(high_gain, above, steady_gain);
  const Symmetric<Scalar> down = corrected(low_gain, below, steady_gain);
  const Symmetric<Scalar> drift_high = corrected(high_gain, drift, steady_gain);
  const Symmetric<Scalar> drift_low = corrected(low_gain, drift, steady_gain);
  const Symmetric<Scalar> none{zero, zero, zero, zero, zero, zero};
  CovarianceImage<Scalar> image;
  image.high = plus(up, drift_high, alpha);
  image.low = plus(plus(none, down, Scalar(-one)), drift_low, alpha);
  image.mean_of_band = plus(plus(none, up, half), down, Scalar(-half));
  image.mean_by_alpha = plus(plus(none, drift_high, half), drift_low, half);
  image.spread = plus(none, corrected(high_gain, plus(below, above, one), low_gain), half);
  return image;
}

/// (U (P* + s B) U' - P*) / s for U = diag(Rot(-angle), 1), tan(angle) = s * tangent, cos(angle) > 0.
template <typename Scalar>
[[nodiscard]] Symmetric<Scalar> turned_deviation(const Symmetric<Scalar>& steady,
                                                 const Symmetric<Scalar>& deviation, const Scalar& level,
                                                 const Scalar& tangent) {
  using std::sqrt;
  using trackers::detail::square;
  const Scalar one(1.0);
  const Scalar two(2.0);
  const Scalar tangent_of_turn = level * tangent;
  const Scalar cosine = one / sqrt(one + square(tangent_of_turn));
  const Scalar slope = tangent * cosine;  // sin(angle) / s
  const Scalar sine = level * slope;
  const Scalar half_difference = Scalar(0.5) * (steady.p11 - steady.p22);
  const Scalar versine = sine / (one + cosine);  // (1 - cos) / sin
  const Scalar diagonal = two * slope * (steady.p12 * cosine - half_difference * sine);
  const Symmetric<Scalar> moved{diagonal,
                                -(two * slope * (half_difference * cosine + steady.p12 * sine)),
                                slope * (steady.p23 - steady.p13 * versine),
                                -diagonal,
                                -(slope * (steady.p13 + steady.p23 * versine)),
                                Scalar(0.0)};
  return plus(trackers::turned(deviation, Scalar(-sine), cosine), moved, one);
}

}  // namespace veritrack::quadrature
