#include "analysis/search/constrained.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

namespace veritrack::search {
namespace {

/// Minimize x + y on the circle of radius 1: at -(1, 1) / sqrt 2.
ConstrainedProblem circle() {
  ConstrainedProblem problem;
  problem.start = Eigen::Vector2d(0.3, -0.8);
  problem.lower = Eigen::Vector2d(-2.0, -2.0);
  problem.upper = Eigen::Vector2d(2.0, 2.0);
  problem.objective = [](const Eigen::VectorXd& x) {
    return Differentiated{Eigen::VectorXd::Constant(1, x.sum()), Eigen::MatrixXd::Ones(1, 2)};
  };
  problem.constraints = [](const Eigen::VectorXd& x) {
    return Differentiated{Eigen::VectorXd::Constant(1, x.squaredNorm()), 2.0 * x.transpose()};
  };
  problem.constraints_lower = problem.constraints_upper = Eigen::VectorXd::Ones(1);
  return problem;
}

TEST_CASE("a minimum on a circle") {
  const ConstrainedPoint found = minimize_constrained(circle());
  CHECK(found.point(0) == doctest::Approx(-std::sqrt(0.5)).epsilon(1e-9));
  CHECK(found.point(1) == doctest::Approx(-std::sqrt(0.5)).epsilon(1e-9));
  CHECK(found.objective == doctest::Approx(-std::sqrt(2.0)).epsilon(1e-9));
}

TEST_CASE("the same problem gives the same point, and bounds are kept") {
  ConstrainedProblem problem = circle();
  problem.lower(0) = 0.0;
  const ConstrainedPoint first = minimize_constrained(problem);
  const ConstrainedPoint second = minimize_constrained(problem);
  CHECK(first.point == second.point);
  CHECK(first.point(0) >= 0.0);
  CHECK(first.point(1) == doctest::Approx(-1.0).epsilon(1e-9));
}

TEST_CASE("exceptions pass through, and sizes that differ are refused") {
  ConstrainedProblem problem = circle();
  problem.objective = [](const Eigen::VectorXd&) -> Differentiated { throw std::domain_error("no"); };
  CHECK_THROWS_AS((void)minimize_constrained(problem), std::domain_error);
  problem = circle();
  problem.upper = Eigen::Vector3d::Ones();
  CHECK_THROWS_AS((void)minimize_constrained(problem), std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::search
