// Each operation on its own, with operands at the ends of their bounds, in 113-bit arithmetic: never above
// the bound, and near it.
#include "checker/numbers/rounded_value.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using checker::Ball;
using checker::RoundedValue;
using Quad = __float128;

double distance(double computed, Quad exact) {
  const Quad difference = static_cast<Quad>(computed) - exact;
  return static_cast<double>(difference < 0 ? -difference : difference);
}

TEST_CASE("sums, products and quotients err by at most their bounds, and come near") {
  test::Random random(7150);
  double sums = 0.0;
  double products = 0.0;
  double quotients = 0.0;
  for (std::int64_t i = 0; i < test::effort(20000); ++i) {
    const double a = random.uniform(1.0, 2.0);
    const double b = random.uniform(1.0, 2.0);
    const double a_error = random.uniform(0.0, 4e-16);
    const double b_error = random.uniform(0.0, 4e-16);
    const RoundedValue x{Ball(a), Ball(a_error)};
    const RoundedValue y{Ball(b), Ball(b_error)};
    // The computed operands are doubles; the exact ones lie at the ends of the errors.
    const Quad exact_a = static_cast<Quad>(a) - a_error;
    const Quad exact_b = static_cast<Quad>(b) - b_error;
    const Quad larger_b = static_cast<Quad>(b) + b_error;
    const auto share = [](double computed, Quad exact, const RoundedValue& bound) {
      const double found = distance(computed, exact) / bound.error.near();
      CHECK(found <= 1.0);
      return found;
    };
    sums = std::max(sums, share(a + b, exact_a + exact_b, sum(x, y)));
    products = std::max(products, share(a * b, exact_a * exact_b, product(x, y)));
    const RoundedValue wider{Ball(b + 1e-15), Ball(b_error)};
    quotients = std::max(quotients, share(a / b, exact_a / larger_b,
                                          quotient(x, wider, Ball(b - 1e-15), Ball(a / b + 1e-15))));
  }
  CHECK(sums > 0.9);
  CHECK(products > 0.9);
  CHECK(quotients > 0.9);
}

TEST_CASE("what may overflow, or be divided by zero, is not bounded") {
  const RoundedValue large = checker::held(Ball(0x1p300));
  CHECK_FALSE(product(large, large).error.finite());
  CHECK(product(large, checker::held(Ball(0x1p200))).error.finite());
  const RoundedValue one = checker::held(Ball(1.0));
  const RoundedValue uncertain{Ball(2.0), Ball(0.5)};
  CHECK_FALSE(quotient(one, uncertain, Ball(0.5), Ball(2.0)).error.finite());
  CHECK_FALSE(quotient(one, uncertain, Ball(0.25), Ball(4.0)).error.finite());
  CHECK(quotient(one, uncertain, Ball(0.75), Ball(2.0)).error.finite());
  CHECK_FALSE(sum(one, {Ball::everything(), Ball(0.0)}).error.finite());
  CHECK_FALSE(sum(one, {Ball(1.0), Ball::everything()}).error.finite());
  // Underflow costs a little even where the result is zero.
  CHECK(product(checker::held(Ball(0.0)), one).error.near() > 0.0);
}

TEST_CASE("what is known besides bounds the size and not the error") {
  const RoundedValue x = RoundedValue{Ball(3.0), Ball(0.25)}.within(Ball(2.0));
  CHECK(x.size.near() == 2.0);
  CHECK(x.error.near() == 0.25);
}

}  // namespace
