// Cells of frequencies with a curve and a basis: one step from points near the curve, at frequencies between
// the nodes of the interpolation.
#include "analysis/model/gain/floquet_proposal.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/floquet_points.hpp"
#include "tests/analysis/model/gain_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

/// x' = a x + y; the frequency is taken from x.
test::ExampleTracker first_order_lag(double a) {
  test::ExampleTracker example;
  test::Recursion& r = example.recursion;
  r.constants = 1;
  r.states = 1;
  r.samples = 1;
  r.is_angle = {false};
  test::StraightLineProgram step(3);
  step.add_result(step.append(test::Operation::add, step.append(test::Operation::multiply, 0, 1), 2));
  r.step = step;
  r.frequency = test::frequency_of_state(1, 1, 0);
  example.constants = {a};
  example.start = [](double) { return std::vector<double>{0.0}; };
  return example;
}

/// The matrix of a cell at a frequency.
Eigen::MatrixXd matrix_of(const FloquetCell& cell, double frequency) {
  const auto n = static_cast<Eigen::Index>(cell.states());
  const double z = (frequency - cell.curve.frequency) / cell.curve.half_width;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n * n; ++i) {
    const std::vector<double>& powers = cell.matrix[static_cast<std::size_t>(i)];
    for (std::size_t d = 0; d < powers.size(); ++d) {
      matrix(i / n, i % n) += powers[d] * std::pow(z, static_cast<double>(d));
    }
  }
  return matrix;
}

TEST_CASE("multipliers of a cell are those in the middle of its frequencies, the largest first") {
  FloquetCell cell;
  cell.curve.curve.resize(3);
  // A mode of 0.5, and a pair of 0.8 +- 0.3i; what goes with the frequency does not matter.
  for (const double entry : {0.5, 0.0, 0.0, 7.0, 0.8, -0.3, 0.0, 0.3, 0.8}) {
    cell.matrix.push_back({entry, 100.0});
  }
  const std::vector<std::complex<double>> multipliers = floquet_multipliers(cell);
  REQUIRE(multipliers.size() == 3);
  const std::vector<std::complex<double>> expected{{0.8, 0.3}, {0.8, -0.3}, {0.5, 0.0}};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(std::abs(multipliers[i] - expected[i]) < 1e-12);
  }
}

TEST_CASE("a lag has the curve of its transfer function, and the multiplier of its pole") {
  constexpr double kPole = 0.9;
  const test::ExampleTracker lag = first_order_lag(kPole);
  const auto cell = propose_floquet_cell(test::tone_of(lag), FloquetGauge::by_state, 0.3, 0.32);
  REQUIRE(cell);
  CHECK(cell->curve.frequency == doctest::Approx(0.31).epsilon(1e-14));
  CHECK(cell->curve.half_width == doctest::Approx(0.01).epsilon(1e-9));
  CHECK(cell->curve.turns == std::vector<int>{0});
  const test::FloquetPoints points(lag, *cell);
  test::Random random(950);
  for (std::int64_t trial = 0; trial < test::effort(100); ++trial) {
    const double omega = random.uniform(0.3, 0.32);
    const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    const std::complex<double> transfer = 1.0 / (1.0 - kPole * std::polar(1.0, -omega));
    CHECK(std::fabs(points.curve(phase, omega)(0) - (transfer * std::polar(1.0, phase)).real()) < 1e-11);
    CHECK(std::fabs(points.basis(phase, omega)(0, 0) - 1.0) < 1e-9);
    CHECK(std::fabs(matrix_of(*cell, omega)(0, 0) - kPole) < 1e-10);
  }
}

TEST_CASE("by state a loop with a linear detector has the matrix on paper at all frequencies") {
  const test::TwoChannelExample loop(test::angle_loop(0.004, 0.1));
  const auto cell = propose_floquet_cell(loop.tone, FloquetGauge::by_state, 0.2, 0.4);
  REQUIRE(cell);
  CHECK(cell->curve.turns == std::vector<int>{0, 1});
  Eigen::Matrix2d expected;  // e = -(theta + w); w' = w + ki e, theta' = theta + w + kp e
  expected << 1.0 - 0.004, -0.004, 1.0 - 0.1, 1.0 - 0.1;
  for (const double omega : {0.2, 0.27, 0.31, 0.4}) {
    CHECK((matrix_of(*cell, omega) - expected).cwiseAbs().maxCoeff() < 1e-9);
  }
}

TEST_CASE("one step from points near the curve is that of the curve and of the matrix") {
  const test::ExampleTracker pll = test::phase_locked_loop(0.03);
  const test::ExampleTracker integrator = test::integrator_loop();
  test::Random random(951);
  for (const auto& [tracker, low, high] : {std::tuple(&pll, 0.29, 0.31), {&integrator, 0.03, 0.032}}) {
    for (const FloquetGauge gauge : {FloquetGauge::by_mode, FloquetGauge::by_state}) {
      const auto cell = propose_floquet_cell(test::tone_of(*tracker), gauge, low, high);
      REQUIRE(cell);
      const test::FloquetPoints points(*tracker, *cell);
      const auto n = static_cast<Eigen::Index>(cell->states());
      for (std::int64_t trial = 0; trial < test::effort(60); ++trial) {
        const double omega = trial == 0 ? high : random.uniform(low, high);
        const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
        const Eigen::VectorXd none = Eigen::VectorXd::Zero(n);
        const Eigen::VectorXd off = points.after(phase, omega, omega, none, Eigen::VectorXd::Zero(1));
        CHECK(off.cwiseAbs().maxCoeff() < 1e-9);
        const Eigen::MatrixXd slopes = points.slopes(phase, omega).leftCols(n);
        CHECK((slopes - matrix_of(*cell, omega)).cwiseAbs().maxCoeff() < 1e-6);
      }
    }
  }
}

TEST_CASE("without a steady state that is right in the mean, or without a mode, there is no cell") {
  const auto is_found = [](const test::ExampleTracker& tracker, double largest = INFINITY) {
    return propose_floquet_cell(test::tone_of(tracker), FloquetGauge::by_mode, 0.3, 0.31, largest)
        .has_value();
  };
  CHECK_FALSE(is_found(first_order_lag(1.01)));  // grows
  CHECK_FALSE(is_found(first_order_lag(0.01)));  // is forgotten at once
  CHECK(is_found(first_order_lag(0.5)));
  // The mean of w is omega, because theta turns with the signal and the mean of e is 0; add ki to it.
  test::ExampleTracker biased = test::phase_locked_loop(0.03);
  biased.recursion.frequency = test::StraightLineProgram(4);
  biased.recursion.frequency.add_result(biased.recursion.frequency.append(test::Operation::add, 0, 2));
  const double bias = biased.constants[0];
  CHECK(is_found(biased, 1.01 * bias));
  CHECK_FALSE(is_found(biased, 0.99 * bias));
}

TEST_CASE("a cell of one frequency has some width, and its search keeps the caller's rounding") {
  const test::ExampleTracker lag = first_order_lag(0.9);
  const rigor::UpwardRounding upward;
  const auto cell = propose_floquet_cell(test::tone_of(lag), FloquetGauge::by_mode, 0.3, 0.3);
  REQUIRE(cell);
  CHECK(cell->curve.half_width == 1e-9);
  volatile double third = 3.0;
  CHECK(1.0 / third == 0.33333333333333337);  // upward
}

}  // namespace
}  // namespace veritrack::model
