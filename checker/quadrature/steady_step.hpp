// One step about the steady state of the tracker with a leak, divided by the level s: e = e* + s b, b =
// (alpha, c - m, m), P = P* + s Y, -below <= Y <= above. In the frame of the predicted phase, with the
// notation of docs/leak.md, sections 3 and 4:
//
// The innovation is i = i* + s (-alpha, 0) + s c Q signal*, where the prediction turns the signal by -s c and
// s c Q is that turn minus the identity. By Phi - Phi* = (I - K H)(Pp - Pp*)(I - K* H)' the filtered
// covariance lies between Phi* + s low and Phi* + s high, and K = Phi H'/r. With `mean` the middle of the
// two, K i - K* i* = s (K i' + mean H' i*/r), i' the difference of the innovations over s. The corrected
// estimate z is compared with f, the steady one turned as the signal is turned, which has its amplitude and
// its phase error:
//     z - z* = s (alpha (1, 0) + K i' + mean H' i*/r),  z - f = z - z* - s c Q z*,
// and |z| - |f|, arg z - arg f, arg z - arg z* are that times the rows of secant(f, z), secant(z*, z)
// (step.hpp).
#pragma once

#include "checker/numbers/chord.hpp"
#include "checker/quadrature/polar_frame.hpp"
#include "checker/quadrature/step.hpp"

namespace veritrack::checker {

/// T = ((t11, t12, t13), (0, t22, t23), (0, 0, t33)).
struct TriangularMetric {
  Ball t11, t12, t13, t22, t23, t33;

  template <typename S>
  [[nodiscard]] std::array<S, 3> image(const S& amplitude, const S& phase, const S& frequency) const {
    return {t11 * amplitude + t12 * phase + t13 * frequency, t22 * phase + t23 * frequency, t33 * frequency};
  }
  /// T^-1, row by row.
  [[nodiscard]] std::array<std::array<Ball, 3>, 3> inverse() const {
    return {{{one / t11, -(t12 / (t11 * t22)), (t12 * t23 - t13 * t22) / (t11 * t22 * t33)},
             {zero, one / t22, -(t23 / (t22 * t33))},
             {zero, zero, one / t33}}};
  }
};

struct SteadySetting {
  Ball q1, q2, r, retention;
  TriangularMetric metric;
  Symmetric<Ball> below, above;
  /// |T b| <= 1 implies alpha = a11 x, c = a21 x + a22 y with x^2 + y^2 <= 1.
  Ball a11, a21, a22;
};

/// Where: the level, (x, y), and the steady state there.
template <typename S>
struct SteadyPlace {
  S level, x, y;
  PolarState<S> steady;
};

/// (e+ - e*)/s = constant + slope b + J (D y / r + K v / s), D D' = spread, |y|^2 <= eta_squared: what there
/// is under the mean gain K.
template <typename S>
struct SteadyStep {
  std::array<S, 3> constant;              ///< T constant
  std::array<std::array<S, 3>, 3> slope;  ///< T slope T^-1
  Symmetric<S> gram;                      ///< T J spread J' T' / r^2, J at the estimate
  std::array<std::array<S, 2>, 3> noise;  ///< T J K
  Symmetric<S> spread;
  S eta_squared;
  std::array<S, 3> largest;  ///< of the largest gain of the plane: its entries 11, 12, 22
  S turn;                    ///< arg z - arg z* over s
  S distance;                ///< |z|
  S swing;                   ///< s c, rad
  S forward, along;          ///< f . z and z* . z
  Symmetric<S> low, high;    ///< in the frame of the steady estimate
};

template <typename S>
SteadyStep<S> steady_step(const SteadySetting& setting, const SteadyPlace<S>& place) {
  const Ball over_r = one / setting.r;
  const S& s = place.level;
  const S alpha = setting.a11 * place.x;
  const S c = setting.a21 * place.x + setting.a22 * place.y;
  const S steady_rho = place.steady.error[0] + one;
  const S rho = steady_rho + s * alpha;
  const S swing = s * c;
  SteadyStep<S> step;
  step.swing = swing;

  // The steady step: the estimate turns by -nu*.
  const S& nu = place.steady.error[2];
  const S chi = place.steady.error[1] + nu;
  const S sine = sin(nu);
  const S cosine = cos(nu);
  const std::array<S, 2> signal{cos(chi), -sin(chi)};
  const std::array<S, 2> steady_estimate{steady_rho * cosine, -(steady_rho * sine)};
  const std::array<S, 2> steady_innovation{signal[0] - steady_rho, signal[1]};
  const Symmetric<S>& covariance = place.steady.covariance;
  const Symmetric<S> filtered = turned(covariance, S(-sine), cosine);
  const Gain<S> steady_gain{{{over_r * filtered[k11], over_r * filtered[k12]},
                             {over_r * filtered[k12], over_r * filtered[k22]},
                             {over_r * filtered[k13], over_r * filtered[k23]}}};

  // Q p.
  const S ratio = sine_over(swing);
  const S less = half * swing * square(sine_over(half * swing));
  const auto quarter = [&](const S& first, const S& second) -> std::array<S, 2> {
    return {ratio * second - less * first, -(ratio * first) - less * second};
  };
  const std::array<S, 2> by_c = quarter(signal[0], signal[1]);
  const std::array<S, 2> innovation{steady_innovation[0] + s * (c * by_c[0] - alpha),
                                    steady_innovation[1] + swing * by_c[1]};

  // The covariance.
  Symmetric<S> predicted = carried(covariance, steady_rho, setting.retention);
  predicted[k11] = predicted[k11] + setting.q1;
  predicted[k22] = predicted[k22] + setting.q1;
  predicted[k33] = predicted[k33] + setting.q2;
  const Symmetric<S> drift{S(zero),
                           covariance[k13],
                           S(zero),
                           two * covariance[k23] + (rho + steady_rho) * covariance[k33],
                           setting.retention * covariance[k33],
                           S(zero)};
  const Symmetric<S> above = carried(setting.above, rho, setting.retention);
  const Symmetric<S> below = carried(setting.below, rho, setting.retention);
  const Symmetric<S> drifted = predicted + scaled(S(s * alpha), drift);
  const Gain<S> high_gain = gain_of(drifted + scaled(s, above), setting.r);
  const Gain<S> low_gain = gain_of(drifted + scaled(S(-s), below), setting.r);
  const Symmetric<S> up = corrected(high_gain, above, steady_gain);
  const Symmetric<S> down = corrected(low_gain, below, steady_gain);
  const Symmetric<S> drift_high = corrected(high_gain, drift, steady_gain);
  const Symmetric<S> drift_low = corrected(low_gain, drift, steady_gain);
  const Symmetric<S> high = up + scaled(alpha, drift_high);
  const Symmetric<S> low = scaled(Ball(-1.0), down) + scaled(alpha, drift_low);
  step.spread = scaled(half, corrected(high_gain, above + below, low_gain));
  step.high = turned(high, sine, cosine);
  step.low = turned(low, sine, cosine);
  Gain<S> k;
  for (std::size_t i = 0; i < 3; ++i) {
    k[i] = {half * (low_gain[i][0] + high_gain[i][0]), half * (low_gain[i][1] + high_gain[i][1])};
  }
  step.largest = {high_gain[0][0], high_gain[0][1], high_gain[1][1]};
  const auto form = [](const Symmetric<S>& p, const std::array<S, 2>& v) {
    return p[k11] * square(v[0]) + p[k22] * square(v[1]) + two * (p[k12] * (v[0] * v[1]));
  };
  step.eta_squared = form(step.spread, innovation);

  // (z - z*)/s and the correction of the frequency over s: what belongs to 1, to alpha and to c.
  const auto moved = [&](const Symmetric<S>& mean) -> std::array<S, 3> {
    const S first = over_r * steady_innovation[0];
    const S second = over_r * steady_innovation[1];
    return {mean[k11] * first + mean[k12] * second, mean[k12] * first + mean[k22] * second,
            mean[k13] * first + mean[k23] * second};
  };
  std::array<std::array<S, 3>, 3> parts{
      moved(scaled(half, up + scaled(Ball(-1.0), down))),
      moved(scaled(half, drift_high + drift_low)),
      {k[0][0] * by_c[0] + k[0][1] * by_c[1], k[1][0] * by_c[0] + k[1][1] * by_c[1],
       k[2][0] * by_c[0] + k[2][1] * by_c[1]}};
  parts[1] = {parts[1][0] + one - k[0][0], parts[1][1] - k[1][0], parts[1][2] - k[2][0]};

  const auto total = [&](std::size_t i) -> S { return parts[0][i] + alpha * parts[1][i] + c * parts[2][i]; };
  const std::array<S, 2> moved_by{total(0), total(1)};
  const std::array<S, 2> z{steady_estimate[0] + s * moved_by[0], steady_estimate[1] + s * moved_by[1]};
  const Secant<S> from_steady = secant(steady_estimate, z);
  step.turn = from_steady.angle[0] * moved_by[0] + from_steady.angle[1] * moved_by[1];
  const std::array<S, 2> turned_away = quarter(steady_estimate[0], steady_estimate[1]);
  parts[2] = {parts[2][0] - turned_away[0], parts[2][1] - turned_away[1], parts[2][2]};
  const Secant<S> rows =
      secant({steady_estimate[0] + swing * turned_away[0], steady_estimate[1] + swing * turned_away[1]}, z);
  step.forward = rows.dot;
  step.along = from_steady.dot;
  std::array<std::array<S, 3>, 3> images;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::array<S, 3>& d = parts[i];
    images[i] = setting.metric.image<S>(rows.length[0] * d[0] + rows.length[1] * d[1],
                                        rows.angle[0] * d[0] + rows.angle[1] * d[1], d[2]);
  }
  step.constant = images[0];
  // b = (alpha, psi, m) and c = psi + m; m itself is kept but for the leak.
  const std::array<Ball, 3> kept = setting.metric.image<Ball>(zero, zero, setting.retention);
  const std::array<std::array<Ball, 3>, 3> inverse = setting.metric.inverse();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      step.slope[i][j] = inverse[0][j] * images[1][i] + (inverse[1][j] + inverse[2][j]) * images[2][i] +
                         S(inverse[2][j] * kept[i]);
    }
  }
  step.distance = sqrt(square(z[0]) + square(z[1]));
  const S over = reciprocal(step.distance);
  const std::array<S, 2> direction{z[0] * over, z[1] * over};
  const S none(zero);
  const std::array<std::array<S, 3>, 3> columns{
      setting.metric.image<S>(direction[0], -(direction[1] * over), none),
      setting.metric.image<S>(direction[1], direction[0] * over, none),
      setting.metric.image<S>(none, none, S(one))};
  const Symmetric<S> scaled_spread = scaled(square(over_r), step.spread);
  std::array<std::array<S, 3>, 3> half_gram;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto along = [&](const S& x, const S& y, const S& w) {
      return columns[0][i] * x + columns[1][i] * y + columns[2][i] * w;
    };
    const Symmetric<S>& m = scaled_spread;
    half_gram[i] = {along(m[k11], m[k12], m[k13]), along(m[k12], m[k22], m[k23]),
                    along(m[k13], m[k23], m[k33])};
    step.noise[i] = {along(k[0][0], k[1][0], k[2][0]), along(k[0][1], k[1][1], k[2][1])};
  }
  const auto entry = [&](std::size_t i, std::size_t j) {
    return half_gram[i][0] * columns[0][j] + half_gram[i][1] * columns[1][j] +
           half_gram[i][2] * columns[2][j];
  };
  step.gram = {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
  return step;
}

/// (P+ - P*)/s when P* + s `image` is turned by -(s `turn`).
template <typename S>
Symmetric<S> turned_deviation(const SteadyPlace<S>& place, const Symmetric<S>& image, const S& turn) {
  const S angle = -(place.level * turn);
  const S slope = -(turn * sine_over(angle));  // sin(angle)/s
  const S sine = place.level * slope;
  const S less = -(two * square(sin(half * angle)));
  const S less_slope = half * (turn * angle * square(sine_over(half * angle)));
  return image + turned_difference(image, sine, less, sine) +
         turned_difference(place.steady.covariance, slope, less_slope, sine);
}

}  // namespace veritrack::checker
