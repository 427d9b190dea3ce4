#include "analysis/model/steady_state/phase_grid.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace veritrack::model {
namespace {

/// 1/2 + cos(phi) - 2 sin(phi) + 3 cos(3 phi); with its harmonics up to 1 alone.
double polynomial(double phase, bool is_whole = true) {
  return 0.5 + std::cos(phase) - 2.0 * std::sin(phase) + (is_whole ? 3.0 * std::cos(3.0 * phase) : 0.0);
}

TEST_CASE("a grid has the uniform phases of a turn") {
  const PhaseGrid grid(4);
  CHECK(grid.harmonics() == 4);
  REQUIRE(grid.size() == 9);
  for (int j = 0; j < 9; ++j) {
    CHECK(grid.phase(j) == doctest::Approx(2.0 * std::numbers::pi * j / 9.0));
  }
}

TEST_CASE("shifted values are those of the trigonometric polynomial, or of its first harmonics") {
  const PhaseGrid grid(4);
  Eigen::RowVectorXd values(9);
  for (int j = 0; j < 9; ++j) {
    values[j] = polynomial(grid.phase(j));
  }
  for (const double shift : {0.0, 0.3, -2.0, 7.5}) {
    const Eigen::RowVectorXd whole = values * grid.shift(shift);
    const Eigen::RowVectorXd low = values * grid.shift(shift, 1);
    const Eigen::RowVectorXd more = values * grid.shift(shift, 100);
    for (int j = 0; j < 9; ++j) {
      CHECK(std::fabs(whole[j] - polynomial(grid.phase(j) + shift)) < 1e-13);
      CHECK(std::fabs(low[j] - polynomial(grid.phase(j) + shift, false)) < 1e-13);
      CHECK(more[j] == whole[j]);
    }
    CHECK(std::fabs((values * grid.shift(shift, 0))[0] - 0.5) < 1e-13);
  }
}

TEST_CASE("harmonics are the coefficients, of any number of phases that tells them apart") {
  for (const int count : {8, 9, 64}) {
    Eigen::MatrixXd values(2, count);
    for (int j = 0; j < count; ++j) {
      const double phase = 2.0 * std::numbers::pi * j / count;
      values.col(j) << polynomial(phase), std::sin(2.0 * phase);
    }
    const Eigen::MatrixXcd found = harmonics_of(values, 3);
    Eigen::MatrixXcd expected = Eigen::MatrixXcd::Zero(2, 4);
    expected(0, 0) = 0.5;
    expected(0, 1) = {1.0, 2.0};
    expected(0, 3) = 3.0;
    expected(1, 2) = {0.0, -1.0};
    CHECK((found - expected).norm() < 1e-13);
    for (const double phase : {0.1, 2.0, -3.0}) {
      CHECK(std::fabs(value_at(found, phase)[0] - polynomial(phase)) < 1e-13);
      CHECK(std::fabs(value_at(found, phase)[1] - std::sin(2.0 * phase)) < 1e-13);
    }
  }
}

}  // namespace
}  // namespace veritrack::model
