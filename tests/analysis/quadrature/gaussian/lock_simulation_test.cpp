// The program in Gaussian noise against the probability that was proved of it: a bound that is exceeded here
// is wrong. It is not tight, so that hardly any run leaves the set.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "analysis/quadrature/gaussian/lock_certificate.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/gaussian/lock_sets.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;
using Matrix = Eigen::Matrix3d;

Matrix matrix_of_block(const LevelCovariance<double>& p) {
  Matrix m;
  m << p.p11, p.p12, p.p13, p.p12, p.p22, p.p23, p.p13, p.p23, p.p33;
  return m;
}

Matrix turned_by(const Matrix& p, double angle) {
  Matrix turn = Matrix::Identity();
  turn(0, 0) = turn(1, 1) = std::cos(angle);
  turn(1, 0) = std::sin(angle);
  turn(0, 1) = -turn(1, 0);
  return turn * p * turn.transpose();
}

/// Of an estimate of a tone of amplitude 1, by textbook formulas.
double level_of_state(const LockSet& set, const trackers::QuadratureEstimate<double>& estimate, double phase,
                      double frequency) {
  const Eigen::Vector3d x = estimate.state();
  const double real = x[0] * std::cos(phase) + x[1] * std::sin(phase) - 1.0;
  const double imaginary = x[1] * std::cos(phase) - x[0] * std::sin(phase);
  const double nu = x[2] - frequency;
  const Matrix p = turned_by(estimate.covariance.matrix(), -phase);
  const auto largest = [](const Matrix& a, const Matrix& b) {
    return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>(a, b).eigenvalues()[2];
  };
  const double s = std::max({0.0, largest(p - matrix_of_block(set.centre), matrix_of_block(set.spread_above)),
                             largest(Matrix(p.inverse()) - Matrix(matrix_of_block(set.centre).inverse()),
                                     matrix_of_block(set.spread_below))});
  const double u1 = set.metric.amplitude * real;
  const double u2 = set.metric.phase * imaginary + set.metric.coupling * nu;
  const double u3 = set.metric.frequency * nu;
  return 0.5 * (u1 * u1 + u2 * u2 + u3 * u3 + set.weight * s * s);
}

}  // namespace

TEST_CASE("the program leaves the set no more often than is proved") {
  constexpr int kSamples = 100;
  constexpr double kDecibels = 18.0;
  const trackers::ToneModel<double>& d = test_sets::kDesigns[1];
  const Matrix steady = matrix_of_block(level_covariance(*steady_covariance(d)));
  const double deviation = std::sqrt(0.5 * std::pow(10.0, -kDecibels / 10.0));
  LockQuestion question;
  {
    const rigor::UpwardRounding upward;
    question.design = {Interval(d.q1), Interval(d.q2), Interval(d.r), Interval(0.0)};
    question.noise_deviation = Interval(deviation);
    question.frequency_walk = Interval(0.0);
    question.samples = Interval(static_cast<double>(kSamples));
    question.probability = 0.5;
    question.starts = {Interval(0.1),
                       Interval(0.15),
                       Interval(0.05),
                       {rigor::to_interval(steady), Interval::from_bounds(0.9, 1.1), true}};
  }
  const LockCertificate found = certify_lock(question);
  REQUIRE_FALSE(found.sets.empty());
  const double bound = theorems::find_quantity(found.derivation, "probability_of_losing_lock").value.upper();
  const double start = theorems::find_quantity(found.derivation, "start_level").value.upper();
  const double reach = theorems::find_quantity(found.derivation, "lock_frequency_error").value.upper();
  trackers::RandomStream noise(20261122);
  test::Random random(4390);
  const std::int64_t runs = test::effort(1000);
  std::int64_t lost = 0;
  double highest = 0.0;
  for (std::int64_t run = 0; run < runs; ++run) {
    const double frequency = random.uniform(0.0, 3.0);
    double phase = random.uniform(-3.0, 3.0);
    const auto end = [&](double x) { return random.uniform() < 0.5 ? -x : x; };
    const double estimated = phase + end(0.15);
    const double amplitude = 1.0 + end(0.1);
    trackers::QuadratureEkf<double> ekf(
        d, {amplitude * std::cos(estimated), amplitude * std::sin(estimated), frequency + end(0.05),
            trackers::FactoredCovariance<double>::from_matrix(
                turned_by(random.uniform(0.9, 1.1) * steady, estimated))});
    CHECK(level_of_state(found.sets.front(), ekf.filtered(), phase, frequency) <= start);
    bool left = false;
    for (int k = 0; k < kSamples && !left; ++k) {
      ekf.time_update();
      phase += frequency;
      ekf.measurement_update(std::cos(phase) + deviation * noise.normal(),
                             std::sin(phase) + deviation * noise.normal());
      const double level = level_of_state(found.sets.front(), ekf.filtered(), phase, frequency);
      highest = std::max(highest, level);
      left = level > found.sets.front().level;
      // In the set the frequency error is what is said of it.
      CHECK((left || std::fabs(ekf.filtered().state()[2] - frequency) <= reach));
    }
    lost += left ? 1 : 0;
  }
  MESSAGE(lost << " of " << runs << " runs left the set, at most " << bound << " of them proved; level "
               << highest << " of " << found.sets.front().level);
  // Five deviations of a binomial count more than its mean would be less than one in a million.
  const double mean = bound * static_cast<double>(runs);
  CHECK(static_cast<double>(lost) <= mean + 5.0 * std::sqrt(mean));
  CHECK(highest > 0.8 * start);
}

}  // namespace veritrack::quadrature
