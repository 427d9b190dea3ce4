// Trackers written as lists of operations, for the tests of proposals and proofs.
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "analysis/model/steady_state/steady_state.hpp"
#include "analysis/model/step/tube.hpp"
#include "trackers/model/model_tracker.hpp"

namespace veritrack::test {

using trackers::Operation;
using trackers::Recursion;
using trackers::StraightLineProgram;

/// A recursion, values of its constants, and where a simulation begins.
struct ExampleTracker {
  Recursion recursion;
  std::vector<double> constants;
  model::StartState start;
};

/// A cos(phi).
inline model::Signal cosine_signal() {
  return {{{0.0, 1.0}}};
}
/// (A cos(phi), A sin(phi)).
inline model::Signal quadrature_signal() {
  return {{{0.0, 1.0}, {0.0, {0.0, -1.0}}}};
}

/// The tracker on a tone of amplitude 1.
inline model::TrackedTone tone_of(const ExampleTracker& example, bool quadrature = false) {
  return {model::StepMap(example.recursion, example.constants),
          quadrature ? quadrature_signal() : cosine_signal(), 1.0, example.start};
}

inline StraightLineProgram frequency_of_state(int constants, int states, int index) {
  StraightLineProgram program(constants + states);
  program.add_result(constants + index);
  return program;
}

/// A phase-locked loop of type 2 on one channel: e = -y sin theta; w' = w + ki e; theta' = theta + w + kp e.
/// `bandwidth` in rad/sample. States w, theta.
inline ExampleTracker phase_locked_loop(double bandwidth = 0.02, double damping = 0.7071) {
  ExampleTracker example;
  Recursion& r = example.recursion;
  r.constants = 2;  // ki, kp
  r.states = 2;
  r.samples = 1;
  r.is_angle = {false, true};
  StraightLineProgram step(5);
  const int ki = 0, kp = 1, w = 2, theta = 3, y = 4;
  const int e =
      step.append(Operation::negate, step.append(Operation::multiply, y, step.append(Operation::sin, theta)));
  const int next_w = step.append(Operation::add, w, step.append(Operation::multiply, ki, e));
  const int turned = step.append(Operation::add, theta, w);
  const int next_theta = step.append(Operation::add, turned, step.append(Operation::multiply, kp, e));
  step.add_result(next_w);
  step.add_result(next_theta);
  r.step = step;
  r.frequency = frequency_of_state(2, 2, 0);
  // The slope of the mean of e in theta is -1/2.
  example.constants = {2.0 * bandwidth * bandwidth, 4.0 * damping * bandwidth};
  example.start = [](double omega) { return std::vector<double>{omega, 0.0}; };
  return example;
}

/// The same with two channels, whose phase detector is the angle between the samples and the prediction:
/// nearly linear. ahead = theta + w; e = atan2(y2 cos ahead - y1 sin ahead, y1 cos ahead + y2 sin ahead); w'
/// = w + ki e; theta' = ahead + kp e. States w, theta.
inline ExampleTracker angle_loop(double ki = 4e-4, double kp = 0.04) {
  ExampleTracker example;
  Recursion& r = example.recursion;
  r.constants = 2;  // ki, kp
  r.states = 2;
  r.samples = 2;
  r.is_angle = {false, true};
  StraightLineProgram step(6);
  const int ki_at = 0, kp_at = 1, w = 2, theta = 3, y1 = 4, y2 = 5;
  const int ahead = step.append(Operation::add, theta, w);
  const int cosine = step.append(Operation::cos, ahead);
  const int sine = step.append(Operation::sin, ahead);
  const auto product = [&](int a, int b) { return step.append(Operation::multiply, a, b); };
  const int across = step.append(Operation::subtract, product(y2, cosine), product(y1, sine));
  const int along = step.append(Operation::add, product(y1, cosine), product(y2, sine));
  const int e = step.append(Operation::atan2, across, along);
  const int next_w = step.append(Operation::add, w, product(ki_at, e));
  const int next_theta = step.append(Operation::add, ahead, product(kp_at, e));
  step.add_result(next_w);
  step.add_result(next_theta);
  r.step = step;
  r.frequency = frequency_of_state(2, 2, 0);
  example.constants = {ki, kp};
  example.start = [](double omega) { return std::vector<double>{omega, 0.0}; };
  return example;
}

/// A second-order generalised integrator with a frequency-locked loop, at `rate` samples a second. States
/// alpha, beta, w (rad/s).
inline ExampleTracker integrator_loop(double rate = 10000.0, double k = std::sqrt(2.0), double gamma = 50.0) {
  ExampleTracker example;
  Recursion& r = example.recursion;
  r.constants = 3;  // k, gamma k T, T
  r.states = 3;
  r.samples = 1;
  r.is_angle = {false, false, false};
  StraightLineProgram step(7);
  const int ck = 0, cg = 1, ct = 2, alpha = 3, beta = 4, w = 5, y = 6;
  const auto times = [&step](int a, int b) { return step.append(Operation::multiply, a, b); };
  const int e = step.append(Operation::subtract, y, alpha);
  const int wt = times(w, ct);
  const int next_alpha =
      step.append(Operation::add, alpha, times(wt, step.append(Operation::subtract, times(ck, e), beta)));
  const int next_beta = step.append(Operation::add, beta, times(wt, next_alpha));
  const int norm = step.append(Operation::add, step.append({Operation::power, next_alpha, -1, -1, 2}),
                               step.append({Operation::power, next_beta, -1, -1, 2}));
  const int change = step.append(Operation::divide, times(times(times(cg, w), e), next_beta), norm);
  step.add_result(next_alpha);
  step.add_result(next_beta);
  step.add_result(step.append(Operation::subtract, w, change));
  r.step = step;
  r.frequency = StraightLineProgram(6);
  r.frequency.add_result(r.frequency.append(Operation::multiply, 5, 2));
  example.constants = {k, gamma * k / rate, 1.0 / rate};
  example.start = [rate](double omega) { return std::vector<double>{1.0, 0.0, omega * rate}; };
  return example;
}

/// The Kalman-based adaptive notch filter: s = y + rho a s1 - rho^2 s2; p += q; K = s1/(s1^2 + r/p);
/// e = s - a s1 + s2; a += K e; p = (1 - K s1) p; frequency acos(a/2). States s1, s2, a, p.
inline ExampleTracker notch_filter(double rho = 0.95, double q = 1e-6, double r_noise = 1.0) {
  ExampleTracker example;
  Recursion& r = example.recursion;
  r.constants = 5;  // rho, rho^2, q, r, 1/2
  r.states = 4;
  r.samples = 1;
  r.is_angle = {false, false, false, false};
  StraightLineProgram step(10);
  const int rho1 = 0, rho2 = 1, cq = 2, cr = 3, s1 = 5, s2 = 6, a = 7, p = 8, y = 9;
  const auto times = [&step](int x, int z) { return step.append(Operation::multiply, x, z); };
  const auto add = [&step](int x, int z) { return step.append(Operation::add, x, z); };
  const auto less = [&step](int x, int z) { return step.append(Operation::subtract, x, z); };
  const int s = less(add(y, times(times(rho1, a), s1)), times(rho2, s2));
  const int predicted = add(p, cq);
  const int gain =
      step.append(Operation::divide, s1, add(times(s1, s1), step.append(Operation::divide, cr, predicted)));
  const int e = add(less(s, times(a, s1)), s2);
  step.add_result(s);
  step.add_result(s1);
  step.add_result(add(a, times(gain, e)));
  step.add_result(less(predicted, times(times(gain, s1), predicted)));
  r.step = step;
  r.frequency = StraightLineProgram(9);
  r.frequency.add_result(r.frequency.append(Operation::acos, r.frequency.append(Operation::multiply, a, 4)));
  example.constants = {rho, rho * rho, q, r_noise, 0.5};
  example.start = [](double omega) { return std::vector<double>{0.0, 0.0, 2.0 * std::cos(omega), 1e-2}; };
  return example;
}

/// Aranovskiy's observer: x1' = x1 + (b y - a x1); theta = sigma + k b x1 y;
/// sigma' = sigma - k ((b y - a x1)(b y + a x1) + x1^2 theta), b = a; frequency sqrt(-theta of the new
/// state). States x1, sigma, theta (the last one an output).
inline ExampleTracker aranovskiy_observer(double a = 0.05, double k = 0.05) {
  ExampleTracker example;
  Recursion& r = example.recursion;
  r.constants = 2;  // a, k
  r.states = 3;
  r.samples = 1;
  r.is_angle = {false, false, false};
  StraightLineProgram step(6);
  const int ca = 0, ck = 1, x1 = 2, sigma = 3, y = 5;
  const auto times = [&step](int x, int z) { return step.append(Operation::multiply, x, z); };
  const auto add = [&step](int x, int z) { return step.append(Operation::add, x, z); };
  const int ay = times(ca, y);
  const int ax = times(ca, x1);
  const int slope = step.append(Operation::subtract, ay, ax);
  const int theta = add(sigma, times(times(times(ck, ca), x1), y));
  const int drive = add(times(slope, add(ay, ax)), times(times(x1, x1), theta));
  step.add_result(add(x1, slope));
  step.add_result(step.append(Operation::subtract, sigma, times(ck, drive)));
  step.add_result(theta);
  r.step = step;
  r.frequency = StraightLineProgram(5);
  r.frequency.add_result(r.frequency.append(Operation::sqrt, r.frequency.append(Operation::negate, 4)));
  example.constants = {a, k};
  example.start = [](double omega) { return std::vector<double>{0.7, -omega * omega, -omega * omega}; };
  return example;
}

/// The extended Kalman filter of (x1, x2, w) that measures x1, or x1 and x2 one after the other, with
/// Q = diag(q, q, q) and variance r. States x1, x2, w, P11, P12, P13, P22, P23, P33.
inline ExampleTracker kalman_filter(int channels, double q, double r_noise) {
  ExampleTracker example;
  Recursion& r = example.recursion;
  r.constants = 2;  // q, r
  r.states = 9;
  r.samples = channels;
  r.is_angle.assign(9, false);
  StraightLineProgram step(11 + channels);
  const auto times = [&step](int x, int z) { return step.append(Operation::multiply, x, z); };
  const auto add = [&step](int x, int z) { return step.append(Operation::add, x, z); };
  const auto less = [&step](int x, int z) { return step.append(Operation::subtract, x, z); };
  const int c = step.append(Operation::cos, 4);
  const int s = step.append(Operation::sin, 4);
  std::array<int, 3> x{less(times(c, 2), times(s, 3)), add(times(s, 2), times(c, 3)), 4};
  using Matrix = std::array<std::array<int, 3>, 3>;
  Matrix p{{{5, 6, 7}, {6, 8, 9}, {7, 9, 10}}};
  // F P with the rows (c, -s, -x2), (s, c, x1), (0, 0, 1) of F, then (F P) F'.
  Matrix fp = p;
  Matrix next = p;
  for (std::size_t j = 0; j < 3; ++j) {
    fp[0][j] = less(less(times(c, p[0][j]), times(s, p[1][j])), times(x[1], p[2][j]));
    fp[1][j] = add(add(times(s, p[0][j]), times(c, p[1][j])), times(x[0], p[2][j]));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    next[i][0] = less(less(times(c, fp[i][0]), times(s, fp[i][1])), times(x[1], fp[i][2]));
    next[i][1] = add(add(times(s, fp[i][0]), times(c, fp[i][1])), times(x[0], fp[i][2]));
    next[i][2] = fp[i][2];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      p[i][j] = p[j][i] = i == j ? add(next[i][j], 0) : next[i][j];
    }
  }
  for (std::size_t m = 0; m < static_cast<std::size_t>(channels); ++m) {
    const int variance = add(p[m][m], 1);
    const int e = less(11 + static_cast<int>(m), x[m]);
    std::array<int, 3> gain{};
    for (std::size_t i = 0; i < 3; ++i) {
      gain[i] = step.append(Operation::divide, p[i][m], variance);
    }
    const Matrix before = p;
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = add(x[i], times(gain[i], e));
      for (std::size_t j = i; j < 3; ++j) {
        p[i][j] = p[j][i] = less(before[i][j], times(gain[i], before[m][j]));
      }
    }
  }
  for (const int result : {x[0], x[1], x[2], p[0][0], p[0][1], p[0][2], p[1][1], p[1][2], p[2][2]}) {
    step.add_result(result);
  }
  r.step = step;
  r.frequency = frequency_of_state(2, 9, 2);
  example.constants = {q, r_noise};
  example.start = [q, r_noise](double omega) {
    const double variance = q + r_noise;
    return std::vector<double>{1.0, 0.0, omega, variance, 0.0, 0.0, variance, 0.0, q};
  };
  return example;
}

}  // namespace veritrack::test
