#include "analysis/model/steady_state/step_derivatives.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "tests/analysis/model/example_recursions.hpp"

namespace veritrack::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The integrator loop in long double: its next state from alpha, beta, w, and the sample.
using FourNumbers = std::array<long double, 4>;
FourNumbers next_of_integrator(const std::vector<double>& constants, const FourNumbers& x) {
  const auto [alpha, beta, w, y] = x;
  const long double k = constants[0], g = constants[1], t = constants[2];
  const long double e = y - alpha;
  const long double a = alpha + w * t * (k * e - beta);
  const long double b = beta + w * t * a;
  return {a, b, w - g * w * e * b / (a * a + b * b), 0.0L};
}

/// The derivative in these places, by central differences of central differences.
long double difference(const std::vector<double>& constants, FourNumbers x, std::size_t row,
                       std::vector<std::size_t> places, const FourNumbers& steps) {
  if (places.empty()) {
    return next_of_integrator(constants, x)[row];
  }
  const std::size_t place = places.back();
  places.pop_back();
  FourNumbers lower = x;
  x[place] += steps[place];
  lower[place] -= steps[place];
  return (difference(constants, x, row, places, steps) - difference(constants, lower, row, places, steps)) /
         (2.0L * steps[place]);
}

TEST_CASE("derivatives of an integrator loop up to the third order are those of differences") {
  const test::ExampleTracker loop = test::integrator_loop();
  const StepMap step(loop.recursion, loop.constants);
  const VectorXd state = Eigen::Vector3d(0.8, -0.5, 320.0);
  const VectorXd sample = VectorXd::Constant(1, 0.6);
  const VectorXd scale = Eigen::Vector3d(1.0, 1.0, 300.0);
  const StepDerivatives found = step.derivatives(state, sample, scale);
  const FourNumbers x{0.8L, -0.5L, 320.0L, static_cast<long double>(0.6)};
  const FourNumbers steps{1e-4L, 1e-4L, 3e-2L, 1e-4L};
  const auto size = [&](std::size_t i) { return i < 3 ? scale[static_cast<Index>(i)] : 1.0; };
  // In units of the states' sizes: what the next state changes by.
  const auto check = [&](double value, std::size_t row, const std::vector<std::size_t>& places) {
    double unit = 1.0 / size(row);
    for (const std::size_t place : places) {
      unit *= size(place);
    }
    const auto expected = static_cast<double>(difference(loop.constants, x, row, places, steps));
    CHECK(unit * value == doctest::Approx(unit * expected).epsilon(1e-6).scale(1.0));
  };
  for (std::size_t row = 0; row < 3; ++row) {
    const auto i = static_cast<Index>(row);
    check(found.sample(i, 0), row, {3});
    for (std::size_t j = 0; j < 4; ++j) {
      if (j < 3) {
        check(found.state(i, static_cast<Index>(j)), row, {j});
      }
      for (std::size_t k = 0; k < 4; ++k) {
        check(found.second[row](static_cast<Index>(j), static_cast<Index>(k)), row, {j, k});
        for (std::size_t l = 0; j < 3 && k < 3 && l < 3; ++l) {
          check(found.third(i, static_cast<Index>((j * 3 + k) * 3 + l)), row, {j, k, l});
        }
      }
    }
  }
  const VectorXd next = step.next(state, sample);
  const FourNumbers exact = next_of_integrator(loop.constants, x);
  for (Index i = 0; i < 3; ++i) {
    CHECK(next[i] == doctest::Approx(static_cast<double>(exact[static_cast<std::size_t>(i)])).epsilon(1e-14));
  }
  MatrixXd both(3, 4);
  both << found.state, found.sample;
  CHECK((step.jacobian(state, sample) - both).norm() < 1e-12 * both.norm());
}

TEST_CASE("derivatives of a phase-locked loop in closed form") {
  const test::ExampleTracker loop = test::phase_locked_loop();
  const StepMap step(loop.recursion, loop.constants);
  const double ki = loop.constants[0], kp = loop.constants[1];
  const double theta = 0.7, y = 0.9;
  const StepDerivatives found =
      step.derivatives(Eigen::Vector2d(0.3, theta), VectorXd::Constant(1, y), Eigen::Vector2d(0.1, 1.0));
  // w' = w - ki y sin theta, theta' = theta + w - kp y sin theta.
  const double sine = std::sin(theta), cosine = std::cos(theta);
  const MatrixXd state{{1.0, -ki * y * cosine}, {1.0, 1.0 - kp * y * cosine}};
  CHECK((found.state - state).norm() < 1e-14);
  CHECK((found.sample - MatrixXd{{-ki * sine}, {-kp * sine}}).norm() < 1e-14);
  for (const auto& [row, gain] : {std::pair(0, ki), std::pair(1, kp)}) {
    const MatrixXd second{
        {0.0, 0.0, 0.0}, {0.0, gain * y * sine, -gain * cosine}, {0.0, -gain * cosine, 0.0}};
    CHECK((found.second[static_cast<std::size_t>(row)] - second).norm() < 1e-13);
    for (Index place = 0; place < 8; ++place) {
      const double third = place == 7 ? gain * y * cosine : 0.0;
      CHECK(std::fabs(found.third(row, place) - third) < 1e-12);
    }
  }
}

TEST_CASE("gradient and curvature of a frequency that is no state") {
  const test::ExampleTracker filter = test::notch_filter();
  const StepMap step(filter.recursion, filter.constants);
  const double a = 1.9;
  const VectorXd state = Eigen::Vector4d(0.1, 0.2, a, 0.01);
  CHECK(step.frequency(state) == doctest::Approx(std::acos(a / 2.0)));
  const double root = std::sqrt(4.0 - a * a);
  Eigen::RowVectorXd gradient = Eigen::RowVectorXd::Zero(4);
  gradient[2] = -1.0 / root;
  CHECK((step.frequency_gradient(state) - gradient).norm() < 1e-14);
  MatrixXd hessian = MatrixXd::Zero(4, 4);
  hessian(2, 2) = -a / (root * root * root);
  CHECK((step.frequency_hessian(state) - hessian).norm() < 1e-12);
}

TEST_CASE("samples of a signal with harmonics, and constants that do not fit") {
  const Signal signal{{{0.25, 1.0, {0.0, 0.5}}, {0.0, {0.0, -1.0}}}};
  const double phase = 0.6;
  const VectorXd samples = samples_of(signal, 2.0, phase);
  REQUIRE(samples.size() == 2);
  CHECK(samples[0] == doctest::Approx(0.5 + 2.0 * std::cos(phase) - std::sin(2.0 * phase)));
  CHECK(samples[1] == doctest::Approx(2.0 * std::sin(phase)));
  const test::ExampleTracker loop = test::phase_locked_loop();
  CHECK_THROWS_AS(StepMap(loop.recursion, {1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::model
