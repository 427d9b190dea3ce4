#include "analysis/rigor/linear_solve.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

#include "tests/support/matrices.hpp"

using namespace veritrack::rigor;
using namespace veritrack::test;

namespace {

/// The largest width of an entry, outside any rounding scope.
double widest(const DynamicIntervalMatrix& matrix) {
  const UpwardRounding upward;
  double result = 0.0;
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    result = std::max(result, width(matrix(i)));
  }
  return result;
}

}  // namespace

TEST_CASE("solve holds integer solutions of integer systems, and of every system around them") {
  Random random(200);
  std::int64_t verified = 0;
  std::int64_t verified_box = 0;
  const std::int64_t rounds = effort(600);
  for (std::int64_t round = 0; round < rounds; ++round) {
    const auto size = static_cast<Eigen::Index>(1 + random.below(12));
    const auto columns = static_cast<Eigen::Index>(1 + random.below(3));
    const Eigen::MatrixXd a = random_integers(random, size, size, 50);
    const Eigen::MatrixXd x = random_integers(random, size, columns, 1000);
    const Eigen::MatrixXd b = a * x;  // exact
    if (const auto solution = solve(to_interval(a), to_interval(b))) {
      ++verified;
      CHECK(contains(*solution, x));
    }
    const double reach = std::ldexp(1.0, -static_cast<int>(random.below(30)));
    const DynamicIntervalMatrix box_a = box_around(random, a, reach);
    const DynamicIntervalMatrix box_b = box_around(random, b, reach);
    if (const auto solution = solve(box_a, box_b)) {
      ++verified_box;
      CHECK(contains(*solution, x));
    }
  }
  CHECK(verified > rounds * 9 / 10);
  CHECK(verified_box > rounds / 2);
}

TEST_CASE("solve is tight for well-conditioned points") {
  Random random(201);
  for (std::int64_t round = 0; round < effort(100); ++round) {
    const Eigen::MatrixXd a = random_integers(random, 9, 9, 5) + 60.0 * Eigen::MatrixXd::Identity(9, 9);
    const Eigen::MatrixXd x = random_integers(random, 9, 1, 10);
    const auto solution = solve(to_interval(a), to_interval(Eigen::MatrixXd(a * x)));
    REQUIRE(solution);
    CHECK(contains(*solution, x));
    CHECK(widest(*solution) < 1e-13);
  }
}

TEST_CASE("solve keeps fixed sizes") {
  IntervalMatrix<2> a;
  a << Interval(2.0), Interval(0.0), Interval(0.0), Interval(4.0);
  const IntervalVector<2> b(Interval(1.0), Interval(1.0));
  const std::optional<IntervalVector<2>> x = solve(a, b);
  REQUIRE(x);
  CHECK(contains(*x, Vector<2>(0.5, 0.25)));
  const std::optional<IntervalVector<2>> zero = solve(a, IntervalVector<2>(Interval(0.0), Interval(0.0)));
  REQUIRE(zero);
  CHECK(contains(*zero, Vector<2>(0.0, 0.0)));
}

TEST_CASE("inverse holds the integer inverse of unimodular matrices") {
  Random random(202);
  std::int64_t verified = 0;
  const std::int64_t rounds = effort(300);
  for (std::int64_t round = 0; round < rounds; ++round) {
    const auto size = static_cast<Eigen::Index>(1 + random.below(10));
    const Unimodular truth = random_unimodular(random, size, static_cast<int>(4 * size));
    REQUIRE(Eigen::MatrixXd(truth.matrix * truth.inverse).isIdentity(0.0));
    if (const auto result = inverse(to_interval(truth.matrix))) {
      ++verified;
      CHECK(contains(*result, truth.inverse));
    }
  }
  CHECK(verified == rounds);
}

TEST_CASE("inverse of the Hilbert matrix, made integer") {
  // 27720 H_6 with h_ij = 1/(i+j-1); the inverse of H_n is the integer matrix
  // (-1)^(i+j) (i+j-1) C(n+i-1, n-j) C(n+j-1, n-i) C(i+j-2, i-1)^2.
  constexpr int kSize = 6;
  const auto choose = [](int n, int k) {
    double result = 1.0;
    for (int i = 1; i <= k; ++i) {
      result = result * (n - k + i) / i;
    }
    return result;
  };
  Eigen::MatrixXd a(kSize, kSize);
  Eigen::MatrixXd exact(kSize, kSize);
  for (int i = 1; i <= kSize; ++i) {
    for (int j = 1; j <= kSize; ++j) {
      a(i - 1, j - 1) = 27720.0 / (i + j - 1);
      const double sign = (i + j) % 2 == 0 ? 1.0 : -1.0;
      const double middle = choose(i + j - 2, i - 1);
      exact(i - 1, j - 1) = sign * (i + j - 1) * choose(kSize + i - 1, kSize - j) *
                            choose(kSize + j - 1, kSize - i) * middle * middle;
    }
  }
  const auto result = inverse(to_interval(a));
  REQUIRE(result);
  const UpwardRounding upward;
  for (Eigen::Index i = 0; i < exact.size(); ++i) {
    CHECK(contains((*result)(i)*Interval(27720.0), exact(i)));
  }
}

TEST_CASE("no matrix that may be singular is ever solved") {
  Random random(203);
  for (std::int64_t round = 0; round < effort(500); ++round) {
    const auto size = static_cast<Eigen::Index>(1 + random.below(8));
    Eigen::MatrixXd a = random_integers(random, size, size, 50);
    a.row(size - 1).setZero();
    for (Eigen::Index row = 0; row + 1 < size; ++row) {
      a.row(size - 1) += (random.below(2) == 0 ? 1.0 : -2.0) * a.row(row).eval();
    }
    const Eigen::MatrixXd b = random_integers(random, size, 1, 10);
    CHECK_FALSE(solve(to_interval(a), to_interval(b)));
    CHECK_FALSE(inverse(to_interval(a)));
    const double reach = std::ldexp(1.0, -static_cast<int>(random.below(60)));
    CHECK_FALSE(inverse(box_around(random, a, reach)));
  }
  IntervalMatrix<1> zero_inside;
  zero_inside << Interval::from_bounds(-1e-300, 1.0);
  CHECK_FALSE(inverse(zero_inside));
}

TEST_CASE("solve gives nothing for what is not finite, and throws for what does not fit") {
  for (const Interval& poison : kPoison) {
    IntervalMatrix<3> a = IntervalMatrix<3>::Identity();
    IntervalVector<3> b = IntervalVector<3>::Constant(Interval(1.0));
    CHECK(solve(a, b));
    b[1] = poison;
    CHECK_FALSE(solve(a, b));
    b[1] = Interval(1.0);
    a(2, 0) = poison;
    CHECK_FALSE(solve(a, b));
    CHECK_FALSE(inverse(a));
  }
  CHECK_FALSE(inverse(DynamicIntervalMatrix(0, 0)));
  CHECK_THROWS_AS(static_cast<void>(inverse(DynamicIntervalMatrix(2, 3))), std::invalid_argument);
  CHECK_THROWS_AS(static_cast<void>(solve(DynamicIntervalMatrix(2, 2), DynamicIntervalMatrix(3, 1))),
                  std::invalid_argument);
  CHECK_FALSE(rounding_is_upward());
}
