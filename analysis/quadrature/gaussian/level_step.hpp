// One step of an estimate whose covariance is known up to a level: the pieces of the drift inequality.
//
// By Lemma 1 of docs/contraction.md a covariance of level s or less is mapped between the images Psi_lo,
// Psi_hi of lo(s) and hi(s), all in the frame of the true phase. The estimate's mean m and the noise's gain K
// are affine in the image Psi,
//     m = p - Psi Z p_z / r,   K = Psi Z / r,   Z = H',
// p the prediction's error, p_z = H p; so they are known at the mean image and spread with Delta = (Psi_hi -
// Psi_lo)/2. The noise enters linearly, and Psi does not depend on it.
//
// Psi_hi is concave in s and Psi_lo convex (docs/gaussian.md), so that the tangents at one s bound them from
// above and from below at every other.
//
// The template runs on double, to propose; on Interval, at the middle of a cell; and on intervals with
// derivatives, over the cell.
#pragma once

#include <array>

#include "analysis/quadrature/gaussian/lock_set.hpp"
#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/small_definiteness.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"

namespace veritrack::quadrature {

/// The design and a LockSet over a scalar.
template <typename Scalar>
struct LockSetting {
  trackers::ToneModel<Scalar> design;  ///< 0 <= epsilon < 1
  BlockMetric<Scalar> metric;
  LevelCovariance<Scalar> centre, centre_inverse, spread_above, spread_below;
  Scalar weight;          ///< gamma
  Scalar deviation;       ///< sigma
  Scalar noise_variance;  ///< sigma^2
  Scalar walk_variance;   ///< w^2
  /// With a leak: omega, in the middle of all; how far epsilon omega reaches from there; and e_0.
  Scalar frequency = Scalar(0.0);
  Scalar leak_reach = Scalar(0.0);
  std::array<Scalar, 3> bias{Scalar(0.0), Scalar(0.0), Scalar(0.0)};
  /// Subtracted from the next error in the form: T (e+ - offset).
  std::array<Scalar, 3> offset{Scalar(0.0), Scalar(0.0), Scalar(0.0)};
};

/// hi(s) and lo(s).
template <typename Constant, typename Scalar>
[[nodiscard]] LevelCovariance<Scalar> upper_covariance(const LockSetting<Constant>& setting,
                                                       const Scalar& s) {
  return moved(setting.centre, s, setting.spread_above);
}
template <typename Constant, typename Scalar>
[[nodiscard]] LevelCovariance<Scalar> lower_covariance(const LockSetting<Constant>& setting,
                                                       const Scalar& s) {
  return inverse(moved(setting.centre_inverse, s, setting.spread_below));
}

/// A symmetric 3x3 matrix, its lower triangle.
template <typename Scalar>
using SymmetricMatrix = rigor::LowerTriangle<3, Scalar>;

template <typename Scalar>
[[nodiscard]] SymmetricMatrix<Scalar> symmetric_of(const LevelCovariance<Scalar>& p) {
  const Scalar none(0.0);
  return {{{p.p11, none, none}, {p.p12, p.p22, none}, {p.p13, p.p23, p.p33}}};
}

/// x - y.
template <typename Scalar>
[[nodiscard]] SymmetricMatrix<Scalar> difference(const SymmetricMatrix<Scalar>& x,
                                                 const SymmetricMatrix<Scalar>& y) {
  const Scalar none(0.0);
  return {{{x[0][0] - y[0][0], none, none},
           {x[1][0] - y[1][0], x[1][1] - y[1][1], none},
           {x[2][0] - y[2][0], x[2][1] - y[2][1], x[2][2] - y[2][2]}}};
}

/// p + s d.
template <typename Scalar, typename Constant>
[[nodiscard]] SymmetricMatrix<Scalar> moved(const SymmetricMatrix<Scalar>& p, const Constant& s,
                                            const SymmetricMatrix<Scalar>& d) {
  const Scalar none(0.0);
  return {{{p[0][0] + d[0][0] * s, none, none},
           {p[1][0] + d[1][0] * s, p[1][1] + d[1][1] * s, none},
           {p[2][0] + d[2][0] * s, p[2][1] + d[2][1] * s, p[2][2] + d[2][2] * s}}};
}

/// The errors e of u = T e.
template <typename Constant, typename Scalar>
[[nodiscard]] std::array<Scalar, 3> errors_of(const BlockMetric<Constant>& t,
                                              const std::array<Scalar, 3>& u) {
  const Scalar frequency = u[2] / t.frequency;
  return {u[0] / t.amplitude, (u[1] - frequency * t.coupling) / t.phase, frequency};
}

/// The image of one covariance under a step, its derivative by the covariance, and m.
template <typename Scalar>
struct LevelImage {
  SymmetricMatrix<Scalar> covariance, slope;
  std::array<Scalar, 3> mean;
};

namespace detail {

/// U X U' for U = diag(Rot(angle), 1).
template <typename Scalar>
[[nodiscard]] SymmetricMatrix<Scalar> turned(const SymmetricMatrix<Scalar>& x, const Scalar& sine,
                                             const Scalar& cosine) {
  using trackers::detail::square;
  const Scalar sine_squared = square(sine);
  const Scalar cosine_twice = Scalar(1.0) - (sine_squared + sine_squared);
  const Scalar sine_twice = (sine + sine) * cosine;
  const Scalar half(0.5);
  const Scalar mean = half * (x[0][0] + x[1][1]);
  const Scalar half_difference = half * (x[0][0] - x[1][1]);
  const Scalar moved = half_difference * cosine_twice - x[1][0] * sine_twice;
  const Scalar none(0.0);
  return {{{mean + moved, none, none},
           {half_difference * sine_twice + x[1][0] * cosine_twice, mean - moved, none},
           {x[2][0] * cosine - x[2][1] * sine, x[2][0] * sine + x[2][1] * cosine, x[2][2]}}};
}

}  // namespace detail

/// The image of p at the errors e, with its derivative in the direction d: A d A', A = U (I - K H) F. The
/// formulas are those of trackers/quadrature/quadrature_rotating_frame.hpp for omega = 0, to which a
/// test ties them.
template <typename Constant, typename Scalar>
[[nodiscard]] LevelImage<Scalar> covariance_image(const trackers::ToneModel<Constant>& design,
                                                  const LevelCovariance<Constant>& p,
                                                  const LevelCovariance<Constant>& d,
                                                  const std::array<Scalar, 3>& e) {
  using trackers::detail::sin_cos;
  using trackers::detail::square;
  const Constant& r = design.r;
  const Constant retention = Constant(1.0) - design.epsilon;
  const Scalar none(0.0);
  const Scalar z1 = e[0] + Constant(1.0);
  const Scalar& z2 = e[1];
  const auto [sine, cosine] = sin_cos(e[2]);
  // F p F'.
  const auto predicted = [&](const LevelCovariance<Constant>& x) {
    const Scalar across = z1 * x.p33 + x.p23;
    SymmetricMatrix<Scalar> result{
        {{square(z2) * x.p33 + x.p11, none, none},
         {-(z2 * across), z1 * (across + x.p23) + x.p22, none},
         {-(z2 * (retention * x.p33)), across * retention, Scalar(x.p33 * square(retention))}}};
    if (!x.apart) {
      result[0][0] = result[0][0] - z2 * (x.p13 + x.p13);
      result[1][0] = result[1][0] + (z1 * x.p13 + x.p12);
      result[2][0] = result[2][0] + retention * x.p13;
    }
    return result;
  };
  const SymmetricMatrix<Scalar> before = predicted(p);
  const SymmetricMatrix<Scalar> change = predicted(d);
  const Constant noise = design.q1 + r;
  const Scalar s11 = before[0][0] + noise;
  const Scalar& s12 = before[1][0];
  const Scalar s22 = before[1][1] + noise;
  const Scalar reciprocal = Scalar(1.0) / (s11 * s22 - square(s12));
  const Scalar i11 = s22 * reciprocal;
  const Scalar i12 = -(s12 * reciprocal);
  const Scalar i22 = s11 * reciprocal;
  const auto weighted = [&](const Scalar& x, const Scalar& y) {
    return std::array<Scalar, 2>{i11 * x + i12 * y, i12 * x + i22 * y};
  };
  const std::array<Scalar, 2> gain = weighted(before[2][0], before[2][1]);
  const std::array<Scalar, 2> innovation = weighted(cosine - z1, -sine - z2);
  LevelImage<Scalar> image;
  image.mean = {-((innovation[0] * cosine - innovation[1] * sine) * r),
                -((innovation[0] * sine + innovation[1] * cosine) * r),
                e[2] * retention + before[2][0] * innovation[0] + before[2][1] * innovation[1]};
  const Constant r2 = square(r);
  image.covariance = detail::turned<Scalar>(
      {{{r - i11 * r2, none, none},
        {-(i12 * r2), r - i22 * r2, none},
        {gain[0] * r, gain[1] * r,
         before[2][2] + design.q2 - (before[2][0] * gain[0] + before[2][1] * gain[1])}}},
      sine, cosine);
  // (I - K H) change (I - K H)'.
  const std::array<Scalar, 2> pulled{change[0][0] * gain[0] + change[1][0] * gain[1],
                                     change[1][0] * gain[0] + change[1][1] * gain[1]};
  const std::array<Scalar, 2> column1 = weighted(change[0][0], change[1][0]);
  const std::array<Scalar, 2> column2 = weighted(change[1][0], change[1][1]);
  const std::array<Scalar, 2> last = weighted(change[2][0] - pulled[0], change[2][1] - pulled[1]);
  const auto row1 = weighted(column1[0], column2[0]);
  const auto row2 = weighted(column1[1], column2[1]);
  image.slope = detail::turned<Scalar>(
      {{{row1[0] * r2, none, none},
        {row2[0] * r2, row2[1] * r2, none},
        {last[0] * r, last[1] * r,
         change[2][2] - Scalar(2.0) * (change[2][0] * gain[0] + change[2][1] * gain[1]) +
             (pulled[0] * gain[0] + pulled[1] * gain[1])}}},
      sine, cosine);
  return image;
}

/// The images of lo(s) and hi(s) at errors e, with their slopes along s; and p_z.
template <typename Scalar>
struct LevelStep {
  LevelImage<Scalar> lower, upper;
  std::array<Scalar, 2> prediction_error;
};

/// At u = T e and the level s; `mean` is m - e_0.
template <typename Constant, typename Scalar>
[[nodiscard]] LevelStep<Scalar> level_step(const LockSetting<Constant>& setting,
                                           const std::array<Scalar, 3>& u, const Constant& s) {
  using trackers::detail::sin_cos;
  std::array<Scalar, 3> e = errors_of(setting.metric, u);
  for (std::size_t i = 0; i < 3; ++i) {
    e[i] = e[i] + setting.bias[i];
  }
  const LevelCovariance<Constant> low = lower_covariance(setting, s);
  LevelStep<Scalar> step;
  step.lower = covariance_image(setting.design, low, lower_slope(low, setting.spread_below), e);
  step.upper = covariance_image(setting.design, upper_covariance(setting, s), setting.spread_above, e);
  // The leak's pull on the frequency; the errors are differences from e_0.
  const Constant taken = setting.design.epsilon * setting.frequency;
  for (LevelImage<Scalar>* image : {&step.lower, &step.upper}) {
    for (std::size_t i = 0; i < 3; ++i) {
      image->mean[i] = image->mean[i] - (i == 2 ? setting.bias[i] + taken : setting.bias[i]);
    }
  }
  const auto [sine, cosine] = sin_cos(e[2]);
  const Scalar along = e[0] + Constant(1.0);
  step.prediction_error = {along * cosine - e[1] * sine - Constant(1.0), along * sine + e[1] * cosine};
  return step;
}

}  // namespace veritrack::quadrature
