#include "checker/quadrature/lock_proposal.hpp"

#include <doctest/doctest.h>

#include "tests/checker/quadrature/lock_support.hpp"

using namespace veritrack;
using namespace veritrack::checker;

TEST_CASE("a plane is nowhere below the numbers at the corners, and touches them") {
  test::Random random(5380);
  for (std::int64_t k = 0; k < test::effort(100); ++k) {
    std::array<double, 16> levels{};
    for (double& level : levels) {
      level = random.uniform(0.0, 1.0);
    }
    const auto plane = lock_proposal::plane_above(levels);
    double least = 1e9;
    for (std::size_t corner = 0; corner < levels.size(); ++corner) {
      double there = plane.middle;
      for (std::size_t i = 0; i < plane.along.size(); ++i) {
        there += ((corner >> i) & 1U) != 0U ? plane.along[i] : -plane.along[i];
      }
      least = std::min(least, there - levels[corner]);
    }
    CHECK(least > 0.0);
    CHECK(least < 1e-6);
  }
}

TEST_CASE("the multiplier that is proposed is about the best") {
  // 1 x 1 blocks in effect: (1 - a/mu), (1 - b mu), nothing else.
  lock_proposal::Matrix6 constant{};
  lock_proposal::Ends ends{};
  for (std::size_t i = 0; i < lock_form::kRest; ++i) {
    constant[i][i] = 1.0;
  }
  for (auto& parts : ends.parts) {
    for (std::size_t i = 0; i < 3; ++i) {
      parts[i][i] = 0.1;
      parts[lock_form::kRest][i] = 1.0;
    }
    parts[3][3] = parts[4][4] = 1e-3;
  }
  ends.rest = {20.0, 21.0};
  const double found = lock_proposal::propose_multiplier(ends, constant, 0.1, 0.1);
  const auto value = [&](double multiplier) {
    return lock_proposal::left_over(
        lock_proposal::form(ends.parts[0], constant, 20.0, lock_form::factors_of(multiplier, 0.1, 0.1)));
  };
  double best = -1e9;
  for (double multiplier = 0.05; multiplier < 1000.0; multiplier *= 1.02) {
    best = std::max(best, value(multiplier));
  }
  CHECK(value(found) > best - 0.01);
}

TEST_CASE("weights are positive numbers, whatever the matrix") {
  lock_proposal::Matrix6 n{};
  for (const double weight : lock_proposal::propose_weights(n)) {
    CHECK(weight > 0.0);
  }
  for (std::size_t i = 0; i < lock_form::kSize; ++i) {
    n[i][i] = 1.0;
  }
  n[5][0] = -3.0;
  const auto weights = lock_proposal::propose_weights(n);
  CHECK(weights[0] == 3.0);
  CHECK(weights[5] == 1.0);
  n[5][0] = std::nan("");
  for (const double weight : lock_proposal::propose_weights(n)) {
    CHECK(weight > 0.0);
  }
}
