#include "analysis/quadrature/gaussian/drift_inequality.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/gaussian/lock_sets.hpp"
#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;
using Matrix = Eigen::Matrix3d;

Matrix whole(const LevelCovariance<double>& p) {
  Matrix m;
  m << p.p11, p.p12, p.p13, p.p12, p.p22, p.p23, p.p13, p.p23, p.p33;
  return m;
}

/// The textbook filter and the Gaussian integral, for one error and covariance in the frame of the true
/// phase.
struct Oracle {
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
      return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>(x, y).eigenvalues()[2];
    };
    const double above = largest(p - whole(set.centre), whole(set.spread_above));
    const double below =
        largest(Matrix(p.inverse()) - Matrix(whole(set.centre).inverse()), whole(set.spread_below));
    return std::max({0.0, above, below});
  }
  /// log E[W(k+1)] - log(kappa W(k) + c_0).
  [[nodiscard]] double excess(const Eigen::Vector3d& away, const Matrix& p, double frequency = 0.0) const {
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
    const Eigen::Vector3d after = turn * mean - bias;
    const Eigen::Matrix<double, 3, 2> turned_gain = turn * gain;
    const Eigen::Vector3d e3(0.0, 0.0, 1.0);
    const Matrix sigma = set.noise_deviation * set.noise_deviation * turned_gain * turned_gain.transpose() +
                         set.frequency_walk * set.frequency_walk * e3 * e3.transpose();
    const Matrix m = weight();
    const double exponent = 0.5 * after.dot((Matrix(m.inverse()) - sigma).inverse() * after) -
                            0.5 * std::log((Matrix::Identity() - sigma * m).determinant());
    const double next = level_of(turn * filtered * turn.transpose());
    const double now = level_of(p);
    const double level = 0.5 * away.dot(m * away) + 0.5 * set.weight * now * now;
    return exponent + 0.5 * set.weight * next * next - level -
           std::log(set.decay + set.drift * std::exp(-level));
  }
};

/// A random covariance of a level of at most s: between lo(s) and hi(s).
Matrix covariance_of_level(const LockSet& set, double s, test::Random& random) {
  const Matrix high = whole(set.centre) + s * whole(set.spread_above);
  const Matrix low = (whole(set.centre).inverse() + s * whole(set.spread_below)).inverse();
  const Matrix root = Eigen::LLT<Matrix>(0.5 * (high - low) + 1e-12 * Matrix::Identity()).matrixL();
  Matrix random_matrix;
  for (int i = 0; i < 9; ++i) {
    random_matrix(i / 3, i % 3) = random.uniform(-1.0, 1.0);
  }
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(random_matrix + random_matrix.transpose());
  const Eigen::Vector3d signs(random.uniform(-1.0, 1.0) > 0.0 ? 1.0 : -1.0,
                              random.uniform(-1.0, 1.0) > 0.0 ? 1.0 : -1.0, random.uniform(-1.0, 1.0));
  const Matrix y = solver.eigenvectors() * signs.asDiagonal() * solver.eigenvectors().transpose();
  return 0.5 * (high + low) + root * y * root.transpose();
}

trackers::ToneModel<Interval> enclosed(const trackers::ToneModel<double>& design) {
  return {Interval(design.q1), Interval(design.q2), Interval(design.r), Interval(design.epsilon)};
}

/// A point of the set, and a cell around it.
struct Place {
  std::array<double, 4> x;
  LevelCell cell;
};
Place somewhere(const LockSet& set, double half_width, test::Random& random) {
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

}  // namespace

TEST_CASE("where a cell is proved, the Gaussian integral of the textbook filter keeps the inequality") {
  test::Random random(4310);
  for (std::size_t design = 0; design < 3; ++design) {
    for (const double walk : {0.0, 0.002}) {
      const bool leaks = design == 2;
      LockSet set = leaks ? test_sets::leaking_set() : test_sets::lock_set(design, 21.0);
      set.frequency_walk = walk;
      const trackers::ToneModel<double> model =
          leaks ? test_sets::kLeakingDesign : test_sets::kDesigns[design];
      const Oracle oracle{model, set};
      int proved = 0;
      double closest = -1e9;
      for (int k = 0; k < 60; ++k) {
        const Place place = somewhere(set, 0.06, random);
        CellDrift found;
        {
          const rigor::UpwardRounding upward;
          found = DriftInequality(enclosed(model), set).check(place.cell);
        }
        proved += found.holds ? 1 : 0;
        for (int l = 0; found.holds && l < 20; ++l) {
          std::array<double, 4> x{};
          for (std::size_t i = 0; i < 4; ++i) {
            x[i] = random.uniform(place.cell.low[i], place.cell.high[i]);
          }
          const std::array<double, 3> e = errors_of(set.metric, std::array<double, 3>{x[0], x[1], x[2]});
          const Matrix p = covariance_of_level(set, x[3], random);
          const double level = 0.5 * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + set.weight * x[3] * x[3]);
          if (level > set.level || oracle.level_of(p) < place.cell.low[3]) {
            continue;  // nothing is said of it
          }
          const double excess = oracle.excess({e[0], e[1], e[2]}, p,
                                              random.uniform(set.lowest_frequency, set.highest_frequency));
          CHECK(excess <= 0.0);
          closest = std::max(closest, excess);
        }
      }
      MESSAGE("design " << design << ", walk " << walk << ": " << proved << " of 60 cells proved, closest "
                        << closest);
      CHECK(proved > 20);
    }
  }
}

TEST_CASE("a cell with a point where the integral grows is not proved") {
  test::Random random(4311);
  // Far too much noise: 6 dB.
  const LockSet set = test_sets::lock_set(0, 6.0);
  const Oracle oracle{test_sets::kDesigns[0], set};
  int looked = 0;
  const rigor::UpwardRounding upward;
  const DriftInequality inequality(enclosed(test_sets::kDesigns[0]), set);
  for (int k = 0; k < 300; ++k) {
    const Place place = somewhere(set, 1e-3, random);
    const std::array<double, 3> e =
        errors_of(set.metric, std::array<double, 3>{place.x[0], place.x[1], place.x[2]});
    const Matrix p = covariance_of_level(set, place.x[3], random);
    const double level = oracle.level_of(p);
    if (level < place.cell.low[3] || level > place.cell.high[3] || is_outside(set, place.cell)) {
      continue;
    }
    const double excess = oracle.excess({e[0], e[1], e[2]}, p);
    if (!(excess <= 1e-3)) {
      ++looked;
      CHECK_FALSE(inequality.check(place.cell).holds);
    }
  }
  CHECK(looked > 20);
}

}  // namespace veritrack::quadrature
