// Small extended Kalman filters by their parts, with their formulas written out beside them.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include "analysis/model/steady_state/curve_fit.hpp"
#include "analysis/model/steady_state/steady_state.hpp"
#include "tests/analysis/model/tube_examples.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "trackers/model/filter_parts.hpp"

namespace veritrack::test {

/// As a recursion, and by its parts.
struct ExampleFilter {
  ExampleTracker tracker;
  trackers::FilterParts parts;
};

/// Needs the filter as long as it is used.
inline model::TrackedTone tone_of(const ExampleFilter& filter) {
  model::TrackedTone tone = tone_of(filter.tracker);
  tone.filter = &filter.parts;
  return tone;
}

/// As the verification sees it.
struct FilterExample {
  ExampleFilter filter;
  Example example;

  explicit FilterExample(ExampleFilter of) : filter(std::move(of)), example(filter.tracker) {
    example.model.filter = &filter.parts;
  }
  FilterExample(const FilterExample&) = delete;
  FilterExample& operator=(const FilterExample&) = delete;
  FilterExample(FilterExample&&) = delete;
  FilterExample& operator=(FilterExample&&) = delete;
  ~FilterExample() = default;
};

/// One state, f = a x + bend x^2/2, measured as h x; its estimated frequency is the state.
struct ScalarFilter {
  double a = 0.9, bend = 0.0, h = 1.0, q = 0.01, r = 0.04;

  [[nodiscard]] double next(double x) const { return a * x + 0.5 * bend * x * x; }
  [[nodiscard]] double slope(double x) const { return a + bend * x; }
  [[nodiscard]] double updated(double predicted) const { return predicted * r / (h * h * predicted + r); }
  /// Of an updated covariance.
  [[nodiscard]] double gain(double covariance) const { return covariance * h / r; }
  /// The predicted covariance that p = square updated(p) + process leaves as it is.
  [[nodiscard]] double settled(double square, double process) const {
    const double linear = r - square * r - process * h * h;
    return (-linear + std::sqrt(linear * linear + 4.0 * h * h * process * r)) / (2.0 * h * h);
  }
  /// Constants a, bend, 1/2, h, q, r. States x and P.
  [[nodiscard]] ExampleFilter filter() const;
};

inline ExampleFilter ScalarFilter::filter() const {
  constexpr int kA = 0, kBend = 1, kHalf = 2, kH = 3, kQ = 4, kR = 5, kX = 6;
  struct Prediction {
    int state, slope;
  };
  const auto predict = [](StraightLineProgram& program) {
    const int bent = program.append(Operation::multiply, kBend, kX);
    const int square =
        program.append(Operation::multiply, program.append(Operation::multiply, kHalf, bent), kX);
    return Prediction{program.append(Operation::add, program.append(Operation::multiply, kA, kX), square),
                      program.append(Operation::add, kA, bent)};
  };
  ExampleFilter example;
  StraightLineProgram parts(8);
  const Prediction of_parts = predict(parts);
  const int innovation =
      parts.append(Operation::subtract, 7, parts.append(Operation::multiply, kH, of_parts.state));
  for (const int result : {of_parts.state, of_parts.slope, innovation, kH, kQ, kR}) {
    parts.add_result(result);
  }
  example.parts = {parts, 1, 1, false};
  StraightLineProgram step(9);
  const auto times = [&step](int x, int y) { return step.append(Operation::multiply, x, y); };
  const auto add = [&step](int x, int y) { return step.append(Operation::add, x, y); };
  const Prediction predicted = predict(step);
  const int covariance = add(times(times(predicted.slope, predicted.slope), 7), kQ);
  const int variance = add(times(times(kH, kH), covariance), kR);
  const int gain = step.append(Operation::divide, times(covariance, kH), variance);
  const int error = step.append(Operation::subtract, 8, times(kH, predicted.state));
  step.add_result(add(predicted.state, times(gain, error)));
  step.add_result(step.append(Operation::divide, times(covariance, kR), variance));
  Recursion& recursion = example.tracker.recursion;
  recursion.constants = 6;
  recursion.states = 2;
  recursion.samples = 1;
  recursion.is_angle = {false, false};
  recursion.step = step;
  recursion.frequency = frequency_of_state(6, 2, 0);
  example.tracker.constants = {a, bend, 0.5, h, q, r};
  example.tracker.start = [process = q](double) { return std::vector<double>{0.0, process}; };
  return example;
}

/// Two states, f = (a x1 - b x2 + bend x1 x2, b x1 + a x2 + bend x1^2/2), measured as x1 + h x2, with two
/// channels also as x2; its estimated frequency is x1 + x2/2. Its recursion is not written down.
struct BentFilter {
  int channels = 1;
  bool gives_jacobian = false;  ///< one that is not the derivative of f
  double a = 0.8, b = 0.3, bend = 0.2, h = 0.4, q = 0.02, q12 = 0.004, q2 = 0.01, r = 0.05, r12 = 0.01;

  [[nodiscard]] Eigen::Vector2d next(const Eigen::Vector2d& x) const {
    return {a * x[0] - b * x[1] + bend * x[0] * x[1], b * x[0] + a * x[1] + 0.5 * bend * x[0] * x[0]};
  }
  [[nodiscard]] Eigen::Matrix2d slope(const Eigen::Vector2d& x) const {
    return Eigen::Matrix2d{{a + bend * x[1], -b + bend * x[0]}, {b + bend * x[0], a}};
  }
  [[nodiscard]] Eigen::Matrix2d jacobian(const Eigen::Vector2d& x) const {
    Eigen::Matrix2d matrix = slope(x);
    matrix(1, 1) += gives_jacobian ? bend * x[0] : 0.0;
    return matrix;
  }
  [[nodiscard]] Eigen::MatrixXd measured() const {
    return Eigen::Matrix2d{{1.0, h}, {0.0, 1.0}}.topRows(channels);
  }
  [[nodiscard]] Eigen::Matrix2d process() const { return Eigen::Matrix2d{{q, q12}, {q12, q2}}; }
  [[nodiscard]] Eigen::MatrixXd noise() const {
    return Eigen::Matrix2d{{r, r12}, {r12, r}}.topLeftCorner(channels, channels);
  }
  /// R^-1 H.
  [[nodiscard]] Eigen::MatrixXd weighted() const { return oracle::solution(noise(), measured()); }
  /// Of the inverses: P+^-1 = P^-1 + H' R^-1 H.
  [[nodiscard]] Eigen::Matrix2d updated(const Eigen::Matrix2d& predicted) const {
    const Eigen::Matrix2d information = predicted.inverse() + measured().transpose() * weighted();
    return information.inverse();
  }
  /// Constants a, b, bend, 1/2, h, q, q12, q2, r, r12, 1, 0.
  [[nodiscard]] ExampleFilter filter() const;
  /// A curve that is none of its steady states.
  [[nodiscard]] static model::NodeCurve written_curve();
};

inline ExampleFilter BentFilter::filter() const {
  constexpr int kA = 0, kB = 1, kBend = 2, kHalf = 3, kH = 4, kQ = 5, kQ12 = 6, kQ2 = 7, kR = 8, kR12 = 9;
  constexpr int kOne = 10, kZero = 11, kX1 = 12, kX2 = 13, kY = 14;
  StraightLineProgram program(kY + channels);
  const auto times = [&program](int x, int y) { return program.append(Operation::multiply, x, y); };
  const auto add = [&program](int x, int y) { return program.append(Operation::add, x, y); };
  const auto less = [&program](int x, int y) { return program.append(Operation::subtract, x, y); };
  const int bent = times(kBend, kX1);
  const int first = add(less(times(kA, kX1), times(kB, kX2)), times(bent, kX2));
  const int second = add(add(times(kB, kX1), times(kA, kX2)), times(kHalf, times(bent, kX1)));
  const int corner = gives_jacobian ? add(kA, bent) : kA;
  std::vector<int> results{first, second, add(kA, times(kBend, kX2)), less(bent, kB), add(kB, bent), corner};
  results.push_back(less(kY, add(first, times(kH, second))));
  if (channels == 2) {
    results.push_back(less(kY + 1, second));
  }
  const std::vector<int> constant_ones =
      channels == 2 ? std::vector<int>{kOne, kH, kZero, kOne, kQ, kQ12, kQ12, kQ2, kR, kR12, kR12, kR}
                    : std::vector<int>{kOne, kH, kQ, kQ12, kQ12, kQ2, kR};
  results.insert(results.end(), constant_ones.begin(), constant_ones.end());
  for (const int result : results) {
    program.add_result(result);
  }
  ExampleFilter example;
  example.parts = {program, 2, channels, gives_jacobian};
  Recursion& recursion = example.tracker.recursion;
  recursion.constants = 12;
  recursion.states = 5;
  recursion.samples = channels;
  recursion.is_angle.assign(5, false);
  recursion.frequency = StraightLineProgram(17);
  recursion.frequency.add_result(recursion.frequency.append(
      Operation::add, kX1, recursion.frequency.append(Operation::multiply, kHalf, kX2)));
  example.tracker.constants = {a, b, bend, 0.5, h, q, q12, q2, r, r12, 1.0, 0.0};
  return example;
}

inline model::NodeCurve BentFilter::written_curve() {
  model::NodeCurve curve{0.7, {0, 0, 0, 0, 0}, Eigen::MatrixXcd::Zero(5, 3), 0.0};
  curve.harmonics.row(0) << 0.2, 0.3, std::complex<double>(0.0, 0.1);
  curve.harmonics.row(1) << -0.1, std::complex<double>(0.1, -0.2), 0.05;
  curve.harmonics.row(2) << 0.03, 0.004, 0.0;
  curve.harmonics.row(3) << 0.002, std::complex<double>(0.0, 0.001), 0.0;
  curve.harmonics.row(4) << 0.02, 0.0, 0.002;
  return curve;
}

/// A curve of constant states at this frequency.
inline model::NodeCurve constant_curve(double frequency, std::initializer_list<double> states) {
  model::NodeCurve curve{frequency, std::vector<int>(states.size(), 0),
                         Eigen::MatrixXcd(static_cast<Eigen::Index>(states.size()), 1), 0.0};
  Eigen::Index row = 0;
  for (const double state : states) {
    curve.harmonics(row++, 0) = state;
  }
  return curve;
}

/// The same one at all frequencies of a cell.
inline model::CurveFit constant_fit(double frequency, double half_width,
                                    std::initializer_list<double> states) {
  model::CurveFit fit;
  fit.frequency = frequency;
  fit.half_width = half_width;
  fit.turns.assign(states.size(), 0);
  fit.coefficients.assign(model::kNodes, Eigen::MatrixXcd::Zero(static_cast<Eigen::Index>(states.size()), 1));
  fit.coefficients[0] = constant_curve(frequency, states).harmonics;
  return fit;
}

/// The value of a row of harmonics, summed one after the other.
inline double summed(const Eigen::MatrixXcd& harmonics, Eigen::Index row, double phase) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < harmonics.cols(); ++i) {
    const double angle = static_cast<double>(i) * phase;
    sum += harmonics(row, i).real() * std::cos(angle) - harmonics(row, i).imag() * std::sin(angle);
  }
  return sum;
}

inline Eigen::Vector2d random_direction(Random& random) {
  const double angle = random.uniform(0.0, 6.283185307179586);
  return {std::cos(angle), std::sin(angle)};
}

/// A symmetric matrix between -I and I; both eigenvalues are -1 or 1.
inline Eigen::Matrix2d random_reflection(Random& random) {
  const Eigen::Vector2d axis = random_direction(random);
  const double first = random.below(2) == 0 ? 1.0 : -1.0;
  const double second = random.below(2) == 0 ? 1.0 : -1.0;
  return first * axis * axis.transpose() +
         second * (Eigen::Matrix2d::Identity() - Eigen::Matrix2d(axis * axis.transpose()));
}

/// L with L L' = matrix.
inline Eigen::Matrix2d lower_root(const Eigen::Matrix2d& matrix) {
  const double first = std::sqrt(matrix(0, 0));
  const double across = matrix(1, 0) / first;
  return Eigen::Matrix2d{{first, 0.0}, {across, std::sqrt(matrix(1, 1) - across * across)}};
}

/// Between both, at the rim.
inline Eigen::Matrix2d random_between(Random& random, const Eigen::Matrix2d& low,
                                      const Eigen::Matrix2d& high) {
  const Eigen::Matrix2d root = lower_root(0.5 * (high - low));
  return 0.5 * (high + low) + root * random_reflection(random) * root.transpose();
}

/// Of a symmetric matrix.
inline double least_of_both(const Eigen::Matrix2d& matrix) {
  const double mean = 0.5 * (matrix(0, 0) + matrix(1, 1));
  return mean - std::hypot(0.5 * (matrix(0, 0) - matrix(1, 1)), matrix(1, 0));
}

}  // namespace veritrack::test
