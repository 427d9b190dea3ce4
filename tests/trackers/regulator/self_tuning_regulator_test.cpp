#include "trackers/regulator/self_tuning_regulator.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "trackers/regulator/vibrating_plant.hpp"

namespace veritrack::trackers {
namespace {

using test::Random;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Complex = std::complex<double>;
constexpr double kOmega = std::numbers::pi / 6.0;

Vector6 random_vector(Random& random, double size) {
  Vector6 v;
  for (int i = 0; i < 6; ++i) {
    v(i) = random.uniform(-size, size);
  }
  return v;
}

/// Eigenvalues uniform in [low, high].
Matrix6 random_with_eigenvalues(Random& random, double low, double high) {
  Matrix6 a;
  Vector6 values;
  for (int i = 0; i < 36; ++i) {
    a(i) = random.uniform(-1.0, 1.0);
  }
  for (int i = 0; i < 6; ++i) {
    values(i) = random.uniform(low, high);
  }
  const Matrix6 q = oracle::orthogonal_factor(a);
  const Matrix6 p = q * values.asDiagonal() * q.transpose();
  return 0.5 * (p + p.transpose());
}

double condition(const Matrix6& p) {
  const Vector6 values = oracle::symmetric_eigenvalues(p);
  return values(5) / values(0);
}

TEST_CASE("without its limit, monitored least squares minimises the sum of squares") {
  Random random(421);
  for (int run = 0; run < 50; ++run) {
    const Vector6 theta = random_vector(random, 2.0);
    const Matrix6 p = random_with_eigenvalues(random, 0.1, 3.0);
    MonitoredLeastSquares<double, 3> estimator(theta, p, 1.0, 1e300);
    Matrix6 information = oracle::inverse(p);
    Vector6 weighted = information * theta;
    double product = 1.0;
    for (int k = 0; k < 40; ++k) {
      const Vector6 phi = random_vector(random, 1.0);
      const double y = random.uniform(-1.0, 1.0);
      const Matrix6 before = oracle::inverse(information);
      product *= 1.0 + phi.dot(before * phi);
      information += phi * phi.transpose();
      weighted += phi * y;
      estimator.update(phi, y);
    }
    CHECK((estimator.theta() - oracle::solution(information, weighted)).norm() <= 1e-9);
    CHECK((estimator.covariance() - oracle::inverse(information)).norm() <= 1e-9);
    CHECK(estimator.normalisation() == doctest::Approx(product));
    // r = det P_{-1} / det P: the determinant of a rank-one update.
    CHECK(estimator.normalisation() ==
          doctest::Approx(oracle::determinant(p) / oracle::determinant(estimator.covariance())));
  }
}

TEST_CASE("monitoring bounds r lambda_max(P), and not the condition number") {
  Random random(422);
  for (int run = 0; run < 20; ++run) {
    MonitoredLeastSquares<double, 3> estimator(random_vector(random, 1.0), Matrix6::Identity(), 1.0, 5.0);
    double trace = 6.0;  // of R, from R_{-1} = I
    for (int k = 0; k < 100; ++k) {
      const Vector6 phi = random_vector(random, 3.0);
      const double before = estimator.normalisation();
      estimator.update(phi, random.uniform(-1.0, 1.0));
      trace += phi.squaredNorm();
      const double largest = oracle::largest_eigenvalue(estimator.covariance());
      CHECK(estimator.normalisation() * largest <= 5.0 * (1.0 + 1e-12));
      CHECK(estimator.normalisation() >= before);
      CHECK(estimator.normalisation() <= 5.0 * trace);
    }
  }
  // One direction for ever: P shrinks along it and only there, but for a common factor.
  MonitoredLeastSquares<double, 3> estimator(Vector6::Zero(), Matrix6::Identity(), 1.0, 5.0);
  for (int k = 0; k < 2000; ++k) {
    estimator.update(Vector6::Unit(2) * 10.0, 0.0);
  }
  CHECK(condition(estimator.covariance()) > 1e3);
}

TEST_CASE(
    "the bounds of EFRA: the fixed points, the printed numbers, and where the printed formula goes wrong") {
  const auto design = thesis_efra_design<double>();
  const auto bounds = efra_bounds(design);
  CHECK(efra_keeps_bounds(design));
  const double gamma = 0.05 / 0.95;
  const auto free = [&](double p) { return p / 0.95 + 0.005 - 0.005 * p * p; };
  const auto excited = [&](double p) { return (1.0 / 0.95 - 0.5) * p + 0.005 - 0.005 * p * p; };
  CHECK(free(bounds.upper) == doctest::Approx(bounds.upper));
  CHECK(excited(bounds.lower) == doctest::Approx(bounds.lower));
  CHECK(bounds.lower == doctest::Approx(0.0111752).epsilon(1e-4));  // printed 0.011
  CHECK(bounds.upper == doctest::Approx(10.6205).epsilon(1e-4));    // printed 10.1
  const double printed =
      (0.5 - gamma) / 0.01 * (-1.0 + std::sqrt(1.0 + 4.0 * 0.005 * 0.005 / (gamma * gamma)));
  CHECK(printed == doctest::Approx(0.80).epsilon(0.01));
}

TEST_CASE("EFRA keeps its bounds under any excitation, for any design that keeps them") {
  Random random(423);
  int kept = 0;
  for (int run = 0; run < 400; ++run) {
    const EfraDesign<double> design{random.uniform(0.05, 0.9), random.uniform(1e-4, 0.05),
                                    random.uniform(0.6, 0.99), random.uniform(1e-4, 0.05)};
    if (!efra_keeps_bounds(design)) {
      continue;
    }
    ++kept;
    const auto [lower, upper] = efra_bounds(design);
    const Matrix6 start = random_with_eigenvalues(random, lower, upper);
    const Vector6 theta = random_vector(random, 1.0);
    EfraLeastSquares<double, 3> estimator(design, theta, start);
    for (int k = 0; k < 60; ++k) {
      const Vector6 phi = random_vector(random, 1.0) * std::pow(10.0, random.uniform(-3.0, 4.0));
      const Matrix6 p = estimator.covariance();
      const Vector6 before = estimator.theta();
      const double y = random.uniform(-1.0, 1.0);
      estimator.update(phi, y);
      // The formulas of section 5.4 in plain matrices.
      const double g = 1.0 + phi.dot(p * phi);
      const Matrix6 next = p / design.lambda - design.alpha * p * phi * phi.transpose() * p / g +
                           design.beta * Matrix6::Identity() - design.delta * p * p;
      CHECK((estimator.covariance() - next).norm() <= 1e-9 * (1.0 + p.norm()));
      CHECK((estimator.theta() - before - design.alpha * p * phi / g * (y - phi.dot(before))).norm() <=
            1e-9 * (1.0 + before.norm()));
      const Vector6 values = oracle::symmetric_eigenvalues(estimator.covariance());
      CHECK(values(0) >= lower * (1.0 - 1e-9) - 1e-12 * upper);
      CHECK(values(5) <= upper * (1.0 + 1e-9));
    }
  }
  CHECK(kept > 100);
}

TEST_CASE("the law (5.8) makes the prediction zero, and is an error where it divides by zero") {
  Random random(424);
  for (int k = 0; k < 500; ++k) {
    const Vector6 theta = random_vector(random, 2.0);
    Vector6 phi = random_vector(random, 2.0);
    phi(3) = minimum_variance_control<double, 6>(theta, phi);
    CHECK(std::fabs(phi.dot(theta)) <= 1e-12 * (1.0 + phi.norm()));
  }
  Vector6 theta = random_vector(random, 1.0);
  theta(3) = 0.0;
  CHECK_THROWS_AS((void)(minimum_variance_control<double, 6>(theta, Vector6::Ones())),
                  ZeroLeadingCoefficient);
}

TEST_CASE("the data of the adaptive loop obey (-a, b), not the printed (c - a, b) of (5.5)") {
  const double c = std::cos(kOmega);
  Vector6 data;
  data << 2.0 * c + 0.5, -(1.0 + c), 0.5, 3.0, -6.0 * c, 3.0;
  Vector6 printed = data;
  printed(0) -= 0.5;  // c - a of Table 5.1: A_1 q^2 has c_1 = -0.5
  CHECK(printed(0) == doctest::Approx(1.7321).epsilon(1e-4));
  CHECK(printed(1) == doctest::Approx(-1.8660).epsilon(1e-4));
  Random random(425);
  VibratingPlant<double, 1> plant(thesis_example_plant<double>(), kOmega, 0.7, -0.4);
  Vector6 phi = Vector6::Zero();
  double worst_printed = 0.0;
  double input = 0.0;
  for (int k = 0; k < 300; ++k) {
    const double y = plant.step(input);
    if (k > 3) {
      CHECK(std::fabs(y - phi.dot(data)) <= 1e-11);
      worst_printed = std::max(worst_printed, std::fabs(y - phi.dot(printed)));
    }
    input = random.uniform(-1.0, 1.0);
    const Vector6 last = phi;
    phi << y, last(0), last(1), input, last(3), last(4);
  }
  CHECK(worst_printed > 0.1);
}

/// A starting theta that no frequency has been put into.
template <int N>
RegulatorVector<double, N> ignorant() {
  RegulatorVector<double, N> theta = RegulatorVector<double, N>::Zero();
  theta(N) = 1.0;
  return theta;
}

template <int N>
RegulatorVector<double, N> after_run(int samples, double* last_outputs) {
  using Estimator = EfraLeastSquares<double, N>;
  SelfTuningRegulator<double, N, Estimator> regulator(
      Estimator(thesis_efra_design<double>(), ignorant<N>(), Estimator::Matrix::Identity()));
  VibratingPlant<double, 1> plant(thesis_example_plant<double>(), kOmega, 1.0, 0.5);
  double input = 0.0;
  *last_outputs = 0.0;
  for (int k = 0; k < samples; ++k) {
    const double y = plant.step(input);
    input = regulator.step(y);
    CHECK(std::fabs(regulator.regressor().dot(regulator.estimator().theta())) <=
          1e-9 * (1.0 + regulator.regressor().norm() * regulator.estimator().theta().norm()));
    if (k >= samples - 50) {
      *last_outputs = std::max(*last_outputs, std::fabs(y));
    }
  }
  return regulator.estimator().theta();
}

/// B(e^{j omega}) of the controller's denominator, relative to its coefficients.
template <int N>
double at_disturbance(const RegulatorVector<double, N>& theta) {
  Complex value = 0.0;
  for (int i = 0; i < N; ++i) {
    value += theta(N + i) * std::polar(1.0, -kOmega * i);
  }
  return std::abs(value) / theta.template tail<N>().norm();
}

TEST_CASE("the structure of Tables 5.1 and 5.2: the output vanishes and the denominator has the factor A_2") {
  double outputs = 1.0;
  const auto exact = after_run<3>(4000, &outputs);
  CHECK(outputs <= 1e-6);
  CHECK(at_disturbance<3>(exact) <= 1e-5);
  // A multiple of (3, -5.1962, 3), the numerator not of the ideal one.
  CHECK(exact(4) / exact(3) == doctest::Approx(-5.1962 / 3.0).epsilon(1e-3));
  CHECK(exact(5) / exact(3) == doctest::Approx(1.0).epsilon(1e-3));
  const auto larger = after_run<5>(4000, &outputs);
  CHECK(outputs <= 1e-6);
  CHECK(at_disturbance<5>(larger) <= 1e-5);
}

TEST_CASE("the printed tables: both denominators vanish at omega, and the printed poles are in z^-1") {
  RegulatorVector<double, 3> one;
  one << 1.7980, -1.6164, 0.4802, 3.0, -5.1962, 3.0;
  CHECK(at_disturbance<3>(one) <= 1e-4);
  RegulatorVector<double, 5> two;
  two << 2.2585, -1.9837, 0.4610, 0.2449, -0.0845, 2.9604, -5.5496, 3.2754, 0.2984, -0.4159;
  CHECK(at_disturbance<5>(two) <= 1e-4);
  const auto denominator = [&](double z) {
    return (((two(5) * z + two(6)) * z + two(7)) * z + two(8)) * z + two(9);
  };
  CHECK(std::fabs(denominator(1.0 / -3.2232)) <= 1e-3);
  CHECK(std::fabs(denominator(1.0 / 2.2085)) <= 1e-3);
  CHECK(std::fabs(denominator(-3.2232)) > 100.0);
  CHECK(std::fabs(denominator(2.2085)) > 10.0);
  // The numerators at omega, Table 5.1: not those of the ideal controller.
  const Complex z = std::polar(1.0, kOmega);
  const Complex ideal = (1.7321 * z - 1.8660) * z + 0.5;
  const Complex limit = 1.1133 * ((one(0) * z + one(1)) * z + one(2));
  CHECK(std::abs(limit / (1.1133 * ideal) - 1.0) > 0.2);
}

}  // namespace
}  // namespace veritrack::trackers
