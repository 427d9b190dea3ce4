// One step of the errors, around a ray from zero, as quadratic forms, which decide whether it contracts.
//
// The errors e = (a, psi, nu) enter a step through a, the phase error chi = psi + nu of the prediction, and
// nu itself, which is merely carried along (epsilon = 0). With A and C the largest |a| and |chi| of the set,
//     a = s A cos(beta),  chi = s C sin(beta),  0 <= s <= 1.
// Fix an axis, a vector (c0, s0) near the (cos(beta), sin(beta)) that matter, and write
//     (a / A, chi / C) = x (c0, s0) + y (-s0, c0),
// so that e is linear in (x, y, nu). With noise v (in the frame of the predicted phase) and slew w, and with
// secant slopes in place of derivatives, the step is linear in (x, y, nu, v, w, z) too, exactly:
//     e+ = c_x x + c_y y + nu (0, 0, 1)' + J (K_mean v + D z / r) - w (0, 0, 1)',
//     |z|^2 <= Delta11 (i1 + v1)^2 + Delta22 (i2 + v2)^2,  i = i_x x + i_y y.
// Here i is the innovation without noise, c the step under the mean gain K_mean = (K_lo + K_hi)/2, and z is
// the effect of the covariance: P+ = Phi lies between Phi_lo and Phi_hi (riccati_order.hpp), that is Phi =
// (Phi_lo + Phi_hi)/2 + D Y D' with D D' = Delta = (Phi_hi - Phi_lo)/2 and |Y|_2 <= 1, so that the gain K =
// Phi H'/r moves the correction K (i + v) by D z / r, z = Y D' H' (i + v). J is the Jacobian of (|z|, arg z,
// x3), averaged between the estimate that the mean gain corrects without noise and the actual one.
//
// The template runs on double, at a point, to propose; on Interval, at the middle of a cell; and on intervals
// with derivatives, over the cell: the mean value theorem then encloses the coefficients of all its points.
#pragma once

#include <array>
#include <cmath>

#include "analysis/quadrature/contraction/correction.hpp"
#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/elementary.hpp"
#include "trackers/scalar_functions.hpp"

namespace veritrack::quadrature {

/// A point, or a cell.
template <typename Constant, typename Scalar>
struct RayCell {
  Scalar scale;                     ///< s in [0, 1]
  Scalar beta;                      ///< rad
  Constant axis_cosine, axis_sine;  ///< (c0, s0), exact, not both zero
  /// Where the correction lies around the mean correction: multiples, between -1 and 1, of `reach`.
  Scalar along, across;
  std::array<Constant, 2> reach;  ///< along and across; at least what correction_reach says
};

/// A symmetric 3x3 matrix.
template <typename Scalar>
struct Gram {
  Scalar g11, g12, g13, g22, g23, g33;
};

/// A step: see above. Arrays are over the two basis vectors of x and y.
template <typename Constant, typename Scalar>
struct PolarStepForm {
  Gram<Constant> size;                              ///< |T e|^2 as a form in (x, y, nu)
  std::array<std::array<Scalar, 3>, 2> centre;      ///< T c
  std::array<std::array<Scalar, 2>, 2> innovation;  ///< i: [basis vector][along, across]
  std::array<Scalar, 2> spread;                     ///< (Delta11, Delta22)
  std::array<std::array<Scalar, 3>, 2> gain;        ///< the columns of T J K_mean
  Gram<Scalar> gram;                                ///< T J Delta J' T' / r^2
  Constant least_along;           ///< lower bound on the component of the corrected z along the prediction
  Constant mean_real;             ///< component of the z corrected by the mean gain along the true signal
  std::array<Constant, 2> reach;  ///< correction_reach
};

/// B Delta B' / r^2 for B = T J = [[b11, b12, 0], [b21, b22, coupling], [0, 0, frequency]].
template <typename Constant, typename Scalar>
[[nodiscard]] Gram<Scalar> gram(const BlockMetric<Constant>& t, const std::array<Scalar, 4>& b,
                                const BlockCovariance<Scalar>& delta, const Constant& r) {
  using trackers::detail::square;
  const Constant scale = square(Constant(Constant(1.0) / r));
  const auto& [b11, b12, b21, b22] = b;
  const Scalar row2 = delta.p22 * b22 + delta.p23 * t.coupling;
  const Scalar row3 = delta.p23 * b22 + delta.p33 * t.coupling;
  return {scale * (delta.p11 * square(b11) + delta.p22 * square(b12)),
          scale * (delta.p11 * b11 * b21 + b12 * row2),
          scale * (delta.p23 * b12 * t.frequency),
          scale * (delta.p11 * square(b21) + b22 * row2 + t.coupling * row3),
          scale * (t.frequency * row3),
          scale * (delta.p33 * square(t.frequency))};
}

/// T times the derivatives of (|z|, arg z) at (z1, z2), z1 > 0: (b11, b12, b21, b22) of the matrix above.
template <typename Constant, typename Scalar>
[[nodiscard]] std::array<Scalar, 4> polar_jacobian(const BlockMetric<Constant>& t, const Scalar& z1,
                                                   const Scalar& z2) {
  using std::sqrt;
  using trackers::detail::square;
  const Constant one(1.0);
  const Scalar tangent = z2 / z1;
  const Scalar cosine = one / sqrt(one + square(tangent));
  const Scalar over_length = cosine / z1;
  return {t.amplitude * cosine, t.amplitude * (tangent * cosine),
          -(t.phase * (tangent * cosine * over_length)), t.phase * (cosine * over_length)};
}

/// The same, averaged over the segment from z to z + d, d = (d1, d2). Proposal: in the middle.
[[nodiscard]] inline std::array<double, 4> averaged_jacobian(const BlockMetric<double>& t, double z1,
                                                             double z2, double d1, double d2) {
  return polar_jacobian(t, z1 + 0.5 * d1, z2 + 0.5 * d2);
}
/// In the middle, with the remainder f''/24 of the midpoint rule. Along the segment (cos, sin)(arg z) has a
/// second derivative of at most sqrt(2) |d|^2/|z|^2, and 1/z one of 2 |d|^2/|z|^3.
template <typename Set>
[[nodiscard]] std::array<Set, 4> averaged_jacobian(const BlockMetric<Set>& t, const Set& z1, const Set& z2,
                                                   const Set& d1, const Set& d2) {
  using trackers::detail::square;
  const Set half(0.5);
  std::array<Set, 4> b = polar_jacobian(t, Set(z1 + half * d1), Set(z2 + half * d2));
  const Set least = hull(z1, z1 + d1);  // |z| is at least its first component, which is positive
  const Set bend = (square(d1) + square(d2)) / square(least);
  const Set of_direction = t.amplitude * bend / Set(16.0);
  const Set of_inverse = t.phase * bend / (Set(12.0) * least);
  for (std::size_t i = 0; i < 4; ++i) {
    b[i] += detail::at_most(i < 2 ? of_direction : of_inverse);
  }
  return b;
}
/// Its derivatives: those of the Jacobian at any point of the segment.
template <typename Set, int N>
[[nodiscard]] std::array<rigor::Dual<Set, N>, 4> averaged_jacobian(const BlockMetric<Set>& t,
                                                                   const rigor::Dual<Set, N>& z1,
                                                                   const rigor::Dual<Set, N>& z2,
                                                                   const rigor::Dual<Set, N>& d1,
                                                                   const rigor::Dual<Set, N>& d2) {
  const auto part = Set::from_bounds(0.0, 1.0);
  return polar_jacobian(t, z1 + d1 * part, z2 + d2 * part);
}

/// A step, and the correction that it makes.
template <typename Constant, typename Scalar>
struct StepWithCorrection {
  PolarStepForm<Constant, Scalar>
      form;  ///< without `gain` and `gram`, which depend on where the correction is
  Correction<Constant, Scalar> correction;
};

/// The step at the errors of a ray; its `along`, `across` and `reach` are not read.
template <typename Constant, typename Scalar>
[[nodiscard]] StepWithCorrection<Constant, Scalar> step_with_correction(
    const StepSetting<Constant>& setting, const RayCell<Constant, Scalar>& ray) {
  using trackers::detail::sin_cos;
  using trackers::detail::square;
  const BlockMetric<Constant>& t = setting.metric;
  StepWithCorrection<Constant, Scalar> result;
  PolarStepForm<Constant, Scalar>& form = result.form;

  // |T (x b_x + y b_y + nu n)|^2, n = (0, -1, 1).
  const Constant a_axis = setting.largest_amplitude * ray.axis_cosine;
  const Constant a_other = -(setting.largest_amplitude * ray.axis_sine);
  const Constant chi_axis = setting.largest_chi * ray.axis_sine;
  const Constant chi_other = setting.largest_chi * ray.axis_cosine;
  const Constant tn2 = t.coupling - t.phase;
  const Constant amplitude_squared = square(t.amplitude);
  const Constant phase_squared = square(t.phase);
  form.size = {amplitude_squared * square(a_axis) + phase_squared * square(chi_axis),
               amplitude_squared * a_axis * a_other + phase_squared * chi_axis * chi_other,
               t.phase * chi_axis * tn2,
               amplitude_squared * square(a_other) + phase_squared * square(chi_other),
               t.phase * chi_other * tn2,
               square(tn2) + square(t.frequency)};

  const auto [beta_sine, beta_cosine] = sin_cos(ray.beta);
  const Scalar a = ray.scale * (setting.largest_amplitude * beta_cosine);
  const Scalar chi = ray.scale * (setting.largest_chi * beta_sine);
  result.correction = correction_at(setting, a, chi);
  const Correction<Constant, Scalar>& correction = result.correction;
  const GainSpread<Scalar>& gains = correction.gains;
  const MeanCorrection<Scalar>& mean = correction.mean;
  form.spread = {gains.spread.p11, gains.spread.p22};
  form.innovation = {mean.innovation(a_axis, chi_axis), mean.innovation(a_other, chi_other)};
  form.centre = {mean.step(t, form.innovation[0]), mean.step(t, form.innovation[1])};
  form.mean_real = detail::value_of(mean.real);
  form.least_along = correction.least_along;
  form.reach = correction.reach;
  return result;
}

/// The form of a step, where the correction lies where the ray says.
template <typename Constant, typename Scalar>
[[nodiscard]] PolarStepForm<Constant, Scalar> form_where(const StepWithCorrection<Constant, Scalar>& step,
                                                         const StepSetting<Constant>& setting,
                                                         const RayCell<Constant, Scalar>& ray) {
  const BlockMetric<Constant>& t = setting.metric;
  const Correction<Constant, Scalar>& correction = step.correction;
  const GainSpread<Scalar>& gains = correction.gains;
  PolarStepForm<Constant, Scalar> form = step.form;
  const std::array<Scalar, 4> b = averaged_jacobian(
      t, correction.z1, correction.z2, Scalar(ray.along * ray.reach[0]), Scalar(ray.across * ray.reach[1]));
  const Scalar none(0.0);
  form.gain = {{{b[0] * gains.mean_amplitude, b[2] * gains.mean_amplitude, none},
                {b[1] * gains.mean_phase, b[3] * gains.mean_phase + t.coupling * gains.mean_frequency,
                 t.frequency * gains.mean_frequency}}};
  form.gram = gram(t, b, gains.spread, setting.design.r);
  return form;
}

/// The form at a point, or over a cell. Over intervals it means something only if `least_along` and
/// `mean_real` are certainly positive: see Correction.
template <typename Constant, typename Scalar>
[[nodiscard]] PolarStepForm<Constant, Scalar> polar_step_form(const StepSetting<Constant>& setting,
                                                              const RayCell<Constant, Scalar>& ray) {
  return form_where(step_with_correction(setting, ray), setting, ray);
}

}  // namespace veritrack::quadrature
