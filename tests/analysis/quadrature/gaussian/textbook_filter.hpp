// The textbook filter and the Gaussian integral, in the frame of the true phase, and random points of a lock
// set: for tests.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/quadrature/gaussian/level_cell.hpp"
#include "analysis/quadrature/gaussian/lock_set.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::quadrature::test_sets {

using Matrix = Eigen::Matrix3d;

inline Matrix whole(const LevelCovariance<double>& p) {
  Matrix m;
  m << p.p11, p.p12, p.p13, p.p12, p.p22, p.p23, p.p13, p.p23, p.p33;
  return m;
}

/// The textbook filter and the Gaussian integral, for one error and covariance in the frame of the true
/// phase.
struct TextbookFilter {
  trackers::ToneModel<double> design;
  LockSet set;

  [[nodiscard]] Matrix weight() const {
    Matrix t;
    t << set.metric.amplitude, 0.0, 0.0, 0.0, set.metric.phase, set.metric.coupling, 0.0, 0.0,
        set.metric.frequency;
    return t.transpose() * t;
  }
  [[nodiscard]] double level_of(const Matrix& p) const {
    const auto largest = [](const Matrix& x, const Matrix& y) {
      return oracle::relative_eigenvalues(x, y)[2];
    };
    const double above = largest(p - whole(set.centre), whole(set.spread_above));
    const double below =
        largest(Matrix(p.inverse()) - Matrix(whole(set.centre).inverse()), whole(set.spread_below));
    return std::max({0.0, above, below});
  }
  /// The error is Gaussian after the step: its mean, less the bias, and its covariance; and the level of P+.
  struct Next {
    Eigen::Vector3d mean;
    Matrix sigma;
    double level;
  };
  [[nodiscard]] Next step(const Eigen::Vector3d& away, const Matrix& p, double frequency) const {
    const Eigen::Vector3d bias(set.bias[0], set.bias[1], set.bias[2]);
    const Eigen::Vector3d e = away + bias;
    Matrix f = Matrix::Identity();
    f(2, 2) = 1.0 - design.epsilon;
    f(0, 2) = -e[1];
    f(1, 2) = 1.0 + e[0];
    const Matrix predicted =
        f * p * f.transpose() + Eigen::Vector3d(design.q1, design.q1, design.q2).asDiagonal().toDenseMatrix();
    Eigen::Matrix<double, 2, 3> h = Eigen::Matrix<double, 2, 3>::Zero();
    h(0, 0) = h(1, 1) = 1.0;
    const Eigen::Matrix2d s = h * predicted * h.transpose() + design.r * Eigen::Matrix2d::Identity();
    const Eigen::Matrix<double, 3, 2> gain = predicted * h.transpose() * s.inverse();
    const Matrix filtered = predicted - gain * h * predicted;
    const Eigen::Vector3d error(1.0 + e[0] - std::cos(e[2]), e[1] + std::sin(e[2]),
                                (1.0 - design.epsilon) * e[2] - design.epsilon * frequency);
    const Eigen::Vector3d mean = error - gain * (h * error);
    Matrix turn = Matrix::Identity();
    turn(0, 0) = turn(1, 1) = std::cos(e[2]);
    turn(1, 0) = std::sin(e[2]);
    turn(0, 1) = -turn(1, 0);
    const Eigen::Matrix<double, 3, 2> turned_gain = turn * gain;
    const Eigen::Vector3d e3(0.0, 0.0, 1.0);
    const Matrix sigma = set.noise_deviation * set.noise_deviation * turned_gain * turned_gain.transpose() +
                         set.frequency_walk * set.frequency_walk * e3 * e3.transpose();
    return {turn * mean - bias, sigma, level_of(turn * filtered * turn.transpose())};
  }
  /// log E[W(k+1)] - log(kappa W(k) + c_0).
  [[nodiscard]] double excess(const Eigen::Vector3d& away, const Matrix& p, double frequency = 0.0) const {
    const auto [after, sigma, next] = step(away, p, frequency);
    const Matrix m = weight();
    const double exponent = 0.5 * after.dot((Matrix(m.inverse()) - sigma).inverse() * after) -
                            0.5 * std::log((Matrix::Identity() - sigma * m).determinant());
    const double now = level_of(p);
    const double level = 0.5 * away.dot(m * away) + 0.5 * set.weight * now * now;
    return exponent + 0.5 * set.weight * next * next - level -
           std::log(set.decay + set.drift * std::exp(-level));
  }
};

/// A random covariance of a level of at most s: between lo(s) and hi(s).
inline Matrix covariance_of_level(const LockSet& set, double s, test::Random& random) {
  const Matrix high = whole(set.centre) + s * whole(set.spread_above);
  const Matrix low = (whole(set.centre).inverse() + s * whole(set.spread_below)).inverse();
  const Matrix root = oracle::cholesky_factor(0.5 * (high - low) + 1e-12 * Matrix::Identity());
  Matrix random_matrix;
  for (int i = 0; i < 9; ++i) {
    random_matrix(i / 3, i % 3) = random.uniform(-1.0, 1.0);
  }
  const Matrix directions = oracle::symmetric_eigenvectors(random_matrix + random_matrix.transpose());
  const Eigen::Vector3d signs(random.uniform(-1.0, 1.0) > 0.0 ? 1.0 : -1.0,
                              random.uniform(-1.0, 1.0) > 0.0 ? 1.0 : -1.0, random.uniform(-1.0, 1.0));
  const Matrix y = directions * signs.asDiagonal() * directions.transpose();
  return 0.5 * (high + low) + root * y * root.transpose();
}

inline trackers::ToneModel<rigor::Interval> enclosed(const trackers::ToneModel<double>& design) {
  using rigor::Interval;
  return {Interval(design.q1), Interval(design.q2), Interval(design.r), Interval(design.epsilon)};
}

/// A point of the set, and a cell around it.
struct Place {
  std::array<double, 4> x;
  LevelCell cell;
};
inline Place somewhere(const LockSet& set, double half_width, test::Random& random) {
  Place place{};
  double length = 0.0;
  for (double& value : place.x) {
    value = random.uniform(-1.0, 1.0);
    length += value * value;
  }
  const double radius = std::sqrt(2.0 * set.level * random.uniform(0.0, 1.0) / length);
  for (std::size_t i = 0; i < 4; ++i) {
    place.x[i] *= radius;
    if (i == 3) {
      place.x[i] = std::fabs(place.x[i]) / std::sqrt(set.weight) + half_width;
    }
    place.cell.low[i] = place.x[i] - half_width;
    place.cell.high[i] = place.x[i] + half_width;
  }
  return place;
}

}  // namespace veritrack::quadrature::test_sets
