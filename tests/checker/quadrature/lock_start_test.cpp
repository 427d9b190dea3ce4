// The level of starts against points of them.
#include "checker/quadrature/lock_start.hpp"

#include <doctest/doctest.h>

#include "tests/checker/quadrature/lock_support.hpp"

using namespace veritrack;
using namespace veritrack::checker;
using lock_test::Matrix;
using lock_test::Textbook;

namespace {

Matrix3 balls_of(const Matrix& p) {
  Matrix3 m;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      m[i][j] = Ball(p(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
  }
  return m;
}

/// A covariance in which everything is correlated.
Matrix the_covariance() {
  Matrix p;
  p << 4e-3, 5e-4, -3e-4, 5e-4, 6e-3, 2e-3, -3e-4, 2e-3, 4e-3;
  return p;
}

}  // namespace

TEST_CASE("every start is at most at the level that is found, and some are close to it") {
  const Textbook book{{}, lock_test::WrittenSet().set()};
  test::Random random(5320);
  for (const double phase : {0.0, 0.05, 0.6, 3.5}) {
    const LockStart start{Ball(0.1), Ball(phase), Ball(0.03)};
    const Matrix lowest = the_covariance();
    const Matrix highest = 1.5 * lowest;
    const Ball found = start_level(book.set, start, {balls_of(lowest), balls_of(highest), ""});
    REQUIRE(found.finite());
    double most = 0.0;
    for (std::int64_t k = 0; k < test::effort(4000); ++k) {
      // Ends more often than what is between them.
      const auto share = [&] { return std::clamp(random.uniform(-2.0, 2.0), -1.0, 1.0); };
      const double a = 1.0 + 0.1 * share();
      const double psi = phase * share();
      const double f = 0.03 * share();
      const lock_test::Vector e(a * std::cos(psi) - 1.0, a * std::sin(psi), f);
      Matrix turn = Matrix::Identity();
      turn(0, 0) = turn(1, 1) = std::cos(psi);
      turn(1, 0) = std::sin(psi);
      turn(0, 1) = -turn(1, 0);
      const Matrix p = (1.25 + 0.25 * share()) * lowest;
      const double s = book.level_of(turn * p * turn.transpose());
      most = std::max(most, 0.5 * ((book.metric() * e).squaredNorm() + book.set.weight.near() * s * s));
    }
    MESSAGE("phase error " << phase << ": level " << found.near() << ", sampled " << most);
    CHECK(most <= found.near());
    CHECK(found.near() <= 1.05 * most + 1e-6);
  }
}

TEST_CASE("the steady state itself has level 0") {
  const Textbook book{{}, lock_test::WrittenSet().set()};
  const Matrix3 centre = balls_of(lock_test::in_double(book.set.centre));
  const Ball found = start_level(book.set, {zero, zero, zero}, {centre, centre, ""});
  CHECK(certainly_not_negative(found));
  CHECK(certainly_less(found, Ball(1e-9)));
}

TEST_CASE("starts with no level have none") {
  const Textbook book{{}, lock_test::WrittenSet().set()};
  const Matrix3 centre = balls_of(lock_test::in_double(book.set.centre));
  const Matrix3 singular = diagonal(Ball(1e-3), Ball(1e-3), zero);
  const LockStart start{Ball(0.1), Ball(0.1), Ball(0.01)};
  CHECK(start_level(book.set, start, {centre, centre, ""}).finite());
  CHECK_FALSE(start_level(book.set, start, {singular, centre, ""}).finite());
  CHECK_FALSE(start_level(book.set, {Ball(-0.1), zero, zero}, {centre, centre, ""}).finite());
  CHECK_FALSE(start_level(book.set, {zero, Ball(-0.1), zero}, {centre, centre, ""}).finite());
  CHECK_FALSE(start_level(book.set, {zero, zero, Ball(-0.1)}, {centre, centre, ""}).finite());
  CHECK_FALSE(start_level(book.set, {zero, Ball::everything(), zero}, {centre, centre, ""}).finite());
}
