#include "checker/numbers/ball.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "checker/numbers/matrix3.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using namespace veritrack::checker;

bool contains(const Ball& ball, const Ball& point) {
  return arb_contains(ball.raw(), point.raw()) != 0;
}

}  // namespace

TEST_CASE("what is not a number, or may be infinite, is certain of nothing") {
  for (const Ball& odd :
       {Ball::everything(), Ball(1.0) / Ball(0.0), sqrt(Ball(-1.0)), log(Ball(0.0)), Ball(HUGE_VAL)}) {
    CHECK(!certainly_positive(odd));
    CHECK(!certainly_less(odd, Ball(1.0)));
    CHECK(!certainly_less(Ball(1.0), odd));
    CHECK(!certainly_at_most(odd, odd));
    CHECK(!certainly_equal(odd, odd));
    CHECK(!certainly_not_negative(odd));
  }
}

TEST_CASE("what is certainly not negative") {
  CHECK(certainly_not_negative(zero));
  CHECK(certainly_not_negative(Ball::hull(one, two)));
  CHECK(!certainly_not_negative(Ball(-1.0)));
  CHECK(!certainly_not_negative(Ball::within(one)));
}

TEST_CASE("a matrix is symmetric only when each entry equals its mirror image") {
  Matrix3 p = diagonal(one, two, one);
  p[1][0] = p[0][1] = p[2][0] = p[0][2] = p[2][1] = p[1][2] = Ball(0.5);
  CHECK(symmetric(p));
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      Matrix3 other = p;
      other[i][j] = Ball(0.5 + 0x1p-50);
      CHECK(!symmetric(other));
      other[i][j] = p[i][j] + Ball::within(Ball(0x1p-50));  // not one number
      CHECK(!symmetric(other));
    }
  }
}

TEST_CASE("a ball has its middle and its radius") {
  const Ball ball = Ball::hull(one, Ball(3.0));
  CHECK(certainly_equal(ball.middle(), two));
  CHECK(certainly_equal(one.radius(), zero));
  CHECK(certainly_at_most(one, ball.radius()));
  CHECK(certainly_less(ball.radius(), Ball(1.0 + 0x1p-20)));
}

TEST_CASE("results of wide balls contain those of points, and little else") {
  constexpr double kRounding = 0x1p-26;  // of radii
  test::Random random(71);
  const auto ends_of = [](const Ball& ball) { return std::array{ball.lower_double(), ball.upper_double()}; };
  const auto near = [](double value, double ideal, double size) {
    return std::fabs(value - ideal) <= kRounding * size;
  };
  for (std::int64_t i = 0; i < test::effort(2000); ++i) {
    CAPTURE(i);
    std::array<double, 4> e{};
    for (double& end : e) {
      end = random.uniform(-1.0, 1.0) * std::exp2(-static_cast<double>(random.below(3)));
    }
    const Ball x = Ball::hull(Ball(e[0]), Ball(e[1]));
    const Ball y = Ball::hull(Ball(e[2]), Ball(e[3]));
    const std::array products{e[0] * e[2], e[0] * e[3], e[1] * e[2], e[1] * e[3]};
    const auto [least, most] = std::minmax_element(products.begin(), products.end());
    const auto product = ends_of(x * y);
    CHECK(near(product[0], *least, 1.0));
    CHECK(near(product[1], *most, 1.0));
    const double share = random.uniform(0.0, 1.0);
    const double of_x = e[0] + share * (e[1] - e[0]);
    const double of_y = e[2] + random.uniform(0.0, 1.0) * (e[3] - e[2]);
    CHECK(contains(x * y, Ball(of_x) * Ball(of_y)));
    const bool holds_zero = e[0] * e[1] <= 0.0;
    const auto squares = ends_of(square(x));
    CHECK(near(squares[0], holds_zero ? 0.0 : std::fmin(e[0] * e[0], e[1] * e[1]), 1.0));
    CHECK(near(squares[1], std::fmax(e[0] * e[0], e[1] * e[1]), 1.0));
    CHECK(contains(square(x), Ball(of_x) * Ball(of_x)));
    const double low = std::fmin(std::fabs(e[0]), std::fabs(e[1]));
    const double high = std::fmax(std::fabs(e[0]), std::fabs(e[1]));
    const Ball z = Ball::hull(Ball(low), Ball(high));
    const auto root = ends_of(sqrt(z));
    CHECK(near(root[0], std::sqrt(z.lower_double()), 1.0));
    CHECK(near(root[1], std::sqrt(high), 1.0));
    const auto logarithm = ends_of(log(z));
    CHECK(near(logarithm[0], std::log(z.lower_double()), 50.0));
    CHECK(near(logarithm[1], std::log(high), 50.0));
    const auto angle = ends_of(arctangent(x));
    CHECK(near(angle[0], std::atan(std::fmin(e[0], e[1])), 1.0));
    CHECK(near(angle[1], std::atan(std::fmax(e[0], e[1])), 1.0));
    const auto of_sine = ends_of(arcsine(x));
    CHECK(near(of_sine[0], std::asin(std::fmin(e[0], e[1])), 2.0));
    CHECK(near(of_sine[1], std::asin(std::fmax(e[0], e[1])), 2.0));
  }
  const Ball beyond = Ball::hull(Ball(-0.5), two);
  for (const Ball& odd : {sqrt(beyond), log(beyond), arcsine(beyond), log(Ball::hull(zero, one))}) {
    CHECK(!odd.finite());
  }
  CHECK(certainly_not_negative(square(Ball::within(one))));
  CHECK(!(square(Ball::everything()).finite() || (Ball::everything() * beyond).finite()));
}

TEST_CASE("decimals and hexadecimal numbers") {
  CHECK(certainly_equal(from_decimal("0.5"), Ball(0.5)));
  CHECK(certainly_equal(from_decimal("-1_000.25e+1"), Ball(-10002.5)));
  CHECK(contains(from_decimal("0.1") * Ball(10.0), Ball(1.0)));
  CHECK(!contains(from_decimal("0.1"), Ball(0.1)));  // the double is another number
  for (const char* text : {"", "-", ".5", "1.", "1e", "1e+", "0x1p+0", "nan", "inf", "1 ", " 1", "1__0", "_1",
                           "1_", "1e99999", "1,5", "[1 +/- 2]", "1e5.5"}) {
    CHECK_THROWS_AS_MESSAGE((void)from_decimal(text), std::invalid_argument, text);
  }
  CHECK(certainly_equal(from_hexadecimal("-0x1.8p-3"), Ball(-0.1875)));
  CHECK(certainly_equal(from_hexadecimal("0x0p+0"), Ball(0.0)));
  for (const char* text :
       {"", "0x", "0x1", "0x1p", "0x1p+", "1p+0", "0x2p+0", "0x1.p+0", "0x1.8P+0", "0x1.8p0", "inf", "nan",
        "+0x1p+0", "0x1p+0 ", "0x1.ffffffffffffffp+0", "0x1p+99999"}) {
    CHECK_THROWS_AS_MESSAGE((void)from_hexadecimal(text), std::invalid_argument, text);
  }
}

TEST_CASE("ratios over balls contain their values at points of them") {
  test::Random random(73);
  for (std::int64_t i = 0; i < test::effort(2000); ++i) {
    const double centre = random.uniform(-2.9, 2.9) * std::exp2(-static_cast<double>(random.below(60)));
    const double radius = std::fmin(0.09, std::exp2(-static_cast<double>(random.below(60))));
    const Ball x = Ball::hull(Ball(centre - radius), Ball(centre + radius));
    const Ball at(random.uniform(centre - radius, centre + radius));
    CAPTURE(centre);
    CAPTURE(radius);
    const Ratio sine = sine_ratio(x);
    const Ratio arctangent = arctangent_ratio(x);
    if (std::fabs(at.near()) > 1e-6) {
      Ball angle;
      arb_atan(angle.raw(), at.raw(), 400);
      CHECK(arb_overlaps(sine.value.raw(), (sin(at) / at).raw()) != 0);
      CHECK(arb_overlaps(sine.slope.raw(), ((cos(at) - sin(at) / at) / square(at)).raw()) != 0);
      CHECK(arb_overlaps(arctangent.value.raw(), (angle / at).raw()) != 0);
      CHECK(arb_overlaps(arctangent.slope.raw(),
                         ((Ball(1.0) / (Ball(1.0) + square(at)) - angle / at) / square(at)).raw()) != 0);
    }
    CHECK(sine.value.finite());
    CHECK(arctangent.slope.finite());
  }
  CHECK(!sine_ratio(Ball(3.5)).value.finite());
}

TEST_CASE("matrices: eigenvalues, inverse, definiteness") {
  test::Random random(74);
  for (std::int64_t i = 0; i < test::effort(300); ++i) {
    CAPTURE(i);
    Matrix3 root;
    for (auto& row : root) {
      for (Ball& entry : row) {
        entry = Ball(random.uniform(-1.0, 1.0));
      }
    }
    const Matrix3 p = congruent(root, diagonal(Ball(1.0), Ball(2.0), Ball(3.0)));
    const Range eigenvalues = extreme_eigenvalues(p);
    const Ball shift(1e-9);
    const auto minus = [&](const Ball& x) { return diagonal(x, x, x); };
    CHECK(definite(p - minus(eigenvalues.low - shift)));
    CHECK(!definite(p - minus(eigenvalues.low + shift)));
    CHECK(definite(minus(eigenvalues.high + shift) - p));
    CHECK(!definite(minus(eigenvalues.high - shift) - p));
    const Matrix3 over = inverse(p);
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column) {
        const Ball product =
            p[row][0] * over[0][column] + p[row][1] * over[1][column] + p[row][2] * over[2][column];
        CHECK(contains(product, Ball(row == column ? 1.0 : 0.0)));
      }
    }
  }
}
