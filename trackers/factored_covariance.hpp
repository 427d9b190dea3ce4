// A 3x3 covariance in factors: how the extended Kalman filters of this folder keep P.
#pragma once

#include <Eigen/Core>

#include "trackers/scalar_functions.hpp"

namespace veritrack::trackers {

/// A symmetric positive semidefinite 3x3 matrix P = [[P_zz, P_z3], [P_z3', P_33]], kept as
///     P_33 = d,   P_z3 = d u,   P_zz = M + d u u':
/// the variance d of the frequency, the regression u of z on the frequency, and the covariance M of z given
/// the frequency. P is positive definite exactly when M is and d > 0, so definiteness is not a matter of
/// cancellation: a nearly singular P, such as the prediction from a huge P(0), keeps all digits of its small
/// eigenvalues.
template <typename Scalar>
struct FactoredCovariance {
  Scalar conditional_11, conditional_12, conditional_22;  ///< M, signal units squared
  Scalar regression_1, regression_2;                      ///< u, signal units per (rad/sample)
  Scalar frequency_variance;                              ///< d, (rad/sample)^2

  /// The factors of a 3x3 matrix, whose upper triangle alone is read. A frequency variance of exactly zero
  /// means that the frequency is known, and P_z3 is then taken to be zero too, as it must be in a
  /// semidefinite matrix.
  [[nodiscard]] static FactoredCovariance from_matrix(const Eigen::Matrix<Scalar, 3, 3>& matrix) {
    using detail::square;
    const Scalar p33 = matrix(2, 2);
    if (p33 == Scalar(0.0)) {
      return {matrix(0, 0), matrix(0, 1), matrix(1, 1), Scalar(0.0), Scalar(0.0), p33};
    }
    const Scalar p13 = matrix(0, 2);
    const Scalar p23 = matrix(1, 2);
    return {matrix(0, 0) - square(p13) / p33,
            matrix(0, 1) - p13 * p23 / p33,
            matrix(1, 1) - square(p23) / p33,
            p13 / p33,
            p23 / p33,
            p33};
  }

  /// P itself, symmetric to the last bit.
  [[nodiscard]] Eigen::Matrix<Scalar, 3, 3> matrix() const {
    using detail::square;
    const Scalar p13 = frequency_variance * regression_1;
    const Scalar p23 = frequency_variance * regression_2;
    const Scalar p12 = conditional_12 + p13 * regression_2;
    Eigen::Matrix<Scalar, 3, 3> result;
    result(0, 0) = conditional_11 + frequency_variance * square(regression_1);
    result(0, 1) = p12;
    result(0, 2) = p13;
    result(1, 0) = p12;
    result(1, 1) = conditional_22 + frequency_variance * square(regression_2);
    result(1, 2) = p23;
    result(2, 0) = p13;
    result(2, 1) = p23;
    result(2, 2) = frequency_variance;
    return result;
  }
};

/// U P U' with U = diag(Rot(angle), 1), the angle given as its sine and cosine.
template <typename Scalar>
[[nodiscard]] inline FactoredCovariance<Scalar> turned(const FactoredCovariance<Scalar>& p,
                                                       const Scalar& sine, const Scalar& cosine) {
  using detail::square;
  // A symmetric 2x2 matrix is its mean times I, which stays, plus a part that turns twice as fast.
  const Scalar sine_twice = (sine + sine) * cosine;
  const Scalar sine_squared = square(sine);
  const Scalar cosine_twice = Scalar(1.0) - (sine_squared + sine_squared);
  const Scalar mean = Scalar(0.5) * (p.conditional_11 + p.conditional_22);
  const Scalar half_difference = Scalar(0.5) * (p.conditional_11 - p.conditional_22);
  const Scalar turned_difference = half_difference * cosine_twice - p.conditional_12 * sine_twice;
  return {mean + turned_difference,
          half_difference * sine_twice + p.conditional_12 * cosine_twice,
          mean - turned_difference,
          p.regression_1 * cosine - p.regression_2 * sine,
          p.regression_1 * sine + p.regression_2 * cosine,
          p.frequency_variance};
}

/// The sum of two covariances, in factors. Every term that is added is one of a positive semidefinite matrix,
/// so that nothing cancels: for the variances d, d' and the regressions u, u' of the two, what their sum
/// leaves of z beyond M + M' is d d' / (d + d') (u - u')(u - u')'.
template <typename Scalar>
[[nodiscard]] inline FactoredCovariance<Scalar> sum(const FactoredCovariance<Scalar>& a,
                                                    const FactoredCovariance<Scalar>& b) {
  using detail::square;
  const Scalar variance = a.frequency_variance + b.frequency_variance;
  const Scalar m11 = a.conditional_11 + b.conditional_11;
  const Scalar m12 = a.conditional_12 + b.conditional_12;
  const Scalar m22 = a.conditional_22 + b.conditional_22;
  if (variance == Scalar(0.0)) {
    return {m11, m12, m22, Scalar(0.0), Scalar(0.0), variance};
  }
  const Scalar share = a.frequency_variance / variance;
  const Scalar difference_1 = a.regression_1 - b.regression_1;
  const Scalar difference_2 = a.regression_2 - b.regression_2;
  const Scalar spread = b.frequency_variance * share;
  return {m11 + spread * square(difference_1),   m12 + spread * difference_1 * difference_2,
          m22 + spread * square(difference_2),   b.regression_1 + share * difference_1,
          b.regression_2 + share * difference_2, variance};
}

}  // namespace veritrack::trackers
