// The parts of a step about the steady state (steady_step.hpp), in the order in which they are made: the
// swing of the phase, the innovation, the mean gain, the error after its correction, and T times each.
#pragma once

#include <array>
#include <cstddef>

#include "analysis/quadrature/leak/steady_setting.hpp"
#include "analysis/rigor/elementary_ratios.hpp"

namespace veritrack::quadrature::detail {

/// The coefficients of 1, alpha and c.
template <typename Scalar>
using Form = std::array<Scalar, 3>;

/// A plane vector, or rather three.
template <typename Scalar>
struct PlaneForm {
  Form<Scalar> first, second;
};

/// e^{i s c}, and the secant slope (e^{i s c} - 1) / (i s c) = e^{i s c / 2} sin(s c / 2) / (s c / 2).
template <typename Scalar>
struct Swing {
  Scalar angle;  ///< s c, rad
  Scalar half_sine, half_cosine, sine, cosine;
  Scalar ratio;  ///< sin(s c / 2) / (s c / 2)
};

template <typename Scalar>
[[nodiscard]] Swing<Scalar> swing_of(const Scalar& level, const Scalar& c) {
  using trackers::detail::sin_cos;
  using trackers::detail::square;
  Swing<Scalar> swing;
  swing.angle = level * c;
  const Scalar half_swing = Scalar(0.5) * swing.angle;
  const auto [half_sine, half_cosine] = sin_cos(half_swing);
  swing.half_sine = half_sine;
  swing.half_cosine = half_cosine;
  swing.sine = Scalar(2.0) * half_sine * half_cosine;
  swing.cosine = Scalar(1.0) - Scalar(2.0) * square(half_sine);
  swing.ratio = rigor::sine_ratio(half_swing);
  return swing;
}

/// The innovation: its steady value, e^{-i psi*} - rho* e^{i nu*}, its divided difference and its value.
template <typename Scalar>
struct InnovationForm {
  Scalar steady1, steady2;
  PlaneForm<Scalar> slope;
  Scalar value1, value2;
};

/// The form of e^{-i (psi* + s c)} - rho e^{i nu*}: the divided difference of the signal is -i c e^{-i (psi*
/// + s c / 2)} ratio.
template <typename Scalar>
[[nodiscard]] InnovationForm<Scalar> innovation_of(const SteadySetting<Scalar>& setting,
                                                   const Swing<Scalar>& swing, const Scalar& level,
                                                   const Scalar& alpha, const Scalar& c) {
  const Scalar zero(0.0);
  const Scalar& rho = setting.steady.rho;
  const Scalar signal1 =
      -(swing.ratio * (setting.sine_phase * swing.half_cosine + setting.cosine_phase * swing.half_sine));
  const Scalar signal2 =
      -(swing.ratio * (setting.cosine_phase * swing.half_cosine - setting.sine_phase * swing.half_sine));
  InnovationForm<Scalar> form;
  form.steady1 = setting.cosine_phase - rho * setting.cosine_turn;
  form.steady2 = -setting.sine_phase - rho * setting.sine_turn;
  form.slope.first = {zero, -setting.cosine_turn, signal1};
  form.slope.second = {zero, -setting.sine_turn, signal2};
  form.value1 = form.steady1 + level * (form.slope.first[1] * alpha + signal1 * c);
  form.value2 = form.steady2 + level * (form.slope.second[1] * alpha + signal2 * c);
  return form;
}

/// The mean gain, and its divided difference times the steady innovation.
template <typename Scalar>
struct MeanGain {
  Scalar k11, k12, k22, k31, k32;
  Form<Scalar> moved1, moved2, moved3;
};

template <typename Scalar>
[[nodiscard]] MeanGain<Scalar> mean_gain_of(const SteadySetting<Scalar>& setting,
                                            const CovarianceImage<Scalar>& image,
                                            const InnovationForm<Scalar>& innovation, const Scalar& level,
                                            const Scalar& alpha, const Scalar& over_r) {
  const Scalar zero(0.0);
  const Symmetric<Scalar> mean =
      plus(setting.steady.covariance, plus(image.mean_of_band, image.mean_by_alpha, alpha), level);
  const auto moved = [&](const Scalar& first, const Scalar& second) {
    return over_r * (first * innovation.steady1 + second * innovation.steady2);
  };
  const auto& by_band = image.mean_of_band;
  const auto& by_alpha = image.mean_by_alpha;
  return {over_r * mean.p11,
          over_r * mean.p12,
          over_r * mean.p22,
          over_r * mean.p13,
          over_r * mean.p23,
          {moved(by_band.p11, by_band.p12), moved(by_alpha.p11, by_alpha.p12), zero},
          {moved(by_band.p12, by_band.p22), moved(by_alpha.p12, by_alpha.p22), zero},
          {moved(by_band.p13, by_band.p23), moved(by_alpha.p13, by_alpha.p23), zero}};
}

/// The error after the mean correction, as divided differences.
template <typename Scalar>
struct LeftForm {
  PlaneForm<Scalar> delta;  ///< of the corrected estimate, turned to be rho* in the steady state
  Form<Scalar> frequency;
  Scalar left1, left2;  ///< of the innovation
};

/// The form of the corrected estimate times e^{i s c}, which is in the frame of the true phase: -e^{i s c}
/// rest' - i c e^{i s c / 2} ratio rest*, rest* = e^{-i psi*} - rho*.
template <typename Scalar>
[[nodiscard]] LeftForm<Scalar> left_by(const MeanGain<Scalar>& gain, const SteadySetting<Scalar>& setting,
                                       const Swing<Scalar>& swing, const InnovationForm<Scalar>& innovation,
                                       const Form<Scalar>& weights) {
  const Scalar zero(0.0);
  const Scalar one(1.0);
  const Scalar rest1 = setting.cosine_phase - setting.steady.rho;
  const Scalar rest2 = -setting.sine_phase;
  const Form<Scalar> true1{zero, zero, swing.ratio * (swing.half_sine * rest1 + swing.half_cosine * rest2)};
  const Form<Scalar> true2{zero, zero,
                           -(swing.ratio * (swing.half_cosine * rest1 - swing.half_sine * rest2))};
  const auto& [slope1, slope2] = innovation.slope;
  LeftForm<Scalar> form;
  form.left1 = zero;
  form.left2 = zero;
  for (std::size_t i = 0; i < 3; ++i) {
    const Scalar left_over1 = (one - gain.k11) * slope1[i] - gain.k12 * slope2[i] - gain.moved1[i];
    const Scalar left_over2 = (one - gain.k22) * slope2[i] - gain.k12 * slope1[i] - gain.moved2[i];
    form.left1 += weights[i] * left_over1;
    form.left2 += weights[i] * left_over2;
    form.delta.first[i] = true1[i] - swing.cosine * left_over1 + swing.sine * left_over2;
    form.delta.second[i] = true2[i] - swing.sine * left_over1 - swing.cosine * left_over2;
    form.frequency[i] = gain.k31 * slope1[i] + gain.k32 * slope2[i] + gain.moved3[i];
  }
  return form;
}

/// |p| - rho* and arg p for p = rho* + s delta, as secant slopes in delta.
template <typename Scalar>
struct PolarSlopes {
  Scalar along;  ///< Re p
  Scalar amplitude1, amplitude2, phase2;
};

template <typename Scalar>
[[nodiscard]] PolarSlopes<Scalar> polar_slopes(const PlaneForm<Scalar>& delta, const Scalar& rho,
                                               const Scalar& level, const Scalar& alpha, const Scalar& c) {
  using std::sqrt;
  using trackers::detail::square;
  const Scalar one(1.0);
  const Scalar delta1 = delta.first[0] + delta.first[1] * alpha + delta.first[2] * c;
  const Scalar delta2 = delta.second[0] + delta.second[1] * alpha + delta.second[2] * c;
  const Scalar real = rho + level * delta1;
  const Scalar tangent = level * delta2 / real;
  const Scalar over_lengths = one / (rho + real * sqrt(one + square(tangent)));
  return {real, (rho + real) * over_lengths, level * delta2 * over_lengths,
          rigor::arctangent_ratio(tangent) / real};
}

/// T times the next error for t = 0, the part that does not enter (alpha, c): its frequency error m changes
/// only by the leak.
template <typename Scalar>
[[nodiscard]] std::array<Scalar, 3> image_of(const SteadySetting<Scalar>& setting,
                                             const LeftForm<Scalar>& left, const PolarSlopes<Scalar>& polar,
                                             const Form<Scalar>& weights, const Scalar& m) {
  const auto& t = setting.metric;
  const auto total = [&](const Form<Scalar>& form) -> Scalar {
    return form[0] * weights[0] + form[1] * weights[1] + form[2] * weights[2];
  };
  const Scalar delta1 = total(left.delta.first);
  const Scalar delta2 = total(left.delta.second);
  const Scalar amplitude = polar.amplitude1 * delta1 + polar.amplitude2 * delta2;
  const Scalar phase = polar.phase2 * delta2;
  const Scalar frequency = total(left.frequency) + (Scalar(1.0) - setting.design.epsilon) * m;
  return {t.t11 * amplitude + t.t12 * phase + t.t13 * frequency, t.t22 * phase + t.t23 * frequency,
          t.t33 * frequency};
}

/// T J at the corrected estimate z, in the frame of the estimate.
template <typename Scalar>
using Jacobian = std::array<std::array<Scalar, 3>, 3>;

template <typename Scalar>
[[nodiscard]] Jacobian<Scalar> whitened_jacobian(const SteadySetting<Scalar>& setting, const Scalar& z1,
                                                 const Scalar& z2) {
  using std::sqrt;
  using trackers::detail::square;
  const auto& t = setting.metric;
  const Scalar zero(0.0);
  const Scalar over_length = Scalar(1.0) / sqrt(square(z1) + square(z2));
  const Scalar radial1 = z1 * over_length;
  const Scalar radial2 = z2 * over_length;
  const Scalar turn1 = -(radial2 * over_length);
  const Scalar turn2 = radial1 * over_length;
  return {{{t.t11 * radial1 + t.t12 * turn1, t.t11 * radial2 + t.t12 * turn2, t.t13},
           {t.t22 * turn1, t.t22 * turn2, t.t23},
           {zero, zero, t.t33}}};
}

/// T J K, row by row, for the mean gain K.
template <typename Scalar>
[[nodiscard]] std::array<Scalar, 6> noise_of(const Jacobian<Scalar>& b, const MeanGain<Scalar>& gain) {
  std::array<Scalar, 6> noise;
  for (std::size_t i = 0; i < 3; ++i) {
    noise[2 * i] = b[i][0] * gain.k11 + b[i][1] * gain.k12 + b[i][2] * gain.k31;
    noise[2 * i + 1] = b[i][0] * gain.k12 + b[i][1] * gain.k22 + b[i][2] * gain.k32;
  }
  return noise;
}

/// T J spread J' T' / r^2.
template <typename Scalar>
[[nodiscard]] Symmetric<Scalar> gram_of(const Jacobian<Scalar>& b, const Symmetric<Scalar>& m,
                                        const Scalar& over_r) {
  Jacobian<Scalar> bm;
  for (std::size_t i = 0; i < 3; ++i) {
    bm[i] = {over_r * (b[i][0] * m.p11 + b[i][1] * m.p12 + b[i][2] * m.p13),
             over_r * (b[i][0] * m.p12 + b[i][1] * m.p22 + b[i][2] * m.p23),
             over_r * (b[i][0] * m.p13 + b[i][1] * m.p23 + b[i][2] * m.p33)};
  }
  const auto entry = [&](std::size_t i, std::size_t j) {
    return over_r * (bm[i][0] * b[j][0] + bm[i][1] * b[j][1] + bm[i][2] * b[j][2]);
  };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

}  // namespace veritrack::quadrature::detail
