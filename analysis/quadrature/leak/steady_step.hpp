// One step of the errors about the steady state, divided by their level: what decides whether it contracts.
//
// With a leak the tracker settles at X* = (e*, P*), with a bias. Let e = e* + s b, b = (alpha, c - m, m),
// where c belongs to the predicted phase error chi = psi + nu, and P between P* - s below and P* + s above.
// All vectors in the plane are seen in the frame of steady_gain.hpp, in which the corrected estimate of the
// steady state is rho* > 0. Every difference to the steady step is written as s times something, with exact
// secant slopes, so that no linearization error appears. The covariance acts through a ball: P+ = P* + s
// (mean + D Y D'), D D' = spread, |Y| <= 1, so that
//     (e+ - e*)/s = image + t hidden + J (D y / r + K v / s),     |y|^2 <= eta^2 = (i + v)' spread (i + v),
// i the innovation, K the mean gain, J the Jacobian of (|z|, arg z, x3) averaged between the two corrected
// estimates, t the part of the error that (alpha, c) do not see.
// docs/leak.md, sections 3 and 4.
//
// The template runs on double, to propose, and on secants over intervals (secant.hpp), to prove.
#pragma once

#include <array>
#include <cstddef>

#include "analysis/quadrature/leak/steady_setting.hpp"
#include "analysis/quadrature/leak/steady_step_parts.hpp"

namespace veritrack::quadrature {

/// Where in the set: errors of level s with this (alpha, c).
template <typename Scalar>
struct SteadyPlace {
  Scalar level;  ///< s > 0
  Scalar x, y;   ///< of SteadyDirections, x^2 + y^2 <= 1
};

/// T hidden: the effect of a unit of t, the part of the error that does not enter (alpha, c).
template <typename Scalar>
[[nodiscard]] std::array<Scalar, 3> hidden_image(const SteadySetting<Scalar>& setting) {
  const Scalar kept = (Scalar(1.0) - setting.design.epsilon) * setting.directions.m3;
  return {setting.metric.t13 * kept, setting.metric.t23 * kept, setting.metric.t33 * kept};
}

/// The smooth part of a step, divided by s, as it is under the mean gain.
template <typename Scalar>
struct SteadyStep {
  std::array<Scalar, 3> image;             ///< T image, of the error with t = 0
  Symmetric<Scalar> gram;                  ///< T J spread J' T' / r^2, J at the z that the mean gain leaves
  std::array<Scalar, 6> noise;             ///< T J K, row by row, for the mean gain K
  Scalar eta_squared;                      ///< without noise
  Scalar hidden_squared;                   ///< 1 - x^2 - y^2, which t^2 does not exceed
  Scalar spread11, spread12, spread22;     ///< of the spread
  Scalar largest11, largest12, largest22;  ///< the largest gain of z
  Scalar alpha;
  Scalar swing;           ///< s c, rad
  Scalar shift1, shift2;  ///< (z - rho*)/s for the z that the mean gain leaves, in the frame of the estimate
  Scalar along;           ///< its component along the steady one in the frame of the true phase
  Symmetric<Scalar> low, high;  ///< bounds on (Phi - P*)/s, Phi the covariance before the turn

  static constexpr std::size_t kEntries = 28;
  /// All but the last two, for what is done to each.
  [[nodiscard]] std::array<Scalar*, kEntries> entries() {
    return {&image[0],  &image[1],       &image[2], &gram.p11, &gram.p12, &gram.p13,  &gram.p22,
            &gram.p23,  &gram.p33,       &noise[0], &noise[1], &noise[2], &noise[3],  &noise[4],
            &noise[5],  &eta_squared,    &spread11, &spread12, &spread22, &largest11, &largest12,
            &largest22, &hidden_squared, &alpha,    &swing,    &shift1,   &shift2,    &along};
  }
};

namespace detail {

/// The effect of a step on covariance and error, before the metric.
template <typename Scalar>
struct StepForms {
  Form<Scalar> weights;  ///< 1, alpha and c
  Swing<Scalar> swing;
  InnovationForm<Scalar> innovation;
  CovarianceImage<Scalar> image;
  MeanGain<Scalar> gain;
  LeftForm<Scalar> left;
  PolarSlopes<Scalar> polar;
};

template <typename Scalar>
[[nodiscard]] StepForms<Scalar> step_forms(const SteadySetting<Scalar>& setting,
                                           const SteadyPlace<Scalar>& place,
                                           const CovarianceImage<Scalar>& image) {
  const Scalar over_r = Scalar(1.0) / setting.design.r;
  const Scalar& s = place.level;
  const SteadyDirections<Scalar>& d = setting.directions;
  const Scalar alpha = d.a11 * place.x;
  const Scalar c = d.a21 * place.x + d.a22 * place.y;
  StepForms<Scalar> forms;
  forms.weights = {Scalar(1.0), alpha, c};
  forms.swing = swing_of(s, c);
  forms.innovation = innovation_of(setting, forms.swing, s, alpha, c);
  forms.image = image;
  forms.gain = mean_gain_of(setting, forms.image, forms.innovation, s, alpha, over_r);
  forms.left = left_by(forms.gain, setting, forms.swing, forms.innovation, forms.weights);
  forms.polar = polar_slopes(forms.left.delta, setting.steady.rho, s, alpha, c);
  return forms;
}

}  // namespace detail

/// The effect of a step on the covariance, which depends only on the level and on x.
template <typename Scalar>
[[nodiscard]] CovarianceImage<Scalar> covariance_image(const SteadySetting<Scalar>& setting,
                                                       const Scalar& level, const Scalar& x) {
  return covariance_image(setting.steady, setting.sine_turn, setting.cosine_turn, setting.band,
                          setting.design, level, Scalar(setting.directions.a11 * x));
}

/// See SteadyStep; `image` is the covariance_image of the place.
template <typename Scalar>
[[nodiscard]] SteadyStep<Scalar> steady_step(const SteadySetting<Scalar>& setting,
                                             const SteadyPlace<Scalar>& place,
                                             const CovarianceImage<Scalar>& covariance) {
  using trackers::detail::square;
  const Scalar over_r = Scalar(1.0) / setting.design.r;
  const Scalar& s = place.level;
  const Scalar& rho = setting.steady.rho;
  const SteadyDirections<Scalar>& d = setting.directions;
  const detail::StepForms<Scalar> forms = detail::step_forms(setting, place, covariance);
  const auto& [weights, swing, innovation, image, gain, left, polar] = forms;
  SteadyStep<Scalar> step;
  step.alpha = weights[1];
  step.hidden_squared = Scalar(1.0) - square(place.x) - square(place.y);
  step.swing = swing.angle;
  step.low = image.low;
  step.high = image.high;
  step.spread11 = image.spread.p11;
  step.spread12 = image.spread.p12;
  step.spread22 = image.spread.p22;
  step.eta_squared = step.spread11 * square(innovation.value1) + step.spread22 * square(innovation.value2) +
                     Scalar(2.0) * step.spread12 * innovation.value1 * innovation.value2;
  step.largest11 = over_r * (setting.steady.covariance.p11 + s * image.high.p11);
  step.largest12 = over_r * (setting.steady.covariance.p12 + s * image.high.p12);
  step.largest22 = over_r * (setting.steady.covariance.p22 + s * image.high.p22);
  step.along = polar.along;
  step.image = detail::image_of(setting, left, polar, weights, Scalar(d.m1 * place.x + d.m2 * place.y));

  // The corrected estimate in the frame of the estimate, and T J there.
  step.shift1 = innovation.slope.first[2] * weights[2] - left.left1;
  step.shift2 = innovation.slope.second[2] * weights[2] - left.left2;
  const detail::Jacobian<Scalar> jacobian =
      detail::whitened_jacobian<Scalar>(setting, rho + s * step.shift1, s * step.shift2);
  step.noise = detail::noise_of(jacobian, gain);
  step.gram = detail::gram_of(jacobian, image.spread, over_r);
  return step;
}

template <typename Scalar>
[[nodiscard]] SteadyStep<Scalar> steady_step(const SteadySetting<Scalar>& setting,
                                             const SteadyPlace<Scalar>& place) {
  return steady_step(setting, place, covariance_image(setting, place.level, place.x));
}

/// (P+ - P*)/s for both bounds on the covariance.
template <typename Scalar>
struct CovarianceStep {
  Symmetric<Scalar> low, high;
};

/// tan(turn - steady turn)/s under the mean gain.
template <typename Scalar>
[[nodiscard]] Scalar turn_tangent(const SteadySetting<Scalar>& setting, const SteadyStep<Scalar>& step,
                                  const Scalar& level) {
  return step.shift2 / (setting.steady.rho + level * step.shift1);
}

/// See CovarianceStep; `tangent` as of turn_tangent.
template <typename Scalar>
[[nodiscard]] CovarianceStep<Scalar> covariance_step(const SteadySetting<Scalar>& setting,
                                                     const SteadyStep<Scalar>& step, const Scalar& level,
                                                     const Scalar& tangent) {
  return {turned_deviation(setting.steady.covariance, step.low, level, tangent),
          turned_deviation(setting.steady.covariance, step.high, level, tangent)};
}

}  // namespace veritrack::quadrature
