#include "analysis/search/maximize.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace veritrack::search {
namespace {

SearchSpace plane() {
  SearchSpace space;
  space.start = Eigen::Vector2d(-1.0, 2.0);
  space.step = Eigen::Vector2d(0.5, 0.5);
  space.lower = Eigen::Vector2d(-5.0, -5.0);
  space.upper = Eigen::Vector2d(5.0, 5.0);
  space.evaluations = 400;
  return space;
}

double with_a_kink(const Eigen::VectorXd& x) {
  return -std::fabs(x[0] - 1.0) - 2.0 * std::fabs(x[1] + 0.5);
}

TEST_CASE("finds the top of a concave function with a kink") {
  const BestPoint best = maximize(with_a_kink, plane());
  CHECK(best.value > -0.05);
  CHECK(best.value == with_a_kink(best.point));
}

TEST_CASE("stops at the first point that is good enough") {
  SearchSpace space = plane();
  space.enough = -2.0;
  int evaluations = 0;
  const BestPoint best = maximize(
      [&](const Eigen::VectorXd& x) {
        ++evaluations;
        return with_a_kink(x);
      },
      space);
  CHECK(best.value >= space.enough);
  CHECK(best.value < -0.05);
  CHECK(evaluations < 50);
}

TEST_CASE("climbs a smooth hill to its top, in five variables") {
  const auto hill = [](const Eigen::VectorXd& x) {
    const double ridge = x[1] - x[0] * x[0];
    return -ridge * ridge - 0.1 * (x[0] - 1.0) * (x[0] - 1.0) - x.tail(3).squaredNorm();
  };
  SearchSpace space;
  space.start = Eigen::VectorXd::Constant(5, -1.0);
  space.step = Eigen::VectorXd::Constant(5, 0.2);
  space.lower = Eigen::VectorXd::Constant(5, -5.0);
  space.upper = Eigen::VectorXd::Constant(5, 5.0);
  space.evaluations = 4000;
  const BestPoint best = climb(hill, space);
  CHECK(best.value > -0.02);
  CHECK(best.value == hill(best.point));
  CHECK(climb(hill, space).point == best.point);
  space.evaluations = 3;
  CHECK(climb(hill, space).value >= hill(space.start));
}

TEST_CASE("the same calls give the same result") {
  const BestPoint first = maximize(with_a_kink, plane());
  const BestPoint second = maximize(with_a_kink, plane());
  CHECK(first.value == second.value);
  CHECK(first.point == second.point);
}

TEST_CASE("stays in the box, within the budget, and returns the best point evaluated") {
  SearchSpace space = plane();
  space.evaluations = 37;
  int calls = 0;
  double highest = -std::numeric_limits<double>::infinity();
  const BestPoint best = maximize(
      [&](const Eigen::VectorXd& x) {
        ++calls;
        CHECK((x.array() >= space.lower.array()).all());
        CHECK((x.array() <= space.upper.array()).all());
        highest = std::max(highest, x[0] + x[1]);
        return x[0] + x[1];
      },
      space);
  CHECK(calls <= 37);
  CHECK(best.value == highest);
}

TEST_CASE("an objective of NaN or minus infinity finds nothing and complains of nothing") {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    const BestPoint best = maximize([&](const Eigen::VectorXd&) { return bad; }, plane());
    CHECK(best.point == plane().start);
    CHECK(best.value < -1e300);
  }
}

TEST_CASE("exceptions of the objective pass through") {
  CHECK_THROWS_AS(
      (void)maximize([](const Eigen::VectorXd&) -> double { throw std::domain_error("no"); }, plane()),
      std::domain_error);
}

TEST_CASE("sizes that differ are refused") {
  SearchSpace space = plane();
  space.step = Eigen::Vector3d(1.0, 1.0, 1.0);
  CHECK_THROWS_AS((void)maximize(with_a_kink, space), std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::search
