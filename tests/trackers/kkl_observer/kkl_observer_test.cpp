#include "trackers/kkl_observer/kkl_observer.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/matrix.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "trackers/kkl_observer/adaptive_oscillator_observer.hpp"

namespace veritrack::trackers {
namespace {

using Design = KklObserverDesign<double, 4>;

Eigen::Vector4d random_rates(test::Random& random) {
  Eigen::Vector4d lambda;
  double rate = 0.0;
  for (int i = 0; i < 4; ++i) {
    rate += random.uniform(0.5, 1.5);
    lambda(i) = rate;
  }
  return lambda;
}

TEST_CASE("T solves its equation, the excitation is det(L'L), and gamma inverts T, for random filters") {
  test::Random random(3);
  for (std::int64_t trial = 0; trial < test::effort(300); ++trial) {
    CAPTURE(trial);
    const Eigen::Vector4d lambda = random_rates(random);
    const double amplitude = random.uniform(0.1, 10.0);
    const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double frequency = random.uniform(0.5, 4.0);
    const auto x = oscillator_state(amplitude, phase, frequency);
    const Eigen::Vector4d xi = kkl_transform<double, 4>(x, lambda);
    // (3), with the time derivative taken by a central difference of the phase
    constexpr double kStep = 1e-6;
    const Eigen::Vector4d slope =
        (kkl_transform<double, 4>(oscillator_state(amplitude, phase + frequency * kStep, frequency), lambda) -
         kkl_transform<double, 4>(oscillator_state(amplitude, phase - frequency * kStep, frequency),
                                  lambda)) /
        (2.0 * kStep);
    CHECK((slope + lambda.cwiseProduct(xi) - Eigen::Vector4d::Constant(x(0))).norm() < 1e-7 * amplitude);

    Eigen::Matrix<double, 4, 3> l;
    l << lambda, Eigen::Vector4d::Ones(), -xi;
    const double determinant = (l.transpose() * l).determinant();
    CHECK(kkl_excitation<double, 4>(xi, lambda) ==
          doctest::Approx(determinant).epsilon(1e-6).scale(1e-3 * amplitude * amplitude));

    const auto inverse = kkl_inverse<double, 4>(xi, Design{lambda, 0.0});
    const auto estimate = in_engineering_units(inverse);
    CHECK(estimate.frequency == doctest::Approx(frequency).epsilon(1e-6));
    CHECK(estimate.amplitude == doctest::Approx(amplitude).epsilon(1e-6));
    CHECK(std::cos(estimate.phase - phase) == doctest::Approx(1.0).epsilon(1e-9));
  }
}

TEST_CASE("gamma solves (15) with mu, against a dense solver") {
  test::Random random(4);
  for (std::int64_t trial = 0; trial < test::effort(200); ++trial) {
    const Design design{random_rates(random), random.uniform(0.1, 5.0)};
    const Eigen::Vector4d xi = Eigen::Vector4d::NullaryExpr([&] { return random.uniform(-1.0, 1.0); });
    Eigen::Matrix<double, 4, 3> l;
    l << design.lambda, Eigen::Vector4d::Ones(), -xi;
    const double mu = kkl_regularization<double, 4>(xi, design);
    const Eigen::Matrix3d phi = l.transpose() * l + mu * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d expected =
        oracle::solution(phi, l.transpose() * design.lambda.cwiseAbs2().cwiseProduct(xi));
    CHECK((kkl_inverse<double, 4>(xi, design) - expected).norm() <= 1e-8 * (1.0 + expected.norm()));
  }
}

TEST_CASE("the discretisation is exact: against the filters' integral, step by step") {
  const Eigen::Vector4d lambda(1.0, 2.0, 3.0, 4.0);
  constexpr double kInterval = 0.3;
  const KklDiscretization<double, 4> discretization(lambda, kInterval);
  const Eigen::Vector4d start(0.3, -0.2, 0.1, 1.0);
  const auto integrate = [&](double first, double last) {
    Eigen::Vector4d xi = start;
    constexpr int kSteps = 20000;
    const double h = kInterval / kSteps;
    for (int k = 0; k < kSteps; ++k) {  // the midpoint rule, of second order
      const double y = first + (last - first) * (k + 0.5) / kSteps;
      const Eigen::Vector4d middle = xi + 0.5 * h * (Eigen::Vector4d::Constant(y) - lambda.cwiseProduct(xi));
      xi += h * (Eigen::Vector4d::Constant(y) - lambda.cwiseProduct(middle));
    }
    return xi;
  };
  CHECK((discretization.held(start, 1.7) - integrate(1.7, 1.7)).norm() < 1e-8);
  CHECK((discretization.interpolated(start, -0.4, 1.1) - integrate(-0.4, 1.1)).norm() < 1e-8);
  const KklDiscretization<double, 4> half(lambda, 0.5 * kInterval);
  const Eigen::Vector4d twice = half.interpolated(half.interpolated(start, -0.4, 0.35), 0.35, 1.1);
  CHECK((discretization.interpolated(start, -0.4, 1.1) - twice).norm() < 1e-12);
}

TEST_CASE("the observer finds a sinusoid, over double and inside intervals") {
  constexpr double kInterval = 1e-3;
  KklObserver<double> observer({Eigen::Vector4d(1.0, 2.0, 3.0, 4.0), 1e-3}, kInterval);
  const rigor::UpwardRounding upward;
  const rigor::IntervalVector<4> rates = rigor::to_interval(Eigen::Vector4d(1.0, 2.0, 3.0, 4.0));
  KklObserver<rigor::Interval> enclosed({rates, rigor::Interval(1e-3)}, rigor::Interval(kInterval));
  double last = 0.0;
  constexpr int kSteps = 20000;
  for (int k = 1; k <= kSteps; ++k) {
    const double y = 2.0 * std::sin(3.0 * kInterval * k);
    observer.step_interpolated(last, y);
    enclosed.step_interpolated(rigor::Interval(last), rigor::Interval(y));
    last = y;
  }
  const auto estimate = observer.estimate();
  CHECK(estimate.frequency == doctest::Approx(3.0).epsilon(1e-4));
  CHECK(estimate.amplitude == doctest::Approx(2.0).epsilon(1e-4));
  CHECK(std::cos(estimate.phase - 3.0 * kInterval * kSteps) == doctest::Approx(1.0).epsilon(1e-6));
  for (int i = 0; i < 4; ++i) {
    CHECK(observer.filters()(i) == doctest::Approx(rigor::midpoint(enclosed.filters()(i))).epsilon(1e-9));
  }
  const auto inside = enclosed.estimate();
  CHECK(rigor::is_finite(inside.frequency));
  CHECK(rigor::midpoint(inside.frequency) == doctest::Approx(estimate.frequency).epsilon(1e-6));
}

TEST_CASE("six filters invert as well") {
  Eigen::Matrix<double, 6, 1> lambda;
  lambda << 0.5, 1.0, 2.0, 3.0, 4.5, 6.0;
  const auto x = oscillator_state(1.5, 0.7, 2.0);
  const Eigen::Matrix<double, 6, 1> xi = kkl_transform<double, 6>(x, lambda);
  const auto inverse = kkl_inverse<double, 6>(xi, KklObserverDesign<double, 6>{lambda, 0.0});
  CHECK((inverse - x).norm() < 1e-8);
}

TEST_CASE("the adaptive observer's equilibrium is the true parameter") {
  // Filters and z follow the signal; started there it stays, whatever the gains.
  constexpr double kInterval = 1e-3;
  AdaptiveOscillatorObserver observer({5.0, 1.0, Eigen::Vector3d(1.0, 1.0, 1.0)}, 2.0, kInterval);
  double last = 0.0;
  double sum = 0.0;
  int count = 0;
  for (int k = 1; k <= 300000; ++k) {
    const double y = 2.0 * std::sin(3.0 * kInterval * k);
    observer.step(last, y);
    last = y;
    if (k > 280000) {
      sum += observer.frequency();
      ++count;
    }
  }
  CHECK(sum / count == doctest::Approx(3.0).epsilon(0.02));
}

}  // namespace
}  // namespace veritrack::trackers
