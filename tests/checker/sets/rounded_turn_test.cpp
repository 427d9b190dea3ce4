// The turn of a vector and of a matrix in double, beside the same in long double.
#include "checker/sets/rounded_turn.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/random.hpp"
#include "trackers/factored_covariance.hpp"

namespace {

using namespace veritrack;
using checker::Ball;

TEST_CASE("a turned vector and a turned matrix differ by at most the bounds, and by some part of them") {
  test::Random random(7160);
  double of_vector = 0.0;
  double on = 0.0;
  double beside = 0.0;
  const auto [diagonal_bound, beside_bound] =
      checker::turned_block(checker::held(Ball(2.0)), checker::held(Ball(1.0)));
  const double vector_bound = checker::turned_component(checker::held(Ball(1.0))).error.near();
  for (std::int64_t i = 0; i < test::effort(20000); ++i) {
    const double angle = random.uniform(-3.2, 3.2);
    const double axis = random.uniform(0.0, 3.2);
    const trackers::FactoredCovariance<double> p{1.0 + std::cos(axis),      std::sin(axis),
                                                 1.0 - std::cos(axis),      random.uniform(-1.0, 1.0),
                                                 random.uniform(-1.0, 1.0), 1.0};
    using Wide = long double;
    const trackers::FactoredCovariance<Wide> same{p.conditional_11, p.conditional_12, p.conditional_22,
                                                  p.regression_1,   p.regression_2,   1.0L};
    const auto computed = turned(p, std::sin(angle), std::cos(angle));
    const Wide wide = angle;
    const auto exact = turned(same, std::sin(wide), std::cos(wide));
    const auto share = [](double x, Wide y, double bound) {
      return static_cast<double>(std::fabs(static_cast<Wide>(x) - y)) / bound;
    };
    of_vector = std::max({of_vector, share(computed.regression_1, exact.regression_1, vector_bound),
                          share(computed.regression_2, exact.regression_2, vector_bound)});
    on = std::max({on, share(computed.conditional_11, exact.conditional_11, diagonal_bound.error.near()),
                   share(computed.conditional_22, exact.conditional_22, diagonal_bound.error.near())});
    beside =
        std::max(beside, share(computed.conditional_12, exact.conditional_12, beside_bound.error.near()));
  }
  MESSAGE("shares: vector " << of_vector << ", diagonal " << on << ", beside " << beside);
  for (const double share : {of_vector, on, beside}) {
    CHECK(share <= 1.0);
    CHECK(share >= 0.05);
  }
}

}  // namespace
