#include "papers/claims/sine_filter_claims.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <set>
#include <stdexcept>
#include <string>

#include "analysis/rigor/rounding.hpp"
#include "papers/claims/signed_expression.hpp"
#include "tests/support/random.hpp"
#include "trackers/zarchan/zarchan_ekf.hpp"

using namespace veritrack;
using theorems::SignedExpression;

TEST_CASE("an expression keeps its signs outside, and half a turn turns sine and cosine") {
  const auto a = SignedExpression::symbol("a");
  const auto b = SignedExpression::symbol("b");
  CHECK((-a) * b == -(b * a));
  CHECK(-a - b == -(b + a));
  CHECK(a - b == -(b - a));
  CHECK((a - a).is_zero());
  CHECK((a / -b) == -(a / b));
  CHECK_FALSE(a + b == a - b);
  CHECK_FALSE(a / b == b / a);
  CHECK_FALSE(SignedExpression(0.1) == SignedExpression(0.1 + 1e-17 * 2.0));
  const auto [sine, cosine] = sin_cos(a);
  const auto [mirrored_sine, mirrored_cosine] = sin_cos(-a);
  CHECK(mirrored_sine == -sine);
  CHECK(mirrored_cosine == cosine);
  const auto [turned_sine, turned_cosine] = sin_cos(a.half_turn_on());
  CHECK(turned_sine == -sine);
  CHECK(turned_cosine == -cosine);
  CHECK(a.half_turn_on() + b == (a + b).half_turn_on());
  CHECK_THROWS_AS((void)(a.half_turn_on() * b), std::logic_error);
  CHECK_THROWS_AS((void)-a.half_turn_on(), std::logic_error);
  CHECK_THROWS_AS((void)(a.half_turn_on() + a.half_turn_on()), std::logic_error);
}

TEST_CASE("all symmetries are proved, and that nothing settles") {
  const rigor::UpwardRounding upward;
  std::set<std::string> found;
  for (const theorems::Statement& statement : theorems::sine_filter_claims()) {
    CAPTURE(statement.id);
    CHECK_FALSE(statement.witness.empty());
    CHECK(found.insert(statement.id).second);
    CHECK(statement.verdict == rigor::Verdict::proved);
  }
  CHECK(found.size() == 13);
}

TEST_CASE("without process noise the variance of the frequency goes on falling") {
  test::Random random(4'404);
  for (int run = 0; run < 20; ++run) {
    trackers::SineKnownAmplitudeEkf<double> filter(
        {0.1, 0.1, 0.0, 0.0}, 1.0, {Eigen::Vector2d(0.0, 1.0), Eigen::Vector2d(0.1, 1.0).asDiagonal()});
    double before = 1.0;
    for (int k = 0; k < 400; ++k) {
      filter.step(random.uniform(-1.0, 1.0));
      if (k % 50 == 49) {
        CHECK(filter.filtered().covariance(1, 1) < before);
        before = filter.filtered().covariance(1, 1);
      }
    }
  }
}
