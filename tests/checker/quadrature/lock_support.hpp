// Sets for Gaussian noise as certificates write them, and the textbook filter beside them: for tests.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "checker/document/json_tree.hpp"
#include "checker/quadrature/lock_step.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::checker::lock_test {

using Rows = std::array<std::array<std::string, 3>, 3>;

/// Of the design of La Scala's Figure 3.4 without its leak, at 22 dB, the frequency walking by 0.0036 a
/// sample.
struct WrittenSet {
  std::map<std::string, Rows> matrices{{"metric",
                                        {{{"0x1.9ce6f7a86e42dp+3", "0x0p+0", "0x0p+0"},
                                          {"0x0p+0", "0x1.e9c16b03bc281p+3", "-0x1.cf59f82b18cb9p+3"},
                                          {"0x0p+0", "0x0p+0", "0x1.79de63862c32ap+4"}}}},
                                       {"centre",
                                        {{{"0x1.8b0216205dfc8p-9", "0x0p+0", "0x0p+0"},
                                          {"0x0p+0", "0x1.8cf8e8b5e6a7ap-8", "0x1.28bdb21c8cf98p-9"},
                                          {"0x0p+0", "0x1.28bdb21c8cf98p-9", "0x1.c7e56a10403f3p-9"}}}},
                                       {"spread_above",
                                        {{{"0x1.0a5be83dfb60ep-9", "0x0p+0", "0x0p+0"},
                                          {"0x0p+0", "0x1.ca6b6fddebc7p-10", "0x1.cecead954647ep-11"},
                                          {"0x0p+0", "0x1.cecead954647ep-11", "0x1.35d83769f8276p-10"}}}},
                                       {"spread_below",
                                        {{{"0x1.07144d11212bfp+6", "0x0p+0", "0x0p+0"},
                                          {"0x0p+0", "0x1.3766ee597b911p+6", "0x1.9e6a9c9c8602cp+4"},
                                          {"0x0p+0", "0x1.9e6a9c9c8602cp+4", "0x1.cd9cdf1c2647fp+6"}}}}};
  std::map<std::string, std::string> numbers{{"weight", "0x1.15e35e3d9af1bp+1"},
                                             {"level", "0x1.4p+2"},
                                             {"decay", "0x1.f8p-1"},
                                             {"drift", "0x1p-1"},
                                             {"noise_deviation", "0x1.cc1fc5972b38ap-5"},
                                             {"frequency_walk", "0x1.d7dbf487fcb92p-9"}};

  [[nodiscard]] Tree tree() const { return read_json(text()); }
  [[nodiscard]] std::string text() const {
    std::string text;
    for (const auto& [name, rows] : matrices) {
      text += (text.empty() ? "{\"" : ", \"") + name + "\": [";
      for (std::size_t i = 0; i < 3; ++i) {
        text +=
            (i == 0 ? "[\"" : ", [\"") + rows[i][0] + "\", \"" + rows[i][1] + "\", \"" + rows[i][2] + "\"]";
      }
      text += "]";
    }
    for (const auto& [name, number] : numbers) {
      text += ", \"" + name + "\": \"" + number + "\"";
    }
    return text + "}";
  }
  [[nodiscard]] LockSet set() const {
    const auto entry = [&](const char* name, std::size_t i, std::size_t j) {
      return from_hexadecimal(matrices.at(name)[i][j]);
    };
    const auto covariance = [&](const char* name) {
      return LockCovariance{entry(name, 0, 0), entry(name, 1, 1), entry(name, 1, 2),
                            entry(name, 2, 2), entry(name, 0, 1), entry(name, 0, 2)};
    };
    const auto number = [&](const char* name) { return from_hexadecimal(numbers.at(name)); };
    return {{entry("metric", 0, 0), entry("metric", 1, 1), entry("metric", 1, 2), entry("metric", 2, 2)},
            covariance("centre"),
            covariance("spread_above"),
            covariance("spread_below"),
            number("weight"),
            number("level"),
            number("decay"),
            number("drift"),
            number("noise_deviation"),
            number("frequency_walk")};
  }
};

/// Variances of the filter.
struct Variances {
  double q1 = 0.0013, q2 = 0.0013, r = 0.01, epsilon = 0.0;
  [[nodiscard]] LockFilter filter() const { return {Ball(q1), Ball(q2), Ball(r), Ball(epsilon)}; }
};

using Matrix = Eigen::Matrix3d;
using Vector = Eigen::Vector3d;

inline Matrix in_double(const LockCovariance& p) {
  Matrix m;
  m << p.p11.near(), p.p12.near(), p.p13.near(), p.p12.near(), p.p22.near(), p.p23.near(), p.p13.near(),
      p.p23.near(), p.p33.near();
  return m;
}

/// The textbook filter in the frame of the true phase, and the Gaussian integral.
struct Textbook {
  Variances design;
  LockSet set;

  [[nodiscard]] Matrix metric() const {
    Matrix t;
    t << set.metric.amplitude.near(), 0.0, 0.0, 0.0, set.metric.phase.near(), set.metric.coupling.near(), 0.0,
        0.0, set.metric.frequency.near();
    return t;
  }
  [[nodiscard]] Matrix high(double s) const { return in_double(set.centre) + s * in_double(set.above); }
  [[nodiscard]] Matrix low(double s) const {
    return (in_double(set.centre).inverse() + s * in_double(set.below)).inverse();
  }
  [[nodiscard]] double level_of(const Matrix& p) const {
    const auto largest = [](const Matrix& x, const Matrix& y) {
      return oracle::relative_eigenvalues(x, y)[2];
    };
    return std::max(
        {0.0, largest(p - in_double(set.centre), in_double(set.above)),
         largest(Matrix(p.inverse()) - Matrix(in_double(set.centre).inverse()), in_double(set.below))});
  }

  struct Step {
    Matrix covariance;                 ///< Psi
    Vector mean;                       ///< m less the bias
    Eigen::Matrix<double, 3, 2> gain;  ///< K
    Eigen::Vector2d prediction;        ///< p_z
  };
  [[nodiscard]] Vector bias() const { return {set.bias[0].near(), set.bias[1].near(), set.bias[2].near()}; }
  /// From errors away from the bias.
  [[nodiscard]] Step step(const Vector& away, const Matrix& p, double frequency = 0.0) const {
    const Vector e = away + bias();
    Matrix f = Matrix::Identity();
    f(2, 2) = 1.0 - design.epsilon;
    f(0, 2) = -e[1];
    f(1, 2) = 1.0 + e[0];
    const Matrix predicted =
        f * p * f.transpose() + Vector(design.q1, design.q1, design.q2).asDiagonal().toDenseMatrix();
    Eigen::Matrix<double, 2, 3> h = Eigen::Matrix<double, 2, 3>::Zero();
    h(0, 0) = h(1, 1) = 1.0;
    const Eigen::Matrix2d s = h * predicted * h.transpose() + design.r * Eigen::Matrix2d::Identity();
    const Eigen::Matrix<double, 3, 2> gain = predicted * h.transpose() * s.inverse();
    const Vector error(1.0 + e[0] - std::cos(e[2]), e[1] + std::sin(e[2]),
                       (1.0 - design.epsilon) * e[2] - design.epsilon * frequency);
    Matrix turn = Matrix::Identity();
    turn(0, 0) = turn(1, 1) = std::cos(e[2]);
    turn(1, 0) = std::sin(e[2]);
    turn(0, 1) = -turn(1, 0);
    const Vector moved = turn * error;
    return {turn * (predicted - gain * h * predicted) * turn.transpose(),
            turn * (error - gain * (h * error)) - bias(), turn * gain, moved.head<2>()};
  }
  /// log E[W(k+1)] - log(kappa W(k) + c_0), from a covariance of this level.
  [[nodiscard]] double excess(const Vector& e, const Matrix& p, double s, double frequency = 0.0) const {
    const Step after = step(e, p, frequency);
    const Vector e3(0.0, 0.0, 1.0);
    const double deviation = set.deviation.near();
    const double walk = set.walk.near();
    const Matrix sigma =
        deviation * deviation * after.gain * after.gain.transpose() + walk * walk * e3 * e3.transpose();
    const Matrix m = metric().transpose() * metric();
    const double exponent = 0.5 * after.mean.dot((Matrix(m.inverse()) - sigma).inverse() * after.mean) -
                            0.5 * std::log((Matrix::Identity() - sigma * m).determinant());
    const double next = level_of(after.covariance);
    const double weight = set.weight.near();
    const double level = 0.5 * e.dot(m * e) + 0.5 * weight * s * s;
    return exponent + 0.5 * weight * next * next - level -
           std::log(set.decay.near() + set.drift.near() * std::exp(-level));
  }

  /// A random covariance of a level of at most s.
  [[nodiscard]] Matrix covariance_of_level(double s, test::Random& random) const {
    const Matrix spread = 0.5 * (high(s) - low(s));
    const Matrix root = oracle::cholesky_factor(spread + 1e-12 * Matrix::Identity());
    Matrix entries;
    for (int i = 0; i < 9; ++i) {
      entries(i / 3, i % 3) = random.uniform(-1.0, 1.0);
    }
    const Matrix directions = oracle::symmetric_eigenvectors(entries + entries.transpose());
    const Vector signs(random.uniform(-1.0, 1.0) > 0.0 ? 1.0 : -1.0,
                       random.uniform(-1.0, 1.0) > 0.0 ? 1.0 : -1.0, random.uniform(-1.0, 1.0));
    return 0.5 * (high(s) + low(s)) +
           root * directions * signs.asDiagonal() * directions.transpose() * root.transpose();
  }
};

/// The same set with a leak, for frequencies about 1.5 rad/sample, and its filter.
inline constexpr double kLeak = 0.01;
inline LockSet leaking_set() {
  LockSet set = WrittenSet().set();
  set.walk = zero;
  // As the covariance of the steady state there.
  for (LockCovariance* p : {&set.centre, &set.above}) {
    p->p12 = Ball(0.06) * sqrt(p->p11 * p->p22);
    p->p13 = Ball(0.05) * sqrt(p->p11 * p->p33);
  }
  set.below.p12 = Ball(-0.06) * sqrt(set.below.p11 * set.below.p22);
  set.bias = {Ball(0.002), Ball(-0.0265), Ball(-0.04)};
  set.lowest_frequency = Ball(1.4);
  set.highest_frequency = Ball(1.6);
  return set;
}
inline Variances leaking_variances() {
  Variances variances;
  variances.epsilon = kLeak;
  return variances;
}

/// A point (u, s) of the set.
inline std::array<double, 4> somewhere(const LockSet& set, test::Random& random) {
  std::array<double, 4> x{};
  double length = 0.0;
  for (double& value : x) {
    value = random.uniform(-1.0, 1.0);
    length += value * value;
  }
  for (double& value : x) {
    value *= std::sqrt(2.0 * set.level.near() * random.uniform(0.0, 1.0) / length);
  }
  x[3] = std::fabs(x[3]) / std::sqrt(set.weight.near());
  return x;
}

}  // namespace veritrack::checker::lock_test
