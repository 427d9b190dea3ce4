#include "papers/claims/spill_over_claims.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "trackers/pendulum/impulsive_pendulum.hpp"

using namespace veritrack;
using rigor::Verdict;

TEST_CASE("the claims of the two pages are proved") {
  const rigor::UpwardRounding upward;
  for (const theorems::Statement& statement : theorems::spill_over_claims()) {
    CAPTURE(statement.id);
    CHECK_FALSE(statement.witness.empty());
    CHECK(statement.verdict == Verdict::proved);
  }
}

TEST_CASE(
    "medians of odd subsets: their values on all threshold signals have full rank in floating point, too") {
  for (std::size_t window = 1; window <= 6; ++window) {
    CAPTURE(window);
    CHECK(theorems::medians_are_a_basis(window) == Verdict::proved);
    const int half = 1 << (window - 1);
    Eigen::MatrixXd values(half, 2 * half);
    int row = 0;
    for (unsigned subset = 1; subset < 2U * static_cast<unsigned>(half); ++subset) {
      if (std::popcount(subset) % 2 == 1) {
        for (unsigned x = 0; x < 2U * static_cast<unsigned>(half); ++x) {
          values(row, static_cast<int>(x)) =
              2 * std::popcount(x & subset) > std::popcount(subset) ? 1.0 : 0.0;
        }
        ++row;
      }
    }
    CHECK(oracle::rank(values) == half);
  }
  CHECK_THROWS_AS((void)theorems::medians_are_a_basis(0), std::invalid_argument);
  CHECK_THROWS_AS((void)theorems::medians_are_a_basis(13), std::invalid_argument);
}

TEST_CASE("the controlled pendulum comes to rest from any state below the upper equilibrium's energy") {
  test::Random random(4'320);
  for (std::int64_t run = 0; run < test::effort(20); ++run) {
    const double angle = random.uniform(-3.0, 3.0);
    const double room = std::sqrt(2.0 * (1.0 + std::cos(angle)));
    const double rate = random.uniform(-0.99, 0.99) * room;
    trackers::ImpulsivePendulum<double> pendulum({0.2, 2.0, 4.32, 100}, {angle, rate});
    for (int k = 0; k < 40; ++k) {
      pendulum.step(2.0);
    }
    CHECK(std::fabs(pendulum.state().angle) < 1e-5);
    CHECK(std::fabs(pendulum.state().rate) < 1e-5);
  }
}
