// The matrix whose definiteness is the drift inequality at a point, docs/gaussian.md (6), in coordinates in
// which the metric is the identity.
//
// The noise is Gaussian with variance sigma^2 a channel, the frequency walks with variance w^2 a sample, and
// M = T'T. For one image Psi of the covariance, with M_t = (M^-1 - w^2 e3 e3')^-1,
//     E exp(|T e+|^2/2) = det(I - Sigma M)^(-1/2) exp(m'(M^-1 - Sigma)^-1 m / 2),
//     Sigma = sigma^2 K K' + w^2 e3 e3'.
// So the inequality asks for m'(M^-1 - Sigma)^-1 m <= l, l = |T e|^2 + gamma (s^2 - t^2) - d + core, where t
// is a level of the image, d >= -log det(I - Sigma M), and core = 2 log(1 + c_0 / W). By Schur complements it
// holds for every Psi between Psi_lo and Psi_hi (Petersen's lemma, any multiplier mu > 0) when
//     [ I - mu sigma^2 Z'Delta Z/r^2,   .  ,                                .                   ]
//     [ sigma T K,                      I - w^2 t3 t3' - T Delta T'/mu,     .                   ]
//     [ mu sigma (Z'Delta Z p)'/r^2,    (T m)',                    l - mu p'Z'Delta Z p/r^2     ]   > 0,
// m and K at the mean image, Z = H', p the prediction's error, t3 = T e3. For the step of the program, which
// rounds, I - ... is (1 - eta) I - ... (docs/gaussian.md, section 7).
#pragma once

#include <algorithm>

#include "analysis/quadrature/gaussian/level_step.hpp"

namespace veritrack::quadrature {

template <typename Scalar>
using DriftForm = rigor::LowerTriangle<6, Scalar>;
/// Its rows: the noise (2), T e+ (3), and the rest.
enum DriftRow : std::size_t { kNoise = 0, kError = 2, kLeft = 5 };

/// T (v1, v2, v3)'.
template <typename Constant, typename Scalar>
[[nodiscard]] std::array<Scalar, 3> image(const BlockMetric<Constant>& t, const Scalar& v1, const Scalar& v2,
                                          const Scalar& v3) {
  return {v1 * t.amplitude, v2 * t.phase + v3 * t.coupling, v3 * t.frequency};
}

/// T X T' of a symmetric X.
template <typename Constant, typename Scalar>
[[nodiscard]] SymmetricMatrix<Scalar> transformed(const BlockMetric<Constant>& t,
                                                  const SymmetricMatrix<Scalar>& x) {
  const Scalar row2 = x[1][1] * t.phase + x[2][1] * t.coupling;
  const Scalar row3 = x[2][1] * t.phase + x[2][2] * t.coupling;
  const Scalar none(0.0);
  return {
      {{x[0][0] * (t.amplitude * t.amplitude), none, none},
       {(x[1][0] * t.phase + x[2][0] * t.coupling) * t.amplitude, row2 * t.phase + row3 * t.coupling, none},
       {x[2][0] * (t.amplitude * t.frequency), row3 * t.frequency, x[2][2] * (t.frequency * t.frequency)}}};
}

/// The images at the level s + away, bounded by their tangents.
template <typename Scalar>
struct LevelImages {
  SymmetricMatrix<Scalar> mean, half_spread;  ///< (Psi_hi + Psi_lo)/2, (Psi_hi - Psi_lo)/2
  std::array<Scalar, 3> error;                ///< m - e_0 at the mean image
  std::array<Scalar, 2> prediction_error;
};
template <typename Constant, typename Scalar>
[[nodiscard]] LevelImages<Scalar> images_at(const LevelStep<Scalar>& step, const Constant& away,
                                            const Constant& r) {
  const SymmetricMatrix<Scalar> low = moved(step.lower.covariance, away, step.lower.slope);
  const SymmetricMatrix<Scalar> high = moved(step.upper.covariance, away, step.upper.slope);
  const Constant half(0.5);
  LevelImages<Scalar> images;
  images.prediction_error = step.prediction_error;
  const Scalar none(0.0);
  const Constant share = half * away / r;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      images.mean[i][j] = j <= i ? Scalar((high[i][j] + low[i][j]) * half) : none;
      images.half_spread[i][j] = j <= i ? Scalar((high[i][j] - low[i][j]) * half) : none;
    }
    const auto slope = [&](std::size_t k) {
      const std::size_t row = std::max(i, k);
      const std::size_t column = std::min(i, k);
      return Scalar(step.lower.slope[row][column] + step.upper.slope[row][column]);
    };
    images.error[i] = (step.lower.mean[i] + step.upper.mean[i]) * half -
                      (slope(0) * step.prediction_error[0] + slope(1) * step.prediction_error[1]) * share;
  }
  return images;
}

/// The matrix at a point, or over a cell, for the multiplier mu and l = `left`.
template <typename Constant, typename Scalar>
[[nodiscard]] DriftForm<Scalar> drift_form(const LockSetting<Constant>& setting,
                                           const LevelImages<Scalar>& images, const Scalar& left,
                                           const Constant& multiplier) {
  using trackers::detail::square;
  const BlockMetric<Constant>& t = setting.metric;
  const Constant one(1.0);
  const Constant& deviation = setting.deviation;
  const Constant over_r = one / setting.design.r;
  const SymmetricMatrix<Scalar>& delta = images.half_spread;
  const SymmetricMatrix<Scalar> spread = transformed(t, delta);
  const auto& p = images.prediction_error;
  // Z'Delta Z p.
  const std::array<Scalar, 2> pulled{delta[0][0] * p[0] + delta[1][0] * p[1],
                                     delta[1][0] * p[0] + delta[1][1] * p[1]};
  const Constant by_error = multiplier * square(over_r);
  const Constant by_noise = by_error * deviation;
  const Constant by_both = by_noise * deviation;
  const Constant over_multiplier = one / multiplier;
  const std::array<Constant, 3> t3{Constant(0.0), t.coupling, t.frequency};
  const auto& away = setting.offset;
  const std::array<Scalar, 3> mean =
      image(t, Scalar(images.error[0] - away[0]), Scalar(images.error[1] - away[1]),
            Scalar(images.error[2] - away[2]));
  DriftForm<Scalar> form;
  for (auto& row : form) {
    row.fill(Scalar(0.0));
  }
  form[0][0] = one - delta[0][0] * by_both;
  form[1][0] = -(delta[1][0] * by_both);
  form[1][1] = one - delta[1][1] * by_both;
  const Constant gain_share = deviation * over_r;
  for (std::size_t k = 0; k < 2; ++k) {
    // A column of sigma T K.
    const auto entry = [&](std::size_t i) {
      const std::size_t row = std::max(i, k);
      const std::size_t column = std::min(i, k);
      return Scalar(images.mean[row][column] * gain_share);
    };
    const std::array<Scalar, 3> gain = image(t, entry(0), entry(1), entry(2));
    for (std::size_t i = 0; i < 3; ++i) {
      form[kError + i][k] = gain[i];
    }
    form[kLeft][k] = pulled[k] * by_noise;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      // The next metric is M/(1 - eta): room for what rounding adds to the error.
      const Constant unit =
          Constant(i == j ? 1.0 - kRoundingRoom : 0.0) - setting.walk_variance * t3[i] * t3[j];
      form[kError + i][kError + j] = unit - spread[i][j] * over_multiplier;
    }
    form[kLeft][kError + i] = mean[i];
  }
  form[kLeft][kLeft] = left - (p[0] * pulled[0] + p[1] * pulled[1]) * by_error;
  return form;
}

}  // namespace veritrack::quadrature
