// Covariances of the levels of a lock set: three by three, with the entries 12 and 13 only where there is a
// leak.
#pragma once

#include <array>

#include "analysis/quadrature/contraction/gain_spread.hpp"
#include "trackers/scalar_functions.hpp"

namespace veritrack::quadrature {

/// A symmetric matrix. Where it is `apart`, p12 and p13 are zero and no time is spent on them.
template <typename Scalar>
struct LevelCovariance {
  Scalar p11, p22, p23, p33;
  Scalar p12 = Scalar(0.0), p13 = Scalar(0.0);
  bool apart = true;
};

/// The same matrix over another scalar.
template <typename Scalar>
[[nodiscard]] LevelCovariance<Scalar> level_covariance(const LevelCovariance<double>& p) {
  const bool apart = p.p12 == 0.0 && p.p13 == 0.0;
  return {Scalar(p.p11), Scalar(p.p22), Scalar(p.p23), Scalar(p.p33), Scalar(p.p12), Scalar(p.p13), apart};
}
[[nodiscard]] inline LevelCovariance<double> level_covariance(const BlockCovariance<double>& p) {
  return {p.p11, p.p22, p.p23, p.p33};
}

/// p^-1.
template <typename Scalar>
[[nodiscard]] LevelCovariance<Scalar> inverse(const LevelCovariance<Scalar>& p) {
  using trackers::detail::square;
  const Scalar one(1.0);
  if (p.apart) {
    const Scalar reciprocal = one / (p.p22 * p.p33 - square(p.p23));
    return {one / p.p11, p.p33 * reciprocal, -(p.p23 * reciprocal), p.p22 * reciprocal};
  }
  const Scalar c11 = p.p22 * p.p33 - square(p.p23);
  const Scalar c12 = p.p13 * p.p23 - p.p12 * p.p33;
  const Scalar c13 = p.p12 * p.p23 - p.p13 * p.p22;
  const Scalar reciprocal = one / (p.p11 * c11 + p.p12 * c12 + p.p13 * c13);
  return {c11 * reciprocal,
          (p.p11 * p.p33 - square(p.p13)) * reciprocal,
          (p.p12 * p.p13 - p.p11 * p.p23) * reciprocal,
          (p.p11 * p.p22 - square(p.p12)) * reciprocal,
          c12 * reciprocal,
          c13 * reciprocal,
          false};
}

/// p + s d.
template <typename Constant, typename Scalar>
[[nodiscard]] LevelCovariance<Scalar> moved(const LevelCovariance<Constant>& p, const Scalar& s,
                                            const LevelCovariance<Constant>& d) {
  LevelCovariance<Scalar> result{p.p11 + s * d.p11, p.p22 + s * d.p22, p.p23 + s * d.p23, p.p33 + s * d.p33};
  result.apart = p.apart && d.apart;
  if (!result.apart) {
    result.p12 = p.p12 + s * d.p12;
    result.p13 = p.p13 + s * d.p13;
  }
  return result;
}

/// -x d x: the slope of lo(s) where it is x.
template <typename Scalar>
[[nodiscard]] LevelCovariance<Scalar> lower_slope(const LevelCovariance<Scalar>& x,
                                                  const LevelCovariance<Scalar>& d) {
  using trackers::detail::square;
  if (x.apart && d.apart) {
    const Scalar row2 = x.p22 * d.p22 + x.p23 * d.p23;
    const Scalar row3 = x.p22 * d.p23 + x.p23 * d.p33;
    const Scalar last2 = x.p23 * d.p22 + x.p33 * d.p23;
    const Scalar last3 = x.p23 * d.p23 + x.p33 * d.p33;
    return {-(square(x.p11) * d.p11), -(row2 * x.p22 + row3 * x.p23), -(row2 * x.p23 + row3 * x.p33),
            -(last2 * x.p23 + last3 * x.p33)};
  }
  const std::array<std::array<Scalar, 3>, 3> rows{
      {{x.p11, x.p12, x.p13}, {x.p12, x.p22, x.p23}, {x.p13, x.p23, x.p33}}};
  // The rows of d x.
  std::array<std::array<Scalar, 3>, 3> columns;
  for (std::size_t j = 0; j < 3; ++j) {
    const auto& [a, b, c] = rows[j];
    columns[j] = {d.p11 * a + d.p12 * b + d.p13 * c, d.p12 * a + d.p22 * b + d.p23 * c,
                  d.p13 * a + d.p23 * b + d.p33 * c};
  }
  const auto entry = [&](std::size_t i, std::size_t j) {
    return Scalar(-(rows[i][0] * columns[j][0] + rows[i][1] * columns[j][1] + rows[i][2] * columns[j][2]));
  };
  return {entry(0, 0), entry(1, 1), entry(1, 2), entry(2, 2), entry(0, 1), entry(0, 2), false};
}

}  // namespace veritrack::quadrature
