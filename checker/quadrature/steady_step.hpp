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
//
// (alpha, c) fixes two of three components of T b: the third is along T (0, -1, 1)', which changes m alone,
// and m is unchanged except by the leak.
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
  /// For the orthonormal basis u1, u2, n of the space of T b, n along T (0, -1, 1)' and u1 along the first
  /// row of T^-1: T b = x u1 + y u2 + t n has alpha = a11 x, c = a21 x + a22 y and m = m1 x + m2 y + m3 t.
  Ball a11, a21, a22, m1, m2, m3;

  /// Sets these; they are finite only if there is such a basis.
  void set_directions() {
    const std::array<Ball, 3> across = metric.image<Ball>(zero, Ball(-1.0), one);
    m3 = one / sqrt(square(across[0]) + square(across[1]) + square(across[2]));
    const std::array<Ball, 3> n{across[0] * m3, across[1] * m3, across[2] * m3};
    const auto inverse = metric.inverse();
    const std::array<Ball, 3>& alpha = inverse[0];
    a11 = sqrt(square(alpha[0]) + square(alpha[1]) + square(alpha[2]));
    const std::array<Ball, 3> u1{alpha[0] / a11, alpha[1] / a11, alpha[2] / a11};
    const std::array<Ball, 3> u2{n[1] * u1[2] - n[2] * u1[1], n[2] * u1[0] - n[0] * u1[2],
                                 n[0] * u1[1] - n[1] * u1[0]};
    const auto of_c = [&](const std::array<Ball, 3>& u) {
      return (inverse[1][0] + inverse[2][0]) * u[0] + (inverse[1][1] + inverse[2][1]) * u[1] +
             (inverse[1][2] + inverse[2][2]) * u[2];
    };
    a21 = of_c(u1);
    a22 = of_c(u2);
    m1 = u1[2] * inverse[2][2];
    m2 = u2[2] * inverse[2][2];
  }
  /// The remainder of a unit of t after a step.
  [[nodiscard]] std::array<Ball, 3> hidden() const { return metric.image<Ball>(zero, zero, retention * m3); }
};

/// The place of a step: the level, (x, y), and the steady state there.
template <typename S>
struct SteadyPlace {
  S level, x, y;
  PolarState<S> steady;
};

/// T (e+ - e*)/s = moved + t hidden + T J (D y / r + K v / s), D D' = spread, |y|^2 <= (i + v)' spread (i +
/// v): the error under the mean gain K.
template <typename S>
struct SteadyStep {
  std::array<S, 3> moved;                 ///< of the error with t = 0
  Symmetric<S> gram;                      ///< T J spread J' T' / r^2, J at the estimate
  std::array<std::array<S, 2>, 3> noise;  ///< T J K
  Symmetric<S> spread;
  S eta_squared;             ///< of the innovation without noise
  std::array<S, 3> largest;  ///< of the largest gain of the plane: its entries 11, 12, 22
  S turn;                    ///< arg z - arg z* over s
  S distance;                ///< |z|
  S across;                  ///< n' spread n, n the direction across z
  S swing;                   ///< s c, rad
  S forward, along;          ///< f . z and z* . z
  Symmetric<S> low, high;    ///< in the frame of the steady estimate
};

/// The quantities shared by the parts of a step: the steady step, in which the estimate turns by -nu*, and
/// the deviation from it.
template <typename S>
struct SteadyTurn {
  S alpha, c, swing;                      ///< swing = s c
  S steady_rho, rho;                      ///< |z*| and |z| before the step
  S sine, cosine;                         ///< of nu*
  S ratio, less;                          ///< sin(swing)/swing and (1 - cos(swing))/swing
  std::array<S, 2> by_c;                  ///< Q signal*
  std::array<S, 2> estimate, innovation;  ///< the predicted estimate and i*, steady
  Gain<S> gain;                           ///< steady
  /// Q p.
  [[nodiscard]] std::array<S, 2> quarter(const S& first, const S& second) const {
    return {ratio * second - less * first, -(ratio * first) - less * second};
  }
};

template <typename S>
SteadyTurn<S> steady_turn(const SteadySetting& setting, const SteadyPlace<S>& place) {
  const Ball over_r = one / setting.r;
  SteadyTurn<S> turn;
  turn.alpha = setting.a11 * place.x;
  turn.c = setting.a21 * place.x + setting.a22 * place.y;
  turn.swing = place.level * turn.c;
  turn.steady_rho = place.steady.error[0] + one;
  turn.rho = turn.steady_rho + place.level * turn.alpha;
  const S& nu = place.steady.error[2];
  const S chi = place.steady.error[1] + nu;
  turn.sine = sin(nu);
  turn.cosine = cos(nu);
  turn.ratio = sine_over(turn.swing);
  turn.less = half * turn.swing * square(sine_over(half * turn.swing));
  const std::array<S, 2> signal{cos(chi), -sin(chi)};
  turn.by_c = turn.quarter(signal[0], signal[1]);
  turn.estimate = {turn.steady_rho * turn.cosine, -(turn.steady_rho * turn.sine)};
  turn.innovation = {signal[0] - turn.steady_rho, signal[1]};
  const Symmetric<S> filtered = turned(place.steady.covariance, S(-turn.sine), turn.cosine);
  turn.gain = {{{over_r * filtered[k11], over_r * filtered[k12]},
                {over_r * filtered[k12], over_r * filtered[k22]},
                {over_r * filtered[k13], over_r * filtered[k23]}}};
  return turn;
}

/// The covariance after the update, Phi* + s (low or high), in the frame of the prediction.
template <typename S>
struct SteadyUpdate {
  Gain<S> mean, largest;          ///< gains
  Symmetric<S> middle, by_alpha;  ///< (low + high)/2 = middle + alpha by_alpha
  Symmetric<S> low, high, spread;
};

template <typename S>
SteadyUpdate<S> steady_update(const SteadySetting& setting, const SteadyPlace<S>& place,
                              const SteadyTurn<S>& turn) {
  const S& s = place.level;
  const Symmetric<S>& covariance = place.steady.covariance;
  Symmetric<S> predicted = carried(covariance, turn.steady_rho, setting.retention);
  predicted[k11] = predicted[k11] + setting.q1;
  predicted[k22] = predicted[k22] + setting.q1;
  predicted[k33] = predicted[k33] + setting.q2;
  const Symmetric<S> drift{S(zero),
                           covariance[k13],
                           S(zero),
                           two * covariance[k23] + (turn.rho + turn.steady_rho) * covariance[k33],
                           setting.retention * covariance[k33],
                           S(zero)};
  const Symmetric<S> above = carried(setting.above, turn.rho, setting.retention);
  const Symmetric<S> below = carried(setting.below, turn.rho, setting.retention);
  const Symmetric<S> drifted = predicted + scaled(S(s * turn.alpha), drift);
  const Gain<S> high_gain = gain_of(drifted + scaled(s, above), setting.r);
  const Gain<S> low_gain = gain_of(drifted + scaled(S(-s), below), setting.r);
  const Symmetric<S> up = corrected(high_gain, above, turn.gain);
  const Symmetric<S> down = scaled(Ball(-1.0), corrected(low_gain, below, turn.gain));
  const Symmetric<S> drift_high = corrected(high_gain, drift, turn.gain);
  const Symmetric<S> drift_low = corrected(low_gain, drift, turn.gain);
  SteadyUpdate<S> update;
  update.high = up + scaled(turn.alpha, drift_high);
  update.low = down + scaled(turn.alpha, drift_low);
  update.spread = scaled(half, corrected(high_gain, above + below, low_gain));
  update.middle = scaled(half, up + down);
  update.by_alpha = scaled(half, drift_high + drift_low);
  for (std::size_t i = 0; i < 3; ++i) {
    update.mean[i] = {half * (low_gain[i][0] + high_gain[i][0]), half * (low_gain[i][1] + high_gain[i][1])};
  }
  update.largest = high_gain;
  return update;
}

/// The estimate corrected by the mean gain: sets moved, turn, forward and along. Returns z.
template <typename S>
std::array<S, 2> move_estimate(const SteadySetting& setting, const SteadyPlace<S>& place,
                               const SteadyTurn<S>& turn, const SteadyUpdate<S>& update,
                               SteadyStep<S>& step) {
  const S& s = place.level;
  // (z - z*)/s and the correction of the frequency over s: the coefficients of 1, alpha and c.
  const Ball over_r = one / setting.r;
  const Gain<S>& k = update.mean;
  const auto moved = [&](const Symmetric<S>& mean) -> std::array<S, 3> {
    const S first = over_r * turn.innovation[0];
    const S second = over_r * turn.innovation[1];
    return {mean[k11] * first + mean[k12] * second, mean[k12] * first + mean[k22] * second,
            mean[k13] * first + mean[k23] * second};
  };
  const auto pulled = [&](std::size_t i) { return k[i][0] * turn.by_c[0] + k[i][1] * turn.by_c[1]; };
  std::array<std::array<S, 3>, 3> parts{
      moved(update.middle), moved(update.by_alpha), {pulled(0), pulled(1), pulled(2)}};
  parts[1] = {parts[1][0] + one - k[0][0], parts[1][1] - k[1][0], parts[1][2] - k[2][0]};

  const auto total = [&](std::size_t i) -> S {
    return parts[0][i] + turn.alpha * parts[1][i] + turn.c * parts[2][i];
  };
  const std::array<S, 2> moved_by{total(0), total(1)};
  std::array<S, 2> z{turn.estimate[0] + s * moved_by[0], turn.estimate[1] + s * moved_by[1]};
  const Secant<S> from_steady = secant(turn.estimate, z);
  step.turn = from_steady.angle[0] * moved_by[0] + from_steady.angle[1] * moved_by[1];
  step.along = from_steady.dot;
  const std::array<S, 2> away = turn.quarter(turn.estimate[0], turn.estimate[1]);
  const std::array<S, 2> from_turned{moved_by[0] - turn.c * away[0], moved_by[1] - turn.c * away[1]};
  const Secant<S> rows =
      secant({turn.estimate[0] + turn.swing * away[0], turn.estimate[1] + turn.swing * away[1]}, z);
  step.forward = rows.dot;
  const S m = setting.m1 * place.x + setting.m2 * place.y;
  step.moved = setting.metric.image<S>(rows.length[0] * from_turned[0] + rows.length[1] * from_turned[1],
                                       rows.angle[0] * from_turned[0] + rows.angle[1] * from_turned[1],
                                       total(2) + setting.retention * m);
  return z;
}

/// The contributions of noise and of the spread of the gain at the corrected estimate z: sets distance, noise
/// and gram.
template <typename S>
void add_gains(const SteadySetting& setting, const std::array<S, 2>& z, const SteadyUpdate<S>& update,
               SteadyStep<S>& step) {
  step.distance = sqrt(square(z[0]) + square(z[1]));
  const S over = reciprocal(step.distance);
  const std::array<S, 2> direction{z[0] * over, z[1] * over};
  const S none(zero);
  const std::array<std::array<S, 3>, 3> columns{
      setting.metric.image<S>(direction[0], -(direction[1] * over), none),
      setting.metric.image<S>(direction[1], direction[0] * over, none),
      setting.metric.image<S>(none, none, S(one))};
  const Symmetric<S>& d = update.spread;
  step.across = d[k11] * square(direction[1]) + d[k22] * square(direction[0]) -
                two * (d[k12] * (direction[0] * direction[1]));
  const Symmetric<S> m = scaled(square(one / setting.r), d);
  const Gain<S>& k = update.mean;
  std::array<std::array<S, 3>, 3> half_gram;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto along = [&](const S& x, const S& y, const S& w) {
      return columns[0][i] * x + columns[1][i] * y + columns[2][i] * w;
    };
    half_gram[i] = {along(m[k11], m[k12], m[k13]), along(m[k12], m[k22], m[k23]),
                    along(m[k13], m[k23], m[k33])};
    step.noise[i] = {along(k[0][0], k[1][0], k[2][0]), along(k[0][1], k[1][1], k[2][1])};
  }
  const auto entry = [&](std::size_t i, std::size_t j) {
    return half_gram[i][0] * columns[0][j] + half_gram[i][1] * columns[1][j] +
           half_gram[i][2] * columns[2][j];
  };
  step.gram = {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

/// `update` belongs to the place; it depends on x, the frequency and the level alone.
template <typename S>
SteadyStep<S> steady_step(const SteadySetting& setting, const SteadyPlace<S>& place,
                          const SteadyTurn<S>& turn, const SteadyUpdate<S>& update) {
  const S& s = place.level;
  SteadyStep<S> step;
  step.swing = turn.swing;
  step.spread = update.spread;
  step.high = turned(update.high, turn.sine, turn.cosine);
  step.low = turned(update.low, turn.sine, turn.cosine);
  step.largest = {update.largest[0][0], update.largest[0][1], update.largest[1][1]};
  const std::array<S, 2> innovation{turn.innovation[0] + s * (turn.c * turn.by_c[0] - turn.alpha),
                                    turn.innovation[1] + turn.swing * turn.by_c[1]};
  const Symmetric<S>& d = step.spread;
  step.eta_squared = d[k11] * square(innovation[0]) + d[k22] * square(innovation[1]) +
                     two * (d[k12] * (innovation[0] * innovation[1]));
  add_gains(setting, move_estimate(setting, place, turn, update, step), update, step);
  return step;
}

template <typename S>
SteadyStep<S> steady_step(const SteadySetting& setting, const SteadyPlace<S>& place) {
  const SteadyTurn<S> turn = steady_turn(setting, place);
  return steady_step(setting, place, turn, steady_update(setting, place, turn));
}

/// The effect of a turn by -(s `turn`) on deviations of the covariance from P*.
template <typename S>
struct DeviationTurn {
  S sine, less;         ///< of the angle: its sine, and its cosine minus 1
  Symmetric<S> steady;  ///< (P* turned - P*)/s
};

template <typename S>
DeviationTurn<S> deviation_turn(const SteadyPlace<S>& place, const S& turn) {
  const S angle = -(place.level * turn);
  const S slope = -(turn * sine_over(angle));  // sin(angle)/s
  const S sine = place.level * slope;
  const S less = -(two * square(sin(half * angle)));
  const S less_slope = half * (turn * angle * square(sine_over(half * angle)));
  return {sine, less, turned_difference(place.steady.covariance, slope, less_slope, sine)};
}

/// (P+ - P*)/s when P* + s `image` is turned.
template <typename S>
Symmetric<S> turned_deviation(const Symmetric<S>& image, const DeviationTurn<S>& turn) {
  return image + turned_difference(image, turn.sine, turn.less, turn.sine) + turn.steady;
}

}  // namespace veritrack::checker
