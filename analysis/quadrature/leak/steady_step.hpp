// One step of the errors about the steady state, divided by their level: what decides whether it contracts.
//
// With a leak the tracker settles at X* = (e*, P*), off the truth. Let e = e* + s b, b = (alpha, c - m, m),
// where c belongs to the predicted phase error chi = psi + nu, and P between P* - s below and P* + s above.
// All vectors in the plane are seen in the frame of steady_gain.hpp, in which the corrected estimate of the
// steady state is rho* > 0. Every difference to the steady step is written as s times something, with exact
// secant slopes, so that no linearization error appears. The covariance acts through a ball: P+ = P* + s
// (mean + D Y D'), D D' = spread, |Y| <= 1, so that
//     (e+ - e*)/s = constant + slope b + J D y / r,     |y|^2 <= eta^2 = i' spread i,
// i the innovation, J the Jacobian of (|z|, arg z, x3) averaged between the two corrected estimates.
// docs/leak.md, sections 3 and 4.
//
// The template runs on double, to propose, and on secants over intervals (secant.hpp), to prove.
#pragma once

#include <array>
#include <cstddef>

#include "analysis/quadrature/leak/steady_setting.hpp"
#include "analysis/rigor/elementary_ratios.hpp"

namespace veritrack::quadrature {

/// Where in the set: errors of level s with this (alpha, c).
template <typename Scalar>
struct SteadyPlace {
  Scalar level;  ///< s > 0
  Scalar x, y;   ///< alpha = a11 x, c = a21 x + a22 y, x^2 + y^2 <= 1
};

/// The smooth part of a step, divided by s, as it is under the mean gain.
template <typename Scalar>
struct SteadyStep {
  std::array<Scalar, 9> slope;     ///< T slope T^-1, row by row
  std::array<Scalar, 3> constant;  ///< T constant
  Symmetric<Scalar> gram;          ///< T J spread J' T' / r^2, J at the z that the mean gain leaves
  std::array<Scalar, 6> noise;     ///< T J K, row by row, for the mean gain K
  Scalar eta_squared;
  Scalar spread11, spread12, spread22;     ///< of the spread
  Scalar largest11, largest12, largest22;  ///< the largest gain of z
  Scalar alpha;
  Scalar swing;           ///< s c, rad
  Scalar shift1, shift2;  ///< (z - rho*)/s for the z that the mean gain leaves, in the frame of the estimate
  Scalar along;           ///< its component along the steady one in the frame of the true phase
  Symmetric<Scalar> low, high;  ///< bounds on (Phi - P*)/s, Phi the covariance before the turn

  static constexpr std::size_t kEntries = 36;
  /// All but the last two, for what is done to each.
  [[nodiscard]] std::array<Scalar*, kEntries> entries() {
    return {&slope[0],    &slope[1], &slope[2], &slope[3],    &slope[4],    &slope[5],
            &slope[6],    &slope[7], &slope[8], &constant[0], &constant[1], &constant[2],
            &gram.p11,    &gram.p12, &gram.p13, &gram.p22,    &gram.p23,    &gram.p33,
            &noise[0],    &noise[1], &noise[2], &noise[3],    &noise[4],    &noise[5],
            &eta_squared, &spread11, &spread12, &spread22,    &largest11,   &largest12,
            &largest22,   &alpha,    &swing,    &shift1,      &shift2,      &along};
  }
};

namespace detail {

/// A plane vector, or rather three: what belongs to 1, to alpha and to c.
template <typename Scalar>
struct PlaneForm {
  std::array<Scalar, 3> first, second;
};

}  // namespace detail

/// See SteadyStep.
template <typename Scalar>
[[nodiscard]] SteadyStep<Scalar> steady_step(const SteadySetting<Scalar>& setting,
                                             const SteadyPlace<Scalar>& place) {
  using std::sqrt;
  using trackers::detail::sin_cos;
  using trackers::detail::square;
  const Scalar zero(0.0);
  const Scalar one(1.0);
  const auto& t = setting.metric;
  const Scalar over_r = one / setting.design.r;
  const Scalar& s = place.level;
  const Scalar& rho = setting.steady.rho;
  SteadyStep<Scalar> step;
  step.alpha = setting.a11 * place.x;
  const Scalar c = setting.a21 * place.x + setting.a22 * place.y;

  // e^{i s c}, and the secant slope (e^{i s c} - 1) / (i s c) = e^{i s c / 2} sin(s c / 2) / (s c / 2).
  step.swing = s * c;
  const Scalar half_swing = Scalar(0.5) * step.swing;
  const auto [half_sine, half_cosine] = sin_cos(half_swing);
  const Scalar sine = Scalar(2.0) * half_sine * half_cosine;
  const Scalar cosine = one - Scalar(2.0) * square(half_sine);
  const Scalar ratio = rigor::sine_ratio(half_swing);

  // Divided difference of the innovation e^{-i (psi* + s c)} - rho e^{i nu*}: that of the signal is
  // -i c e^{-i (psi* + s c / 2)} ratio. Its steady value: e^{-i psi*} - rho* e^{i nu*}.
  const Scalar signal1 = -(ratio * (setting.sine_phase * half_cosine + setting.cosine_phase * half_sine));
  const Scalar signal2 = -(ratio * (setting.cosine_phase * half_cosine - setting.sine_phase * half_sine));
  const Scalar steady1 = setting.cosine_phase - rho * setting.cosine_turn;
  const Scalar steady2 = -setting.sine_phase - rho * setting.sine_turn;
  const std::array<Scalar, 3> slope1{zero, -setting.cosine_turn, signal1};
  const std::array<Scalar, 3> slope2{zero, -setting.sine_turn, signal2};
  const Scalar innovation1 = steady1 + s * (slope1[1] * step.alpha + signal1 * c);
  const Scalar innovation2 = steady2 + s * (slope2[1] * step.alpha + signal2 * c);

  const CovarianceImage<Scalar> image = covariance_image(
      setting.steady, setting.sine_turn, setting.cosine_turn, setting.band, setting.design, s, step.alpha);
  step.low = image.low;
  step.high = image.high;
  step.spread11 = image.spread.p11;
  step.spread12 = image.spread.p12;
  step.spread22 = image.spread.p22;
  step.eta_squared = step.spread11 * square(innovation1) + step.spread22 * square(innovation2) +
                     Scalar(2.0) * step.spread12 * innovation1 * innovation2;
  step.largest11 = over_r * (setting.steady.covariance.p11 + s * image.high.p11);
  step.largest12 = over_r * (setting.steady.covariance.p12 + s * image.high.p12);
  step.largest22 = over_r * (setting.steady.covariance.p22 + s * image.high.p22);

  // The mean gain, and what it leaves of the innovation, as divided differences.
  const Symmetric<Scalar> mean =
      plus(setting.steady.covariance, plus(image.mean_of_band, image.mean_by_alpha, step.alpha), s);
  const Scalar k11 = over_r * mean.p11;
  const Scalar k12 = over_r * mean.p12;
  const Scalar k22 = over_r * mean.p22;
  const Scalar k31 = over_r * mean.p13;
  const Scalar k32 = over_r * mean.p23;
  const auto moved = [&](const Scalar& first, const Scalar& second) {
    return over_r * (first * steady1 + second * steady2);
  };
  const auto& by_band = image.mean_of_band;
  const auto& by_alpha = image.mean_by_alpha;
  const std::array<Scalar, 3> moved1{moved(by_band.p11, by_band.p12), moved(by_alpha.p11, by_alpha.p12),
                                     zero};
  const std::array<Scalar, 3> moved2{moved(by_band.p12, by_band.p22), moved(by_alpha.p12, by_alpha.p22),
                                     zero};
  const std::array<Scalar, 3> moved3{moved(by_band.p13, by_band.p23), moved(by_alpha.p13, by_alpha.p23),
                                     zero};

  // Of the corrected estimate times e^{i s c}, which is in the frame of the true phase, turned to be rho* in
  // the steady state: -e^{i s c} rest' - i c e^{i s c / 2} ratio rest*, rest* = e^{-i psi*} - rho*.
  const Scalar rest1 = setting.cosine_phase - rho;
  const Scalar rest2 = -setting.sine_phase;
  const std::array<Scalar, 3> true1{zero, zero, ratio * (half_sine * rest1 + half_cosine * rest2)};
  const std::array<Scalar, 3> true2{zero, zero, -(ratio * (half_cosine * rest1 - half_sine * rest2))};
  detail::PlaneForm<Scalar> delta;
  std::array<Scalar, 3> frequency;
  Scalar left1 = zero;  // rest' itself
  Scalar left2 = zero;
  const std::array<Scalar, 3> weights{one, step.alpha, c};
  for (std::size_t i = 0; i < 3; ++i) {
    const Scalar left_over1 = (one - k11) * slope1[i] - k12 * slope2[i] - moved1[i];
    const Scalar left_over2 = (one - k22) * slope2[i] - k12 * slope1[i] - moved2[i];
    left1 += weights[i] * left_over1;
    left2 += weights[i] * left_over2;
    delta.first[i] = true1[i] - cosine * left_over1 + sine * left_over2;
    delta.second[i] = true2[i] - sine * left_over1 - cosine * left_over2;
    frequency[i] = k31 * slope1[i] + k32 * slope2[i] + moved3[i];
  }
  const Scalar delta1 = delta.first[0] + delta.first[1] * step.alpha + delta.first[2] * c;
  const Scalar delta2 = delta.second[0] + delta.second[1] * step.alpha + delta.second[2] * c;
  // |p| - rho* and arg p for p = rho* + s delta, as secant slopes in delta.
  const Scalar real = rho + s * delta1;
  step.along = real;
  const Scalar tangent = s * delta2 / real;
  const Scalar over_lengths = one / (rho + real * sqrt(one + square(tangent)));
  const Scalar amplitude1 = (rho + real) * over_lengths;
  const Scalar amplitude2 = s * delta2 * over_lengths;
  const Scalar phase2 = rigor::arctangent_ratio(tangent) / real;

  // The slope in the errors (alpha, psi, nu), c = psi + nu, and T slope T^-1 by back substitution.
  const Scalar retention = one - setting.design.epsilon;
  for (std::size_t i = 0; i < 3; ++i) {
    const Scalar amplitude = amplitude1 * delta.first[i] + amplitude2 * delta.second[i];
    const Scalar phase = phase2 * delta.second[i];
    const std::array<Scalar, 3> image_row{t.t11 * amplitude + t.t12 * phase + t.t13 * frequency[i],
                                          t.t22 * phase + t.t23 * frequency[i], t.t33 * frequency[i]};
    for (std::size_t row = 0; row < 3; ++row) {
      if (i == 0) {
        step.constant[row] = image_row[row];
      } else {
        step.slope[3 * row + i - 1] = image_row[row];
      }
    }
  }
  const std::array<Scalar, 3> carried{t.t13 * retention, t.t23 * retention, t.t33 * retention};
  for (std::size_t row = 0; row < 3; ++row) {
    const Scalar by_amplitude = step.slope[3 * row] / t.t11;
    const Scalar by_chi = step.slope[3 * row + 1];
    const Scalar by_phase = (by_chi - by_amplitude * t.t12) / t.t22;
    step.slope[3 * row + 2] = (by_chi + carried[row] - by_amplitude * t.t13 - by_phase * t.t23) / t.t33;
    step.slope[3 * row] = by_amplitude;
    step.slope[3 * row + 1] = by_phase;
  }

  // The corrected estimate in the frame of the estimate, and T J there.
  step.shift1 = signal1 * c - left1;
  step.shift2 = signal2 * c - left2;
  const Scalar z1 = rho + s * step.shift1;
  const Scalar z2 = s * step.shift2;
  const Scalar over_length = one / sqrt(square(z1) + square(z2));
  const Scalar radial1 = z1 * over_length;
  const Scalar radial2 = z2 * over_length;
  const Scalar turn1 = -(radial2 * over_length);
  const Scalar turn2 = radial1 * over_length;
  const std::array<std::array<Scalar, 3>, 3> b{
      {{t.t11 * radial1 + t.t12 * turn1, t.t11 * radial2 + t.t12 * turn2, t.t13},
       {t.t22 * turn1, t.t22 * turn2, t.t23},
       {zero, zero, t.t33}}};
  const Symmetric<Scalar>& m = image.spread;
  std::array<std::array<Scalar, 3>, 3> bm;
  for (std::size_t i = 0; i < 3; ++i) {
    bm[i] = {over_r * (b[i][0] * m.p11 + b[i][1] * m.p12 + b[i][2] * m.p13),
             over_r * (b[i][0] * m.p12 + b[i][1] * m.p22 + b[i][2] * m.p23),
             over_r * (b[i][0] * m.p13 + b[i][1] * m.p23 + b[i][2] * m.p33)};
    step.noise[2 * i] = b[i][0] * k11 + b[i][1] * k12 + b[i][2] * k31;
    step.noise[2 * i + 1] = b[i][0] * k12 + b[i][1] * k22 + b[i][2] * k32;
  }
  const auto entry = [&](std::size_t i, std::size_t j) {
    return over_r * (bm[i][0] * b[j][0] + bm[i][1] * b[j][1] + bm[i][2] * b[j][2]);
  };
  step.gram = {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
  return step;
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
