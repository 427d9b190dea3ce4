#include "checker/model/gain/mode_damping.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "tests/support/random.hpp"

namespace veritrack::checker {
namespace {

/// With the eigenvalues r e^(+-j angle), in coordinates that are not their own.
BallRows pair_of(double r, double angle) {
  const double real = r * std::cos(angle), imaginary = r * std::sin(angle);
  const double shear = 0.7;
  return {{Ball(real + shear * imaginary), Ball(-imaginary - shear * shear * imaginary)},
          {Ball(imaginary), Ball(real - shear * imaginary)}};
}

/// Both on the diagonal, and something beside it.
BallRows together(const BallRows& x, const BallRows& y) {
  BallRows all(x.size() + y.size(), std::vector<Ball>(x.size() + y.size()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < all.size(); ++j) {
      const bool in_x = i < x.size() && j < x.size();
      const bool in_y = i >= x.size() && j >= x.size();
      all[i][j] = in_x ? x[i][j] : in_y ? y[i - x.size()][j - x.size()] : Ball(i < j ? 3.0 : 0.0);
    }
  }
  return all;
}

double damping_of(double r, double angle) {
  return -std::log(r) / std::hypot(std::log(r), angle);
}

}  // namespace

TEST_CASE("the damping of a pair is that of the textbook") {
  test::Random random(37031);
  for (std::int64_t i = 0; i < test::effort(100); ++i) {
    // Slow loops and fast ones.
    const double r = std::exp(-std::pow(10.0, random.uniform(-6.0, 0.3)));
    const double damping = random.uniform(0.02, 0.97);
    const double angle = -std::log(r) * std::sqrt(1.0 - damping * damping) / damping;
    CAPTURE(r);
    CAPTURE(damping);
    if (angle > 0.99 * std::numbers::pi) {
      continue;
    }
    const double exact = damping_of(r, angle);
    CHECK(modes_damped_more_than(pair_of(r, angle), Ball(exact * (1.0 - 1e-6))) == 2);
    CHECK(modes_damped_more_than(pair_of(r, angle), Ball(exact * (1.0 + 1e-6))) == 0);
  }
}

TEST_CASE("modes are counted, with those that decay at once") {
  const BallRows pairs = together(pair_of(0.9, 0.3), pair_of(0.9, 0.05));  // 0.33 and 0.90
  CHECK(modes_damped_more_than(pairs, Ball(0.3)) == 4);
  CHECK(modes_damped_more_than(pairs, Ball(0.5)) == 2);
  CHECK(modes_damped_more_than(pairs, Ball(0.95)) == 0);
  CHECK(modes_damped_more_than(together(pairs, {{zero}}), Ball(0.5)) == 3);
  CHECK(modes_damped_more_than({{zero, one}, {zero, zero}}, Ball(0.99)) == 2);
  // Equal ones, as in a loop that is critically damped.
  CHECK(modes_damped_more_than({{Ball(0.75), one}, {zero, Ball(0.75)}}, Ball(0.999)) == 2);
  // ln(-0.5) = -0.69 + pi j: 0.2155.
  CHECK(modes_damped_more_than({{Ball(-0.5)}}, Ball(0.215)) == 1);
  CHECK(modes_damped_more_than({{Ball(-0.5)}}, Ball(0.216)) == 0);
  CHECK(modes_damped_more_than(pair_of(1.01, 0.2), Ball(0.01)) == 0);
  CHECK(modes_damped_more_than({{two}}, Ball(0.01)) == 0);
}

TEST_CASE("nothing is said of what is wide, at the limit or no number") {
  CHECK_FALSE(modes_damped_more_than({{Ball::hull(Ball(-1.5), Ball(1.5))}}, Ball(0.1)));
  CHECK_FALSE(modes_damped_more_than({{one}}, Ball(0.1)));
  CHECK_FALSE(modes_damped_more_than({{Ball(NAN)}}, Ball(0.1)));
  CHECK_FALSE(modes_damped_more_than({{Ball::everything()}}, Ball(0.1)));
  CHECK_FALSE(modes_damped_more_than({}, Ball(0.1)));
  for (const double damping : {0.0, -0.1, 1.0, 1.5, static_cast<double>(NAN)}) {
    CHECK_FALSE(modes_damped_more_than({{Ball(0.5)}}, Ball(damping)));
  }
  CHECK_FALSE(modes_damped_more_than({{Ball(0.5)}}, Ball::hull(Ball(0.5), Ball(1.5))));
}

}  // namespace veritrack::checker
