#include "checker/dft_block/tone_polynomial.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using checker::Ball;

constexpr double kPi = 3.141592653589793;

/// sinc and its derivative, by their definitions.
double sinc(double d) {
  return std::fabs(d) < 1e-8 ? 1.0 : std::sin(kPi * d) / (kPi * d);
}
double slope(double d) {
  return std::fabs(d) < 1e-3 ? -kPi * kPi * d / 3.0 : (std::cos(kPi * d) - sinc(d)) / d;
}

/// Is the value within the ball, up to what the oracle's own rounding does?
bool holds(const Ball& ball, double value) {
  constexpr double kOracle = 1e-6;
  return ball.lower_double() - kOracle <= value && value <= ball.upper_double() + kOracle;
}

TEST_CASE("the polynomials hold the sums over the bins") {
  test::Random random(20'254);
  const std::int64_t cases = test::effort(60);
  for (std::int64_t i = 0; i < cases; ++i) {
    const int half_width = 1 + static_cast<int>(i % 4);
    const double middle = i % 5 == 0 ? std::round(random.uniform(-2.0, 2.0)) : random.uniform(-3.0, 3.0);
    const double x = random.uniform(-0.2, 0.2);
    const double d = random.uniform(-0.05, 0.05);
    const checker::MeetingSums sums = checker::TonePolynomial(Ball(middle), half_width).at(Ball(x), Ball(d));
    double aa = 0.0;
    double ab = 0.0;
    double bb = 0.0;
    double bt = 0.0;
    double ac = 0.0;
    for (int m = -half_width; m <= half_width; ++m) {
      const double at_x = middle + x + m;
      const double at_d = middle + d + m;
      aa += sinc(at_x) * sinc(at_x);
      ab += sinc(at_x) * slope(at_x);
      bb += slope(at_x) * slope(at_x);
      bt += slope(at_x) * sinc(at_d);
      ac += sinc(at_x) * (sinc(at_x) - sinc(at_d)) / (x - d);
    }
    CAPTURE(middle);
    CAPTURE(x);
    CAPTURE(d);
    CHECK(holds(sums.aa, aa));
    CHECK(holds(sums.ab, ab));
    CHECK(holds(sums.bb, bb));
    CHECK(holds(sums.bt, bt));
    CHECK(holds(sums.ac, ac));
    CHECK(sums.ac.radius().near() < 1e-5);
  }
}

TEST_CASE("beyond half a bin nothing is known") {
  const checker::TonePolynomial polynomial(Ball(0.3), 2);
  CHECK_FALSE(polynomial.at(Ball(0.6), Ball(0.0)).aa.finite());
  CHECK_FALSE(polynomial.at(Ball::everything(), Ball(0.0)).bc.finite());
}

}  // namespace
