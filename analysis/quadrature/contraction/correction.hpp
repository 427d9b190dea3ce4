// The effect of a measurement update on the quadrature tracker's estimate, for any covariance between two
// bounds: the correction under the mean gain, and how far from it the correction can be.
#pragma once

#include <array>
#include <cmath>

#include "analysis/quadrature/contraction/gain_spread.hpp"
#include "analysis/quadrature/contraction/step_scalar.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/elementary_ratios.hpp"
#include "trackers/scalar_functions.hpp"

namespace veritrack::quadrature {

/// T = [[amplitude, 0, 0], [0, phase, coupling], [0, 0, frequency]].
template <typename Scalar>
struct BlockMetric {
  Scalar amplitude, phase, coupling, frequency;
};

/// The data common to all steps of a set.
template <typename Scalar>
struct StepSetting {
  trackers::ToneModel<Scalar> design;  ///< epsilon = 0
  BlockMetric<Scalar> metric;
  BlockCovariance<Scalar> covariance_lower, covariance_upper;
  Scalar largest_amplitude;  ///< A
  Scalar largest_chi;        ///< C, rad
  Scalar noise;              ///< V
};

/// The effect of the mean correction on the estimate, in the frame of the true phase.
template <typename Scalar>
struct MeanCorrection {
  Scalar sine, cosine;              ///< of chi
  Scalar cosine_slope, sine_slope;  ///< (1 - cos chi)/chi, (sin chi)/chi
  Scalar rest1, rest2, gain3;       ///< mean of 1 - K11 and 1 - K22, mean of K32
  Scalar real, imaginary;           ///< 1 + delta, the corrected z
  Scalar length, phase_slope;       ///< its |z|, and arg z / (imaginary / real)

  /// The innovation that errors (a, chi) make, along and across the prediction.
  template <typename Error>
  [[nodiscard]] std::array<Scalar, 2> innovation(const Error& a, const Error& chi) const {
    return {-(a + chi * cosine_slope), -(chi * sine_slope)};
  }
  /// delta = -e^{i chi} u of the innovation u.
  [[nodiscard]] std::array<Scalar, 2> left(const std::array<Scalar, 2>& i) const {
    const Scalar u1 = rest1 * i[0];
    const Scalar u2 = rest2 * i[1];
    return {u2 * sine - u1 * cosine, -(u1 * sine + u2 * cosine)};
  }
  /// T times the errors that are left, nu not counted.
  template <typename Constant>
  [[nodiscard]] std::array<Scalar, 3> step(const BlockMetric<Constant>& t,
                                           const std::array<Scalar, 2>& i) const {
    const Constant one(1.0);
    const std::array<Scalar, 2> delta = left(i);
    const Scalar amplitude = ((one + real) * delta[0] + imaginary * delta[1]) / (one + length);
    const Scalar phase = phase_slope * (delta[1] / real);
    const Scalar frequency = gain3 * i[1];
    return {t.amplitude * amplitude, t.phase * phase + t.coupling * frequency, t.frequency * frequency};
  }
};

/// How far from the mean correction the correction can be, along and across the prediction: the spread of the
/// gain, and the noise through a gain K_zz <= K_hi.
template <typename Constant>
[[nodiscard]] std::array<Constant, 2> correction_reach(const StepSetting<Constant>& setting,
                                                       const Constant& spread1, const Constant& spread2,
                                                       const Constant& largest_gain,
                                                       const std::array<Constant, 2>& innovation) {
  using trackers::detail::square;
  const Constant eta =
      detail::root(Constant(spread1 * square(innovation[0]) + spread2 * square(innovation[1]))) /
      setting.design.r;
  const Constant noise = largest_gain * setting.noise;
  return {detail::root(spread1) * eta + noise, detail::root(spread2) * eta + noise};
}

/// The correction of an estimate with amplitude error a and predicted phase error chi (rad). Over intervals
/// it means something only if `least_along` and the mean correction's real part are certainly positive. Then
/// the corrected estimate stays in the half plane around the prediction, where |z| and arg z are smooth; and
/// the phase error after the mean correction, chi + arg z in (-pi/2, 3 + pi/2), is the principal arg(1 +
/// delta) in
/// (-pi/2, pi/2) itself, because the two differ by a multiple of 2 pi. (chi <= 3, beyond which the ratios are
/// empty.)
template <typename Constant, typename Scalar>
struct Correction {
  GainSpread<Scalar> gains;
  MeanCorrection<Scalar> mean;
  Scalar z1, z2;                  ///< corrected by the mean gain, along and across the prediction
  std::array<Constant, 2> reach;  ///< correction_reach
  Constant least_along;           ///< lower bound on the component of the corrected z along the prediction
  Constant turn_tangent;          ///< bound on |tan| of the turn of the estimate
};

/// The errors before a correction: all quantities that do not depend on the covariance.
template <typename Scalar>
struct ErrorGeometry {
  Scalar amplitude;                 ///< a
  Scalar sine, cosine;              ///< of chi
  Scalar cosine_slope, sine_slope;  ///< (1 - cos chi)/chi, (sin chi)/chi
  std::array<Scalar, 2> innovation;
};
template <typename Scalar>
[[nodiscard]] ErrorGeometry<Scalar> geometry_of(const Scalar& a, const Scalar& chi) {
  using rigor::cosine_ratio;
  using rigor::sine_ratio;
  using trackers::detail::sin_cos;
  ErrorGeometry<Scalar> result;
  result.amplitude = a;
  const auto [sine, cosine] = sin_cos(chi);
  result.sine = sine;
  result.cosine = cosine;
  result.cosine_slope = chi * cosine_ratio(chi);
  result.sine_slope = sine_ratio(chi);
  result.innovation = {-(a + chi * result.cosine_slope), -(chi * result.sine_slope)};
  return result;
}

/// The turn of the estimate: the first half of correction_at, of which `mean` gets its gains only.
template <typename Constant, typename Scalar>
[[nodiscard]] Correction<Constant, Scalar> turn_at(const StepSetting<Constant>& setting,
                                                   const ErrorGeometry<Scalar>& errors) {
  using detail::value_of;
  const Constant one(1.0);
  Correction<Constant, Scalar> result;
  result.gains = gain_spread(setting.covariance_lower, setting.covariance_upper,
                             Scalar(one + errors.amplitude), setting.design);
  const GainSpread<Scalar>& gains = result.gains;
  MeanCorrection<Scalar>& mean = result.mean;
  mean.rest1 = gains.rest_amplitude;
  mean.rest2 = gains.rest_phase;
  mean.gain3 = gains.mean_frequency;
  const std::array<Scalar, 2>& innovation = errors.innovation;
  result.z1 = errors.cosine - mean.rest1 * innovation[0];
  result.z2 = -errors.sine - mean.rest2 * innovation[1];
  result.reach = correction_reach<Constant>(
      setting, value_of(gains.spread.p11), value_of(gains.spread.p22),
      detail::larger(value_of(gains.largest_amplitude), value_of(gains.largest_phase)),
      {value_of(innovation[0]), value_of(innovation[1])});
  result.least_along = value_of(result.z1) - result.reach[0];
  result.turn_tangent = (detail::size(value_of(result.z2)) + result.reach[1]) / result.least_along;
  return result;
}

template <typename Constant, typename Scalar>
[[nodiscard]] Correction<Constant, Scalar> correction_at(const StepSetting<Constant>& setting,
                                                         const Scalar& a, const Scalar& chi) {
  using rigor::arctangent_ratio;
  using std::sqrt;
  using trackers::detail::square;
  const Constant one(1.0);
  const ErrorGeometry<Scalar> errors = geometry_of(a, chi);
  Correction<Constant, Scalar> result = turn_at<Constant, Scalar>(setting, errors);
  MeanCorrection<Scalar>& mean = result.mean;
  mean.sine = errors.sine;
  mean.cosine = errors.cosine;
  mean.cosine_slope = errors.cosine_slope;
  mean.sine_slope = errors.sine_slope;
  const std::array<Scalar, 2> left = mean.left(errors.innovation);
  mean.real = one + left[0];
  mean.imaginary = left[1];
  const Scalar slope = mean.imaginary / mean.real;
  mean.length = mean.real * sqrt(one + square(slope));
  mean.phase_slope = arctangent_ratio(slope);
  return result;
}

}  // namespace veritrack::quadrature
