#include "analysis/search/maximin.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace veritrack::search {
namespace {

SearchSpace square(double size, int evaluations) {
  return {Eigen::Vector2d(0.7 * size, -0.4 * size), Eigen::Vector2d(0.1, 0.1), Eigen::Vector2d(-size, -size),
          Eigen::Vector2d(size, size), evaluations};
}

}  // namespace

TEST_CASE("the least of three planes is largest where all meet") {
  const auto planes = [](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(Eigen::Vector3d(1.0 - x[0] - x[1], 1.0 + 2.0 * x[0], 1.0 + x[1] - x[0]));
  };
  // The gradients (-1, -1), (2, 0), (-1, 1) add up to zero: no way leads up in all three, and they meet in 0.
  const BestPoint found = climb_least(planes, square(2.0, 400));
  CHECK(found.value == doctest::Approx(1.0).epsilon(1e-5));
  CHECK(found.point.norm() < 1e-3);
}

TEST_CASE("the center of the smallest circle about points is where the largest distance is least") {
  // A right angle: the circle about its longest side.
  const auto distances = [](const Eigen::VectorXd& x) {
    const auto to = [&](double a, double b) { return -std::hypot(x[0] - a, x[1] - b); };
    return Eigen::VectorXd(Eigen::Vector3d(to(0.0, 0.0), to(3.0, 0.0), to(0.0, 4.0)));
  };
  const BestPoint found = climb_least(distances, square(5.0, 600));
  CHECK(found.value == doctest::Approx(-2.5).epsilon(1e-4));
  CHECK(found.point[0] == doctest::Approx(1.5).epsilon(1e-2));
  CHECK(found.point[1] == doctest::Approx(2.0).epsilon(1e-2));
}

TEST_CASE("the result is the best of what was evaluated, within the evaluations, and what is thrown passes") {
  int calls = 0;
  const auto odd = [&](const Eigen::VectorXd& x) {
    ++calls;
    return Eigen::VectorXd(Eigen::Vector2d(std::numeric_limits<double>::quiet_NaN(), x[0]));
  };
  const BestPoint found = climb_least(odd, square(1.0, 20));
  CHECK(calls <= 20);
  CHECK(found.value <= -1e8);
  CHECK_THROWS_AS(
      (void)climb_least([](const Eigen::VectorXd&) -> Eigen::VectorXd { throw std::domain_error(""); },
                        square(1.0, 20)),
      std::domain_error);
  SearchSpace uneven = square(1.0, 20);
  uneven.step.resize(1);
  CHECK_THROWS_AS((void)climb_least(odd, uneven), std::invalid_argument);
}

}  // namespace veritrack::search
