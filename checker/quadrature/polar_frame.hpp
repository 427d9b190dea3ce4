// One step of the quadrature tracker, leak included, in the frame of the estimated phase: the checker's own
// implementation, from the equations of docs/contraction.md section 1 with F = ((1,0,0), (0,1,rho), (0,0,1 -
// epsilon)). Signals have amplitude 1.
#pragma once

#include <array>

#include "checker/numbers/slope.hpp"
#include "checker/theorems/design.hpp"

namespace veritrack::checker {

/// The entries of a symmetric matrix, amplitude, phase, frequency, in this order.
enum Entry : std::size_t { k11, k12, k13, k22, k23, k33 };
template <typename S>
using Symmetric = std::array<S, 6>;

template <typename S>
Symmetric<S> operator+(const Symmetric<S>& x, const Symmetric<S>& y) {
  return {x[0] + y[0], x[1] + y[1], x[2] + y[2], x[3] + y[3], x[4] + y[4], x[5] + y[5]};
}
template <typename S, typename Factor>
Symmetric<S> scaled(const Factor& factor, const Symmetric<S>& x) {
  return {factor * x[0], factor * x[1], factor * x[2], factor * x[3], factor * x[4], factor * x[5]};
}

/// F(rho) Y F(rho)'.
template <typename S, typename Y>
Symmetric<S> carried(const Symmetric<Y>& y, const S& rho, const Ball& retention) {
  const S p23 = y[k23] + rho * y[k33];
  return {S(y[k11]),       y[k12] + rho * y[k13],        S(retention * y[k13]), y[k22] + rho * (y[k23] + p23),
          retention * p23, S(square(retention) * y[k33])};
}

/// K = P H' (H P H' + r)^-1 of a predicted covariance: rows amplitude, phase, frequency.
template <typename S>
using Gain = std::array<std::array<S, 2>, 3>;

template <typename S>
Gain<S> gain_of(const Symmetric<S>& p, const Ball& r) {
  const S s11 = p[k11] + r;
  const S s22 = p[k22] + r;
  const S over = reciprocal(s11 * s22 - square(p[k12]));
  const S k1 = one - r * (s22 * over);
  const S k2 = one - r * (s11 * over);
  const S k = r * (p[k12] * over);
  return {
      {{k1, k}, {k, k2}, {(p[k13] * s22 - p[k23] * p[k12]) * over, (p[k23] * s11 - p[k13] * p[k12]) * over}}};
}

/// (I - K H) M (I - L H)', where that is symmetric.
template <typename S>
Symmetric<S> corrected(const Gain<S>& k, const Symmetric<S>& m, const Gain<S>& l) {
  const auto row = [&](std::size_t i, const S& first, const S& second, const S& own) {
    return own - k[i][0] * first - k[i][1] * second;
  };
  const std::array<std::array<S, 3>, 3> left{
      {{row(0, m[k11], m[k12], m[k11]), row(0, m[k12], m[k22], m[k12]), row(0, m[k13], m[k23], m[k13])},
       {row(1, m[k11], m[k12], m[k12]), row(1, m[k12], m[k22], m[k22]), row(1, m[k13], m[k23], m[k23])},
       {row(2, m[k11], m[k12], m[k13]), row(2, m[k12], m[k22], m[k23]), row(2, m[k13], m[k23], m[k33])}}};
  const auto entry = [&](std::size_t i, std::size_t j) {
    return left[i][j] - left[i][0] * l[j][0] - left[i][1] * l[j][1];
  };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

/// U P U' - P for U = diag(Rot(angle), 1), given sin(angle) and cos(angle) - 1, or all three over the same
/// number.
template <typename S>
Symmetric<S> turned_difference(const Symmetric<S>& p, const S& sine, const S& less, const S& sine_itself) {
  // cos(2 angle) - 1 = -2 sin^2, sin(2 angle) = 2 sin cos, cos = 1 + less.
  const S versine = two * (sine * sine_itself);
  const S twice = two * (sine + less * sine_itself);
  const S deviator = half * (p[k11] - p[k22]);
  const S along = -(deviator * versine) - p[k12] * twice;
  return {along,  deviator * twice - p[k12] * versine, p[k13] * less - p[k23] * sine,
          -along, p[k13] * sine + p[k23] * less,       S(zero)};
}

/// U P U' with the angle given.
template <typename S>
Symmetric<S> turned(const Symmetric<S>& p, const S& sine, const S& cosine) {
  return p + turned_difference(p, sine, S(cosine - one), sine);
}

/// (a, psi, nu, P): the whole state of the tracker, as its distance from the signal.
template <typename S>
struct PolarState {
  std::array<S, 3> error;
  Symmetric<S> covariance;
};

/// The next state, without noise, at a constant frequency. Balls of everything where the corrected estimate
/// may have turned by a right angle.
template <typename S>
PolarState<S> polar_step(const Design& design, const PolarState<S>& x, const S& omega) {
  const Ball retention = one - design.epsilon;
  const S rho = x.error[0] + one;
  const S chi = x.error[1] + x.error[2];
  Symmetric<S> predicted = carried(x.covariance, rho, retention);
  predicted[k11] = predicted[k11] + design.q1;
  predicted[k22] = predicted[k22] + design.q1;
  predicted[k33] = predicted[k33] + design.q2;
  const Gain<S> k = gain_of(predicted, design.r);
  const std::array<S, 2> i{cos(chi) - rho, -sin(chi)};
  const S z1 = rho + k[0][0] * i[0] + k[0][1] * i[1];
  const S z2 = k[1][0] * i[0] + k[1][1] * i[1];
  const S length = sqrt(square(z1) + square(z2));
  const S tangent = z2 / z1;
  const Symmetric<S> filtered{
      design.r * k[0][0], design.r * k[0][1],
      design.r * k[2][0], design.r * k[1][1],
      design.r * k[2][1], predicted[k33] - k[2][0] * predicted[k13] - k[2][1] * predicted[k23]};
  const S turn =
      certainly_positive(value_of(z1)) ? tangent * arctangent_over(tangent) : S(Ball::everything());
  return {{length - one, chi + turn,
           retention * x.error[2] - design.epsilon * omega + k[2][0] * i[0] + k[2][1] * i[1]},
          turned(filtered, S(-z2 / length), S(z1 / length))};
}

}  // namespace veritrack::checker
