#include "analysis/rigor/lyapunov.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

#include "tests/support/matrices.hpp"

using namespace veritrack::rigor;
using namespace veritrack::test;

namespace {

Eigen::MatrixXd random_symmetric(Random& random, Eigen::Index size) {
  const Eigen::MatrixXd half = random_integers(random, size, size, 20);
  return half + half.transpose();
}

bool is_mirrored(const DynamicIntervalMatrix& x) {
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (!identical(x(i), x.transpose()(i))) {
      return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("discrete equations with an integer solution, and every equation around them") {
  Random random(600);
  std::int64_t verified = 0;
  const std::int64_t rounds = effort(150);
  for (std::int64_t round = 0; round < rounds; ++round) {
    const auto size = static_cast<Eigen::Index>(1 + random.below(6));
    const Eigen::MatrixXd a = random_integers(random, size, size, 40) / 64.0;
    const Eigen::MatrixXd x = random_symmetric(random, size);
    const Eigen::MatrixXd q = x - a * x * a.transpose();  // exact
    const auto solution = solve_discrete_lyapunov(to_interval(a), to_interval(q));
    if (solution) {
      ++verified;
      CHECK(contains(*solution, x));
      CHECK(is_mirrored(*solution));
    }
    const auto spread =
        solve_discrete_lyapunov(box_around(random, a, 1e-6), symmetric_box_around(random, q, 1e-3));
    if (spread) {
      CHECK(contains(*spread, x));
      CHECK(is_mirrored(*spread));
    }
  }
  CHECK(verified > rounds * 95 / 100);
}

TEST_CASE("continuous equations with an integer solution, and every equation around them") {
  Random random(601);
  std::int64_t verified = 0;
  const std::int64_t rounds = effort(150);
  for (std::int64_t round = 0; round < rounds; ++round) {
    const auto size = static_cast<Eigen::Index>(1 + random.below(6));
    const Eigen::MatrixXd a = random_integers(random, size, size, 40);
    const Eigen::MatrixXd x = random_symmetric(random, size);
    const Eigen::MatrixXd q = -(a * x + x * a.transpose());
    const auto solution = solve_continuous_lyapunov(to_interval(a), to_interval(q));
    if (solution) {
      ++verified;
      CHECK(contains(*solution, x));
      CHECK(is_mirrored(*solution));
    }
    const auto spread =
        solve_continuous_lyapunov(box_around(random, a, 1e-6), symmetric_box_around(random, q, 1e-3));
    if (spread) {
      CHECK(contains(*spread, x));
      CHECK(is_mirrored(*spread));
    }
  }
  CHECK(verified > rounds * 90 / 100);
}

TEST_CASE("one by one: x = q / (1 - a^2) and x = -q / (2 a)") {
  IntervalMatrix<1> a;
  IntervalMatrix<1> q;
  a << Interval(0.5);
  q << Interval(3.0);
  const std::optional<IntervalMatrix<1>> discrete = solve_discrete_lyapunov(a, q);
  REQUIRE(discrete);
  CHECK(contains((*discrete)(0), 4.0));
  a << Interval(-0.75);
  const std::optional<IntervalMatrix<1>> continuous = solve_continuous_lyapunov(a, q);
  REQUIRE(continuous);
  CHECK(contains((*continuous)(0), 2.0));
}

TEST_CASE("equations that have no unique solution are never solved") {
  Random random(602);
  for (std::int64_t round = 0; round < effort(100); ++round) {
    // W diag(B, C) W^-1: B decides, whatever C and the unimodular W are.
    const auto size = static_cast<Eigen::Index>(2 + random.below(3));
    const Unimodular w = random_unimodular(random, size, static_cast<int>(2 * size));
    Eigen::MatrixXd block = random_integers(random, size, size, 3);
    block.leftCols(2).setZero();
    block.topRows(2).setZero();
    const Eigen::MatrixXd q = random_symmetric(random, size);
    const double reach = random.below(2) == 0 ? 0.0 : 1e-9;
    const auto discrete = [&](double b11, double b12, double b21, double b22) {
      block.topLeftCorner(2, 2) << b11, b12, b21, b22;
      const DynamicIntervalMatrix a = box_around(random, w.matrix * block * w.inverse, reach);
      return solve_discrete_lyapunov(a, to_interval(q)).has_value();
    };
    CHECK_FALSE(discrete(0, -1, 1, 0));     // i (-i) = 1
    CHECK_FALSE(discrete(2, 0, 0, 0.5));    // 2 * 1/2 = 1
    CHECK_FALSE(discrete(-1, 5, 0, 0.25));  // (-1)^2 = 1
    const auto continuous = [&](double b11, double b12, double b21, double b22) {
      block.topLeftCorner(2, 2) << b11, b12, b21, b22;
      const DynamicIntervalMatrix a = box_around(random, w.matrix * block * w.inverse, reach);
      return solve_continuous_lyapunov(a, to_interval(q)).has_value();
    };
    CHECK_FALSE(continuous(0, -2, 2, 0));    // 2i - 2i = 0
    CHECK_FALSE(continuous(3, 1, 0, -3));    // 3 - 3 = 0
    CHECK_FALSE(continuous(-1, 0, 0, 0.0));  // 0 + 0 = 0
  }
}

TEST_CASE("nothing for what is not finite or not symmetric, and an exception for what does not fit") {
  const IntervalMatrix<2> q = IntervalMatrix<2>::Identity();
  IntervalMatrix<2> a = IntervalMatrix<2>::Identity();
  a(0, 0) = a(1, 1) = Interval(-0.5);
  CHECK(solve_discrete_lyapunov(a, q));
  CHECK(solve_continuous_lyapunov(a, q));
  for (const Interval& poison : kPoison) {
    IntervalMatrix<2> bad = a;
    bad(0, 1) = poison;
    CHECK_FALSE(solve_discrete_lyapunov(bad, q));
    CHECK_FALSE(solve_continuous_lyapunov(bad, q));
    bad = q;
    bad(1, 1) = poison;
    CHECK_FALSE(solve_discrete_lyapunov(a, bad));
    CHECK_FALSE(solve_continuous_lyapunov(a, bad));
  }
  IntervalMatrix<2> asymmetric = q;
  asymmetric(0, 1) = Interval(1.0);
  CHECK_FALSE(solve_discrete_lyapunov(a, asymmetric));
  CHECK_FALSE(solve_continuous_lyapunov(a, asymmetric));
  CHECK_THROWS_AS(
      static_cast<void>(solve_discrete_lyapunov(DynamicIntervalMatrix(2, 2), DynamicIntervalMatrix(3, 3))),
      std::invalid_argument);
  CHECK_THROWS_AS(static_cast<void>(solve_continuous_lyapunov(DynamicIntervalMatrix(2, 3), q)),
                  std::invalid_argument);
  CHECK_FALSE(rounding_is_upward());
}
