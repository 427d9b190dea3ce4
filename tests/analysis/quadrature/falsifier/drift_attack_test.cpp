#include "analysis/quadrature/falsifier/drift_attack.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/gaussian/lock_sets.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::quadrature {
namespace {

/// A random design, and a set whose centre and spreads suit it; T so small that the mean's own variance is
/// moderate.
struct Draw {
  trackers::ToneModel<double> design;
  LockSet set;
  trackers::RotatingFrameState<double> state;
  DriftPoint point;
};
Draw draw(test::Random& random) {
  Draw result;
  const double q1 = std::exp(random.uniform(std::log(1e-4), std::log(1e-2)));
  const double q2 = std::exp(random.uniform(std::log(1e-4), std::log(1e-2)));
  const double r = std::exp(random.uniform(std::log(5e-3), std::log(5e-2)));
  result.design = {q1, q2, r, 0.0};
  LockSet& set = result.set;
  set.centre = level_covariance(*steady_covariance(result.design));
  const LevelCovariance<double>& p = set.centre;
  set.spread_above = {p.p11, p.p22, p.p23, p.p33};
  const double determinant = p.p22 * p.p33 - p.p23 * p.p23;
  set.spread_below = {1.0 / p.p11, p.p33 / determinant, -p.p23 / determinant, p.p22 / determinant};
  set.weight = random.uniform(0.1, 1.0);
  set.level = 10.0;
  set.decay = random.uniform(0.5, 1.0);
  set.drift = random.uniform(0.1, 1.0);
  set.noise_deviation = random.uniform(0.05, 0.2);
  set.frequency_walk = random.uniform(0.0, 0.02);
  set.metric = {random.uniform(0.5, 2.0), random.uniform(0.5, 2.0), random.uniform(-1.0, 1.0),
                random.uniform(0.5, 4.0)};
  const Eigen::Vector3d e(random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), random.uniform(-0.6, 0.6));
  const double scale = random.uniform(0.6, 1.8);
  const double turn = random.uniform(-0.5, 0.5);
  Eigen::Matrix3d covariance;
  covariance << p.p11, 0.0, 0.0, 0.0, p.p22, p.p23, 0.0, p.p23, p.p33;
  Eigen::Matrix3d u = Eigen::Matrix3d::Identity();
  u.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(turn).toRotationMatrix();
  covariance = scale * u * covariance * u.transpose();
  result.point = {e, covariance};
  result.state << e, covariance(0, 0), covariance(0, 1), covariance(0, 2), covariance(1, 1), covariance(1, 2),
      covariance(2, 2);
  return result;
}

double level_of(const LockSet& set, const Eigen::Matrix3d& p) {
  Eigen::Matrix3d centre;
  centre << set.centre.p11, 0.0, 0.0, 0.0, set.centre.p22, set.centre.p23, 0.0, set.centre.p23,
      set.centre.p33;
  // D_h is P_0 and D_l its inverse: the level is that of the eigenvalues of P_0^-1 P.
  const Eigen::Vector3d values = oracle::relative_eigenvalues(p, centre);
  return std::max({0.0, values[2] - 1.0, 1.0 / values[0] - 1.0});
}

double half_square(const LockSet& set, const Eigen::Vector3d& e) {
  const double u1 = set.metric.amplitude * e[0];
  const double u2 = set.metric.phase * e[1] + set.metric.coupling * e[2];
  const double u3 = set.metric.frequency * e[2];
  return 0.5 * (u1 * u1 + u2 * u2 + u3 * u3);
}

}  // namespace

TEST_CASE("the Gaussian integral is the mean over steps of the program, for random designs and states") {
  test::Random random(4360);
  trackers::RandomStream noise(4361);
  const std::int64_t places = test::effort(10);
  for (std::int64_t place = 0; place < places; ++place) {
    const Draw at = draw(random);
    const LockSet& set = at.set;
    constexpr int kDraws = 20'000;
    double sum = 0.0;
    double squares = 0.0;
    double next_level = 0.0;
    for (int k = 0; k < kDraws; ++k) {
      const trackers::RotatingFrameState<double> next = trackers::rotating_frame_map(
          at.state,
          {set.noise_deviation * noise.normal(), set.noise_deviation * noise.normal(),
           set.frequency_walk * noise.normal(), 1.0},
          at.design);
      Eigen::Matrix3d p;
      p << next(3), next(4), next(5), next(4), next(6), next(7), next(5), next(7), next(8);
      next_level = level_of(set, p);
      const double value = std::exp(half_square(set, next.head<3>()));
      sum += value;
      squares += value * value;
    }
    const double mean = sum / kDraws;
    const double error = std::sqrt((squares / kDraws - mean * mean) / kDraws);
    const double now = level_of(set, at.point.covariance);
    const double level = half_square(set, at.point.error) + 0.5 * set.weight * now * now;
    const double simulated = mean * std::exp(0.5 * set.weight * next_level * next_level);
    const double formula =
        std::exp(drift_excess(set, at.design, at.point)) * (set.decay * std::exp(level) + set.drift);
    CHECK(formula / simulated == doctest::Approx(1.0).epsilon(5.0 * error / mean));
  }
}

TEST_CASE("no ascent breaks the inequality of a set that is proved, and one breaks it where it is false") {
  for (std::size_t design = 0; design < 2; ++design) {
    const DriftAttack found = attack_drift(test_sets::lock_set(design, 20.0), test_sets::kDesigns[design],
                                           static_cast<int>(test::effort(20)));
    MESSAGE("design " << design << ": closest " << found.closest << " after " << found.evaluations);
    CHECK(found.closest < 0.0);
    CHECK(found.closest > -0.5);
    const DriftAttack noisy = attack_drift(test_sets::lock_set(design, 12.0), test_sets::kDesigns[design], 5);
    CHECK(noisy.closest > 0.0);
    // What it says can be repeated.
    CHECK(drift_excess(test_sets::lock_set(design, 12.0), test_sets::kDesigns[design], noisy.point) ==
          noisy.closest);
  }
}

TEST_CASE("where the expected value is infinite the excess is, too") {
  LockSet set = test_sets::lock_set(0, -10.0);
  Eigen::Matrix3d p;
  p << set.centre.p11, 0.0, 0.0, 0.0, set.centre.p22, set.centre.p23, 0.0, set.centre.p23, set.centre.p33;
  CHECK(std::isinf(drift_excess(set, test_sets::kDesigns[0], {Eigen::Vector3d::Zero(), p})));
}

}  // namespace veritrack::quadrature
