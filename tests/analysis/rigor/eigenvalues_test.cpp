#include "analysis/rigor/eigenvalues.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "tests/support/matrices.hpp"

using namespace veritrack::rigor;
using namespace veritrack::test;

namespace {

Eigen::VectorXd sorted(Eigen::VectorXd values) {
  std::sort(values.data(), values.data() + values.size());
  return values;
}

/// `truth` known to a relative error of 1e-18 or so.
bool holds_eigenvalue(const Interval& enclosure, long double truth) {
  const long double margin = 4e-19L * std::max(1.0L, std::fabs(truth));
  return static_cast<long double>(enclosure.lower()) <= truth + margin &&
         static_cast<long double>(enclosure.upper()) >= truth - margin;
}

template <typename Enclosures>
double widest_eigenvalue(const Enclosures& enclosures) {
  const UpwardRounding upward;
  double result = 0.0;
  for (Eigen::Index i = 0; i < enclosures.size(); ++i) {
    result = std::max(result, width(enclosures(i)));
  }
  return result;
}

}  // namespace

TEST_CASE("eigenvalues that are known exactly, simple and multiple: Hadamard similarity") {
  Random random(500);
  for (std::int64_t round = 0; round < effort(300); ++round) {
    const Eigen::Index size = Eigen::Index{1} << random.below(5);
    const int bound = 1 + static_cast<int>(random.below(1000));  // small bounds: many multiple eigenvalues
    const Eigen::VectorXd truth = random_integers(random, size, 1, bound);
    const Eigen::MatrixXd h = hadamard(size);
    const Eigen::MatrixXd a = h * truth.asDiagonal() * h / static_cast<double>(size);
    const auto values = symmetric_eigenvalues(to_interval(a));
    REQUIRE(values);
    CHECK(contains(*values, sorted(truth)));
    CHECK(widest_eigenvalue(*values) <= 2e-13 * bound);

    const double reach = std::ldexp(1.0, -static_cast<int>(random.below(40)));
    const DynamicIntervalMatrix box = symmetric_box_around(random, a, reach);
    const auto spread = symmetric_eigenvalues(box);
    REQUIRE(spread);
    CHECK(contains(*spread, sorted(truth)));
    CHECK(widest_eigenvalue(*spread) <= 4.0 * static_cast<double>(size) * reach + 2e-13 * bound);
    for (Eigen::Index i = 0; i + 1 < size; ++i) {
      CHECK((*spread)(i).lower() <= (*spread)(i + 1).lower());
      CHECK((*spread)(i).upper() <= (*spread)(i + 1).upper());
    }
  }
}

TEST_CASE("second differences: 2 - 2 cos(k pi / (n + 1))") {
  for (const Eigen::Index size : {1, 2, 3, 6, 9, 20}) {
    DynamicIntervalMatrix a = DynamicIntervalMatrix::Zero(size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
      a(i, i) = Interval(2.0);
      if (i > 0) {
        a(i, i - 1) = a(i - 1, i) = Interval(-1.0);
      }
    }
    const auto values = symmetric_eigenvalues(a);
    REQUIRE(values);
    for (Eigen::Index k = 0; k < size; ++k) {
      const long double angle = static_cast<long double>(k + 1) * std::numbers::pi_v<long double> /
                                static_cast<long double>(size + 1);
      CHECK(holds_eigenvalue((*values)(k), 2.0L - 2.0L * std::cos(angle)));
    }
    CHECK(widest_eigenvalue(*values) <= 1e-13);
  }
}

TEST_CASE("2 x 2 eigenvalues by the closed formula") {
  Random random(501);
  for (std::int64_t round = 0; round < effort(2000); ++round) {
    const double a = random.uniform(-1.0, 1.0);
    const double c = random.below(4) == 0 ? a : random.uniform(-1.0, 1.0);
    const double b = random.uniform(-1.0, 1.0) * std::ldexp(1.0, -static_cast<int>(random.below(60)));
    IntervalMatrix<2> matrix;
    matrix << Interval(a), Interval(b), Interval(b), Interval(c);
    const std::optional<IntervalVector<2>> values = symmetric_eigenvalues(matrix);
    REQUIRE(values);
    const long double mean = (static_cast<long double>(a) + c) / 2;
    const long double offset = std::hypot((static_cast<long double>(a) - c) / 2, static_cast<long double>(b));
    CHECK(holds_eigenvalue((*values)[0], mean - offset));
    CHECK(holds_eigenvalue((*values)[1], mean + offset));
    CHECK(widest_eigenvalue(*values) <= 1e-14);
  }
}

TEST_CASE("pencils whose eigenvalues are known exactly: congruent to diagonal ones") {
  Random random(502);
  std::int64_t verified = 0;
  const std::int64_t rounds = effort(300);
  for (std::int64_t round = 0; round < rounds; ++round) {
    const auto size = static_cast<Eigen::Index>(1 + random.below(8));
    const Eigen::MatrixXd w = random_unimodular(random, size, static_cast<int>(2 * size)).matrix;
    const Eigen::VectorXd d = random_integers(random, size, 1, 100);
    Eigen::VectorXd e(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      e[i] = std::ldexp(1.0, static_cast<int>(random.below(5)));
    }
    const Eigen::VectorXd truth = sorted(d.cwiseQuotient(e));
    const Eigen::MatrixXd a = w.transpose() * d.asDiagonal() * w;
    const Eigen::MatrixXd b = w.transpose() * e.asDiagonal() * w;
    if (const auto values = generalized_eigenvalues(to_interval(a), to_interval(b))) {
      ++verified;
      CHECK(contains(*values, truth));
      CHECK(widest_eigenvalue(*values) <= 1e-8);
    }
    const DynamicIntervalMatrix box_a = symmetric_box_around(random, a, 1e-6);
    const DynamicIntervalMatrix box_b = symmetric_box_around(random, b, 1e-6);
    if (const auto values = generalized_eigenvalues(box_a, box_b)) {
      CHECK(contains(*values, truth));
    }
    // No second matrix that may fail to be positive definite.
    e[static_cast<Eigen::Index>(random.below(static_cast<std::uint64_t>(size)))] =
        random.below(2) == 0 ? 0.0 : -1.0;
    const Eigen::MatrixXd not_definite = w.transpose() * e.asDiagonal() * w;
    CHECK_FALSE(generalized_eigenvalues(to_interval(a), to_interval(not_definite)));
    CHECK_FALSE(generalized_eigenvalues(to_interval(a), symmetric_box_around(random, not_definite, 1e-9)));
  }
  CHECK(verified > rounds * 95 / 100);
}

TEST_CASE("well-conditioned pencils are tight, and a pencil with the identity is a symmetric matrix") {
  IntervalMatrix<3> a;
  a << Interval(4.0), Interval(1.0), Interval(0.0), Interval(1.0), Interval(3.0), Interval(1.0),
      Interval(0.0), Interval(1.0), Interval(2.0);
  const IntervalMatrix<3> identity = IntervalMatrix<3>::Identity();
  const std::optional<IntervalVector<3>> pencil = generalized_eigenvalues(a, identity);
  const std::optional<IntervalVector<3>> values = symmetric_eigenvalues(a);
  REQUIRE(pencil);
  REQUIRE(values);
  // The characteristic polynomial is (3 - x)((x - 3)^2 - 3).
  const long double root = std::sqrt(3.0L);
  for (const auto& enclosures : {*pencil, *values}) {
    CHECK(holds_eigenvalue(enclosures[0], 3.0L - root));
    CHECK(contains(enclosures[1], 3.0));
    CHECK(holds_eigenvalue(enclosures[2], 3.0L + root));
    CHECK(widest_eigenvalue(enclosures) <= 1e-13);
  }
}

TEST_CASE("only the symmetric members count") {
  IntervalMatrix<2> a;
  a << Interval(1.0), Interval::from_bounds(0.0, 10.0), Interval::from_bounds(-10.0, 0.0), Interval(2.0);
  const auto values = symmetric_eigenvalues(a);
  REQUIRE(values);
  CHECK(contains(*values, Vector<2>(1.0, 2.0)));
  CHECK(widest_eigenvalue(*values) <= 1e-13);
  a(1, 0) = Interval(-1.0);  // no symmetric matrix left
  CHECK_FALSE(symmetric_eigenvalues(a));
  CHECK_FALSE(generalized_eigenvalues(a, IntervalMatrix<2>::Identity().eval()));
}

TEST_CASE("nothing for what is not finite, and an exception for what does not fit") {
  for (const Interval& poison : kPoison) {
    const IntervalMatrix<3> identity = IntervalMatrix<3>::Identity();
    IntervalMatrix<3> a = identity;
    a(1, 2) = a(2, 1) = poison;
    CHECK_FALSE(symmetric_eigenvalues(a));
    CHECK_FALSE(generalized_eigenvalues(a, identity));
    CHECK_FALSE(generalized_eigenvalues(identity, a));
    a = identity;
    a(0, 0) = poison;
    CHECK_FALSE(symmetric_eigenvalues(a));
    CHECK_FALSE(generalized_eigenvalues(identity, a));
  }
  CHECK_FALSE(symmetric_eigenvalues(DynamicIntervalMatrix(0, 0)));
  CHECK_THROWS_AS(static_cast<void>(symmetric_eigenvalues(DynamicIntervalMatrix(2, 3))),
                  std::invalid_argument);
  CHECK_THROWS_AS(
      static_cast<void>(generalized_eigenvalues(DynamicIntervalMatrix(2, 2), DynamicIntervalMatrix(3, 3))),
      std::invalid_argument);
  CHECK_FALSE(rounding_is_upward());
}
