#include "analysis/sets/start_covariance.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::sets {
namespace {

using rigor::Interval;
using rigor::Matrix;

StartCovariance around(double from, double to) {
  Matrix<3> m;
  m << 2.0, 0.5, 0.0, 0.5, 3.0, 1.0, 0.0, 1.0, 4.0;
  return {rigor::to_interval(m), Interval::from_bounds(from, to), false};
}

Matrix<3> multiple(double factor) {
  return factor * rigor::midpoint(around(1.0, 1.0).matrix);
}

TEST_CASE("the multiples between two bounds are those of the bounds") {
  const rigor::UpwardRounding upward;
  const auto found = multiples_between(around(1.0, 1.0), multiple(0.25), multiple(3.0));
  REQUIRE(found.has_value());
  CHECK(found->lower() == doctest::Approx(0.25));
  CHECK(found->lower() > 0.25);
  CHECK(found->upper() == doctest::Approx(3.0));
  CHECK(found->upper() < 3.0);
}

TEST_CASE("one bound alone that is exceeded is enough to refuse") {
  const rigor::UpwardRounding upward;
  CHECK(certainly_between(around(0.5, 2.0), multiple(0.49), multiple(2.01)));
  CHECK_FALSE(certainly_between(around(0.5, 2.0), multiple(0.51), multiple(2.01)));
  CHECK_FALSE(certainly_between(around(0.5, 2.0), multiple(0.49), multiple(1.99)));
  CHECK_FALSE(multiples_between(around(1.0, 1.0), multiple(1.1), multiple(2.0)).has_value());
  CHECK_FALSE(multiples_between(around(1.0, 1.0), multiple(0.5), multiple(0.9)).has_value());
}

TEST_CASE("what is asked for is not widened, and is refused whole") {
  const rigor::UpwardRounding upward;
  StartCovariance asked = around(0.5, 2.0);
  asked.is_given = true;
  const auto found = multiples_between(asked, multiple(0.25), multiple(3.0));
  REQUIRE(found.has_value());
  CHECK(found->lower() == 0.5);
  CHECK(found->upper() == 2.0);
  CHECK_FALSE(multiples_between(asked, multiple(0.25), multiple(1.9)).has_value());
}

TEST_CASE("between two matrices: both ends decide, and the enclosure contains what is between them") {
  const rigor::UpwardRounding upward;
  StartCovariance range = around(1.0, 1.0);
  Matrix<3> top = multiple(1.0);
  top(0, 0) += 1.0;
  top(1, 1) += 2.0;
  top(2, 2) += 3.0;
  range.highest = rigor::to_interval(top);
  CHECK(certainly_between(range, multiple(0.99), Matrix<3>(1.01 * top)));
  CHECK_FALSE(certainly_between(range, multiple(1.01), Matrix<3>(1.01 * top)));
  CHECK_FALSE(certainly_between(range, multiple(0.99), Matrix<3>(0.99 * top)));
  // Between, with correlations that neither end has.
  Matrix<3> tilted = multiple(1.0);
  const Eigen::Vector3d direction(1.0, -std::sqrt(2.0), std::sqrt(3.0));
  tilted += 0.333 * direction * direction.transpose();
  const rigor::IntervalMatrix<3> all = range.enclosure();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      CHECK(rigor::contains(all(i, j), tilted(i, j)));
      CHECK(rigor::contains(all(i, j), top(i, j)));
      CHECK(rigor::is_subset(range.matrix(i, j), all(i, j)));
    }
  }
}

TEST_CASE("the enclosure contains all matrices between the multiples, and not only the multiples") {
  const rigor::UpwardRounding upward;
  const rigor::IntervalMatrix<3> all = around(1.0, 2.0).enclosure();
  Eigen::Vector3d direction(1.0, -1.0, 0.5);
  const Matrix<3> m = multiple(1.0);
  // M + c x x' with c x' M^-1 x <= 1 lies between M and 2 M.
  const double most = 1.0 / direction.dot(m.inverse() * direction);
  const Matrix<3> tilted = m + 0.999 * most * direction * direction.transpose();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      CHECK(rigor::contains(all(i, j), tilted(i, j)));
      CHECK(rigor::contains(all(i, j), m(i, j)));
      CHECK(rigor::contains(all(i, j), 2.0 * m(i, j)));
    }
  }
}

}  // namespace
}  // namespace veritrack::sets
