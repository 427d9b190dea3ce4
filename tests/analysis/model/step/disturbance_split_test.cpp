#include "analysis/model/step/disturbance_split.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>

#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

Eigen::MatrixXd random_gram(test::Random& random, Eigen::Index rank, double size) {
  Eigen::MatrixXd factor(3, rank);
  for (Eigen::Index i = 0; i < factor.size(); ++i) {
    factor(i) = random.uniform(-size, size);
  }
  return factor * factor.transpose();
}

TEST_CASE("in one dimension the best shares are those of the lengths") {
  const auto square = [](double x) { return Eigen::MatrixXd::Constant(1, 1, x * x); };
  CHECK(proposed_split(square(3.0), square(1.0)) == doctest::Approx(0.75).epsilon(1e-4));
  const auto shares = proposed_shares(square(5.0), square(3.0), square(2.0));
  const double sum = shares[0] + shares[1] + shares[2];
  CHECK(shares[0] / sum == doctest::Approx(0.5).epsilon(1e-2));
  CHECK(shares[1] / sum == doctest::Approx(0.3).epsilon(1e-2));
  const double bound = sum * (25.0 / shares[0] + 9.0 / shares[1] + 4.0 / shares[2]);
  CHECK(bound == doctest::Approx(100.0).epsilon(1e-5));
  // A disturbance that is very small.
  const auto small = proposed_shares(square(1.0), square(1e-3), square(1e-6));
  const double of_small =
      (small[0] + small[1] + small[2]) * (1.0 / small[0] + 1e-6 / small[1] + 1e-12 / small[2]);
  CHECK(of_small < 1.001001 * 1.001001 + 1e-6);
}

TEST_CASE("no other shares are better") {
  test::Random random(3);
  for (int trial = 0; trial < 40; ++trial) {
    const Eigen::MatrixXd x = random_gram(random, 3, 1.0);
    const Eigen::MatrixXd v = random_gram(random, 1, std::pow(10.0, random.uniform(-3.0, 0.0)));
    const Eigen::MatrixXd w = random_gram(random, 1, std::pow(10.0, random.uniform(-3.0, 0.0)));
    const auto shares = proposed_shares(x, v, w);
    for (const double share : shares) {
      CHECK(share > 0.0);
    }
    const double sum = shares[0] + shares[1] + shares[2];
    const double best = oracle::largest_eigenvalue(sum * (x / shares[0] + v / shares[1] + w / shares[2]));
    const double t = proposed_split(x, v);
    for (int other = 0; other < 200; ++other) {
      const double a = random.uniform(0.001, 1.0);
      const double b = random.uniform(0.0005, 1.0);
      const double c = random.uniform(0.0005, 1.0);
      CHECK(best <= 1.0001 * oracle::largest_eigenvalue((a + b + c) * (x / a + v / b + w / c)));
      CHECK(oracle::largest_eigenvalue(x / t + v / (1.0 - t)) <=
            1.0001 * oracle::largest_eigenvalue((a + b) * (x / a + v / b)));
    }
  }
}

TEST_CASE("where there is nothing to split") {
  const Eigen::MatrixXd none;
  const Eigen::MatrixXd some = Eigen::MatrixXd::Identity(2, 2);
  CHECK(proposed_split(none, some) == 0.5);
  CHECK(proposed_shares(some, none, some) == std::array<double, 3>{1.0, 1.0, 1.0});
}

TEST_CASE("of any matrices there are positive shares") {
  const double unknown = std::nan("");
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double entry : {unknown, infinite, 0.0, -1.0, 1e-320, 1e308}) {
    CAPTURE(entry);
    for (const Eigen::Index rows : {1, 3, 20, 21, 40}) {
      CAPTURE(rows);
      const Eigen::MatrixXd some = Eigen::MatrixXd::Identity(rows, rows);
      const Eigen::MatrixXd odd = Eigen::MatrixXd::Constant(rows, rows, entry);
      for (const double t :
           {proposed_split(odd, some), proposed_split(some, odd), proposed_split(odd, odd)}) {
        CHECK(t > 0.0);
        CHECK(t < 1.0);
      }
      for (const auto& shares : {proposed_shares(odd, some, some), proposed_shares(some, some, odd)}) {
        for (const double share : shares) {
          CHECK(share > 0.0);
          CHECK(std::isfinite(share));
        }
      }
    }
  }
}

}  // namespace
}  // namespace veritrack::model
