// One sample of an EKF frequency tracker on a noise-free tone of constant frequency and amplitude 1: the
// checker's own implementation, from the recursion of the extended Kalman filter.
//
// The filter tracks z in C (two coordinates) and the frequency. In the frame that turns with the true phase
// the signal is (1, 0) at every sample, an estimate is (1 + delta, omega + nu), and the prediction turns by
// nu only:
//     z' = e^{i nu} (1 + delta),   nu' = (1 - epsilon) nu - epsilon omega,
// with the Jacobian [[Rot(nu), J z'], [0, 1 - epsilon]]. A channel measures the coordinate of the plane along
// a direction h, which turns backwards in this frame: h = (cos phi, -sin phi) for the real part at the true
// phase phi. Two channels with independent noise are two updates, one after the other.
#pragma once

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// Q = diag(q1, q1, q2), the noise variance and the leak of a tracker, at amplitude 1.
template <typename S>
struct TrackerValues {
  S q1, q2, r, epsilon;
};

constexpr std::size_t kToneStates = 9;

/// Re delta, Im delta, nu, then the lower triangle of P: 11, 21, 22, 31, 32, 33.
template <typename S>
using ToneState = std::array<S, kToneStates>;

inline std::pair<double, double> sine_cosine(double x) {
  return {std::sin(x), std::cos(x)};
}
inline double reciprocal(double x) {
  return 1.0 / x;
}
inline std::pair<Ball, Ball> sine_cosine(const Ball& x) {
  return {sin(x), cos(x)};
}

/// The state one sample later, at the true phase `phase`.
template <typename S>
ToneState<S> tone_step(const ToneState<S>& x, const S& frequency, const S& phase,
                       const TrackerValues<S>& values) {
  using Row = std::array<S, 3>;
  const S none(0.0);
  const S unit(1.0);
  const S kept = unit - values.epsilon;
  const auto dot = [](const Row& u, const Row& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; };
  const std::array<Row, 3> p{Row{x[3], x[4], x[6]}, Row{x[4], x[5], x[7]}, Row{x[6], x[7], x[8]}};
  const auto times_p = [&](const Row& row) { return Row{dot(row, p[0]), dot(row, p[1]), dot(row, p[2])}; };

  const auto [sine, cosine] = sine_cosine(x[2]);
  const S amplitude = unit + x[0];
  const Row predicted{cosine * amplitude - sine * x[1], sine * amplitude + cosine * x[1],
                      kept * x[2] - values.epsilon * frequency};
  const std::array<Row, 2> a{Row{cosine, none - sine, none - predicted[1]}, Row{sine, cosine, predicted[0]}};

  // w = A'h, from the angle between h and the prediction: this avoids turning there and back.
  const auto [h2, h1] = sine_cosine(none - phase);
  const auto [w2, w1] = sine_cosine(none - phase - x[2]);
  const Row pw = times_p({w1, w2, amplitude * w2 - x[1] * w1});
  const Row w{w1, w2, amplitude * w2 - x[1] * w1};
  const Row covariance{dot(a[0], pw) + values.q1 * h1, dot(a[1], pw) + values.q1 * h2, kept * pw[2]};
  const S over = reciprocal(dot(w, pw) + values.q1 + values.r);
  const Row gain{covariance[0] * over, covariance[1] * over, covariance[2] * over};
  const S error = amplitude * w1 + x[1] * w2 - h1;

  const std::array<Row, 2> ap{times_p(a[0]), times_p(a[1])};
  return {predicted[0] - unit - gain[0] * error,
          predicted[1] - gain[1] * error,
          predicted[2] - gain[2] * error,
          dot(ap[0], a[0]) + values.q1 - gain[0] * covariance[0],
          dot(ap[1], a[0]) - gain[1] * covariance[0],
          dot(ap[1], a[1]) + values.q1 - gain[1] * covariance[1],
          kept * ap[0][2] - gain[2] * covariance[0],
          kept * ap[1][2] - gain[2] * covariance[1],
          kept * kept * x[8] + values.q2 - gain[2] * covariance[2]};
}

}  // namespace veritrack::checker
