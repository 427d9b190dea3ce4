// One step of the errors, along a ray from zero, as quadratic forms: what decides whether it contracts.
//
// The errors e = (a, psi, nu) enter a step through a, the phase error chi = psi + nu of the prediction, and
// nu itself, which is merely carried along (epsilon = 0). So fix the ray
//     a = s A cos(beta),  chi = s C sin(beta),  nu = s m,   s > 0,
// and divide by s: e/s = b + m n with b = (A cos beta, C sin beta, 0), n = (0, -1, 1), and
//     e+/s = c + m (0, 0, 1)' + J D y / r,   |y|^2 <= eta^2,
// exactly. Here c is the step under the mean gain (K_lo + K_hi)/2, written with secant slopes, and the last
// term is what the covariance may do: P+ = Phi lies between Phi_lo and Phi_hi (riccati_order.hpp), that is
// Phi = (Phi_lo + Phi_hi)/2 + D Y D' with D D' = Delta = (Phi_hi - Phi_lo)/2 and |Y|_2 <= 1, so that the gain
// K = Phi H'/r moves the correction K i by D y / r, y = Y D' H' i, |y| <= eta = |D' H' i|. J is the Jacobian
// of
// (|z|, arg z, x3), averaged between the two corrected estimates.
//
// The template runs on double, at a point, to propose, and on Interval, over a cell of (s, beta), to prove.
#pragma once

#include <array>
#include <cmath>

#include "analysis/contraction/elementary_ratios.hpp"
#include "analysis/contraction/riccati_order.hpp"
#include "analysis/rigor/elementary.hpp"
#include "trackers/scalar_functions.hpp"

namespace veritrack::contraction {

/// T = [[amplitude, 0, 0], [0, phase, coupling], [0, 0, frequency]].
template <typename Scalar>
struct BlockMetric {
  Scalar amplitude, phase, coupling, frequency;
};

/// What the steps of a whole set have in common.
template <typename Scalar>
struct StepSetting {
  trackers::QuadratureEkfDesign<Scalar> design;  ///< epsilon = 0
  BlockMetric<Scalar> metric;
  BlockCovariance<Scalar> covariance_lower, covariance_upper;
  Scalar largest_amplitude;  ///< A
  Scalar largest_chi;        ///< C, rad
  Scalar noise;              ///< V
};

/// A ray, or a cell of rays with a range of s.
template <typename Scalar>
struct RayCell {
  Scalar scale;         ///< s in [0, 1]
  Scalar cosine, sine;  ///< of beta
  /// Where in the box around the mean correction the correction lies, as fractions of its half sides.
  Scalar along, across;
};

/// A symmetric 3x3 matrix.
template <typename Scalar>
struct Gram {
  Scalar g11, g12, g13, g22, g23, g33;
};

/// A step along a ray, divided by s.
template <typename Scalar>
struct PolarStepForm {
  Scalar q11, q12, q22;          ///< |T e|^2 / s^2 as a form in (1, m)
  std::array<Scalar, 3> centre;  ///< T c
  Gram<Scalar> gram;             ///< T J Delta J' T' / r^2
  Scalar eta_squared;
  Scalar rho;                        ///< 1 + a
  Scalar turn_tangent;               ///< bound on |tan| of the turn, noise included
  Scalar least_along;                ///< lower bound on the component of the corrected z along the prediction
  Scalar mean_real;                  ///< component of the z corrected by the mean gain along the true signal
  Scalar reach_along, reach_across;  ///< half sides of the box in which the spread of the gain moves z
  Scalar noise_gain;                 ///< bound on |T (e+ with noise v - e+ without)| / |v|
};

namespace detail {

/// fraction times radius.
inline double offset(double fraction, double radius) {
  return fraction * radius;
}
inline rigor::Interval offset(const rigor::Interval& fraction, const rigor::Interval& radius) {
  return fraction * rigor::Interval(radius.upper());
}
/// All fractions between 0 and these: over doubles the end.
inline double up_to(double fraction) {
  return fraction;
}
inline rigor::Interval up_to(const rigor::Interval& fraction) {
  return rigor::hull(rigor::Interval(0.0), fraction);
}
/// All fractions there are: over doubles this one.
inline double anywhere(double fraction) {
  return fraction;
}
inline rigor::Interval anywhere(const rigor::Interval& /*fraction*/) {
  return rigor::symmetric(1.0);
}
/// sqrt of a quantity that is non-negative although its enclosure may not be.
inline double root(double x) {
  return std::sqrt(std::fmax(x, 0.0));
}
inline rigor::Interval root(const rigor::Interval& x) {
  return rigor::sqrt(rigor::max(x, rigor::Interval(0.0)));
}
inline double larger(double a, double b) {
  return a < b ? b : a;
}
inline rigor::Interval larger(const rigor::Interval& a, const rigor::Interval& b) {
  return rigor::max(a, b);
}
inline double size(double x) {
  return std::fabs(x);
}
inline rigor::Interval size(const rigor::Interval& x) {
  return rigor::abs(x);
}
/// The larger eigenvalue of [[a, b], [b, c]].
template <typename Scalar>
[[nodiscard]] Scalar larger_eigenvalue(const Scalar& a, const Scalar& b, const Scalar& c) {
  using trackers::detail::square;
  return Scalar(0.5) * (a + c) + root(Scalar(square(Scalar(0.5) * (a - c)) + square(b)));
}

}  // namespace detail

/// Delta = (Phi_hi - Phi_lo)/2.
template <typename Scalar>
[[nodiscard]] BlockCovariance<Scalar> spread(const BlockUpdate<Scalar>& low,
                                             const BlockUpdate<Scalar>& high) {
  const Scalar half(0.5);
  return {half * (high.filtered.p11 - low.filtered.p11), half * (high.filtered.p22 - low.filtered.p22),
          half * (high.filtered.p23 - low.filtered.p23), half * (high.filtered.p33 - low.filtered.p33)};
}

/// B Delta B' / r^2 for B = T J = [[b11, b12, 0], [b21, b22, coupling], [0, 0, frequency]].
template <typename Scalar>
[[nodiscard]] Gram<Scalar> gram(const BlockMetric<Scalar>& t, const Scalar& b11, const Scalar& b12,
                                const Scalar& b21, const Scalar& b22, const BlockCovariance<Scalar>& delta,
                                const Scalar& r) {
  using trackers::detail::square;
  const Scalar scale = square(Scalar(Scalar(1.0) / r));
  const Scalar row2 = delta.p22 * b22 + delta.p23 * t.coupling;
  const Scalar row3 = delta.p23 * b22 + delta.p33 * t.coupling;
  return {scale * (delta.p11 * square(b11) + delta.p22 * square(b12)),
          scale * (delta.p11 * b11 * b21 + b12 * row2),
          scale * (delta.p23 * b12 * t.frequency),
          scale * (delta.p11 * square(b21) + b22 * row2 + t.coupling * row3),
          scale * (t.frequency * row3),
          scale * (delta.p33 * square(t.frequency))};
}

/// The derivatives of (|z|, arg z), [[cosine, sine], [-sine, cosine] over_length], at (z1, z2), z1 > 0.
template <typename Scalar>
struct PolarJacobian {
  Scalar cosine, sine, over_length;
};
template <typename Scalar>
[[nodiscard]] PolarJacobian<Scalar> polar_jacobian(const Scalar& z1, const Scalar& z2) {
  using trackers::detail::square;
  const Scalar tangent = z2 / z1;
  const Scalar cosine = Scalar(1.0) / detail::root(Scalar(Scalar(1.0) + square(tangent)));
  return {cosine, tangent * cosine, cosine / z1};
}

/// A bound on |T J K| for every gain K between the two bounds and the Jacobians in `there`:
/// |T J K| <= |T J K_mean| + |T J D| |D' H'| / r, the Gram matrix of T J D / r bounded through its row sums.
template <typename Scalar>
[[nodiscard]] Scalar noise_gain(const StepSetting<Scalar>& setting, const BlockUpdate<Scalar>& low,
                                const BlockUpdate<Scalar>& high, const PolarJacobian<Scalar>& there) {
  using trackers::detail::square;
  const Scalar half(0.5);
  const BlockMetric<Scalar>& t = setting.metric;
  const Scalar b11 = t.amplitude * there.cosine;
  const Scalar b12 = t.amplitude * there.sine;
  const Scalar b21 = -(t.phase * there.sine * there.over_length);
  const Scalar b22 = t.phase * there.cosine * there.over_length;
  const Scalar gain1 = half * (low.gain_amplitude + high.gain_amplitude);
  const Scalar gain2 = half * (low.gain_phase + high.gain_phase);
  const Scalar gain3 = half * (low.gain_frequency + high.gain_frequency);
  const Scalar second2 = b22 * gain2 + t.coupling * gain3;
  const Scalar mean_squared = detail::larger_eigenvalue(
      Scalar(square(gain1) * (square(b11) + square(b21))),
      Scalar(gain1 * (b11 * b12 * gain2 + b21 * second2)),
      Scalar(square(Scalar(b12 * gain2)) + square(second2) + square(Scalar(t.frequency * gain3))));
  const BlockCovariance<Scalar> delta = spread(low, high);
  const Gram<Scalar> g = gram(t, b11, b12, b21, b22, delta, setting.design.r);
  const Scalar spread_squared =
      detail::larger(detail::larger(Scalar(g.g11 + detail::size(g.g12) + detail::size(g.g13)),
                                    Scalar(g.g22 + detail::size(g.g12) + detail::size(g.g23))),
                     Scalar(g.g33 + detail::size(g.g13) + detail::size(g.g23)));
  return detail::root(mean_squared) +
         detail::root(Scalar(spread_squared * detail::larger(delta.p11, delta.p22)));
}

/// The form of a ray, or an enclosure of the forms of a cell. Over intervals it means something only if
/// `least_along` and `mean_real` are certainly positive. Then the corrected estimate stays in the half plane
/// around the prediction, where |z| and arg z are smooth; and the phase error after the mean correction, chi
/// + arg z in (-pi/2, 3 + pi/2), is the principal arg(1 + delta) in (-pi/2, pi/2) itself, because the two
/// differ by a multiple of 2 pi. (chi <= 3, beyond which the ratios are empty.)
template <typename Scalar>
[[nodiscard]] PolarStepForm<Scalar> polar_step_form(const StepSetting<Scalar>& setting,
                                                    const RayCell<Scalar>& ray) {
  using trackers::detail::sin_cos;
  using trackers::detail::square;
  const Scalar one(1.0);
  const Scalar half(0.5);
  const BlockMetric<Scalar>& t = setting.metric;
  const Scalar& r = setting.design.r;
  PolarStepForm<Scalar> form;

  // |T (b + m n)|^2.
  const Scalar a_slope = setting.largest_amplitude * ray.cosine;
  const Scalar chi_slope = setting.largest_chi * ray.sine;
  const Scalar tb2 = t.phase * chi_slope;
  const Scalar tn2 = t.coupling - t.phase;
  form.q11 = square(Scalar(t.amplitude * a_slope)) + square(tb2);
  form.q12 = tb2 * tn2;
  form.q22 = square(tn2) + square(t.frequency);

  // Innovation (cos chi - rho, -sin chi) / s.
  const Scalar chi = ray.scale * chi_slope;
  form.rho = one + ray.scale * a_slope;
  const Scalar along = -(a_slope + chi_slope * chi * cosine_ratio(chi));
  const Scalar across = -(chi_slope * sine_ratio(chi));

  // The gains of both bounds, their mean and their spread.
  const BlockUpdate<Scalar> low = riccati_update(setting.covariance_lower, form.rho, setting.design);
  const BlockUpdate<Scalar> high = riccati_update(setting.covariance_upper, form.rho, setting.design);
  const BlockCovariance<Scalar> delta = spread(low, high);
  form.eta_squared = delta.p11 * square(along) + delta.p22 * square(across);

  // The mean correction leaves z e^{i chi} = 1 + delta in the frame of the true phase, delta = -e^{i chi} u.
  const auto [sine, cosine] = sin_cos(chi);
  const Scalar u1 = half * (low.rest_amplitude + high.rest_amplitude) * along;
  const Scalar u2 = half * (low.rest_phase + high.rest_phase) * across;
  const Scalar delta1 = u2 * sine - u1 * cosine;
  const Scalar delta2 = -(u1 * sine + u2 * cosine);
  const Scalar full1 = ray.scale * delta1;
  const Scalar full2 = ray.scale * delta2;
  const Scalar real = one + full1;
  form.mean_real = real;
  const Scalar slope = delta2 / real;
  const Scalar length = real * detail::root(Scalar(one + square(Scalar(full2 / real))));
  const Scalar next_amplitude = ((one + real) * delta1 + full2 * delta2) / (one + length);
  const Scalar next_phase = arctangent_ratio(Scalar(ray.scale * slope)) * slope;
  const Scalar next_frequency = half * (low.gain_frequency + high.gain_frequency) * across;
  form.centre = {t.amplitude * next_amplitude, t.phase * next_phase + t.coupling * next_frequency,
                 t.frequency * next_frequency};

  // Everywhere the corrected z may be, in the frame of the prediction: the mean one, the spread of the gain,
  // and the noise through a gain K_zz <= K_hi.
  const Scalar eta = ray.scale * detail::root(form.eta_squared) / r;
  const Scalar reach1 = detail::root(delta.p11) * eta;
  const Scalar reach2 = detail::root(delta.p22) * eta;
  const Scalar noise_reach = detail::larger(high.gain_amplitude, high.gain_phase) * setting.noise;
  const Scalar z1 = cosine - ray.scale * u1;
  const Scalar z2 = -sine - ray.scale * u2;
  form.least_along = z1 - (reach1 + noise_reach);
  form.turn_tangent = (detail::size(z2) + reach2 + noise_reach) / form.least_along;

  // T J for the spread of the gain: averaged over the segment that leaves the mean z by d, J lies in J(mean)
  // + (1/2) J'(segment) d, since the weight 1 - t of the remainder integrates to 1/2.
  const PolarJacobian<Scalar> at_mean = polar_jacobian(z1, z2);
  const PolarJacobian<Scalar> around =
      polar_jacobian(Scalar(z1 + detail::offset(detail::up_to(ray.along), reach1)),
                     Scalar(z2 + detail::offset(detail::up_to(ray.across), reach2)));
  const Scalar d1 = half * detail::offset(ray.along, reach1);
  const Scalar d2 = half * detail::offset(ray.across, reach2);
  const Scalar twice = around.sine * around.cosine * (one + one);
  const Scalar over_squared = square(around.over_length);
  const Scalar transverse = around.over_length * (around.cosine * d2 - around.sine * d1);
  const Scalar b11 = t.amplitude * (at_mean.cosine - around.sine * transverse);
  const Scalar b12 = t.amplitude * (at_mean.sine + around.cosine * transverse);
  const Scalar cosine_twice = one - square(around.sine) * (one + one);
  const Scalar b21 =
      t.phase * (over_squared * (twice * d1 - cosine_twice * d2) - at_mean.sine * at_mean.over_length);
  const Scalar b22 =
      t.phase * (at_mean.cosine * at_mean.over_length - over_squared * (cosine_twice * d1 + twice * d2));

  form.gram = gram(t, b11, b12, b21, b22, delta, r);
  form.reach_along = reach1;
  form.reach_across = reach2;
  const Scalar noisy1 =
      z1 + detail::offset(ray.along, reach1) + detail::offset(detail::anywhere(ray.along), noise_reach);
  const Scalar noisy2 =
      z2 + detail::offset(ray.across, reach2) + detail::offset(detail::anywhere(ray.across), noise_reach);
  form.noise_gain = noise_gain(setting, low, high, polar_jacobian(noisy1, noisy2));
  return form;
}

}  // namespace veritrack::contraction
