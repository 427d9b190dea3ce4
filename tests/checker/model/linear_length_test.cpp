#include "checker/model/linear_length.hpp"

#include <doctest/doctest.h>

namespace veritrack::checker {
namespace {

TEST_CASE("what hardly shrinks in one direction has its length with noise in the other") {
  // |(a x, h y + b v)|^2 over the unit ball of (x, y) and |v| <= 1 is at most a^2 + a^2 b^2 / (a^2 - h^2),
  // and this is reached where y = h b / (a^2 - h^2).
  constexpr double kA = 1.0 - 1e-6;
  constexpr double kH = 0.5;
  const VectorMonomials monomials(2, 1);
  const BallPolynomial x = BallPolynomial::variable(monomials, 0);
  const BallPolynomial y = BallPolynomial::variable(monomials, 1);
  const BallPolynomial v = BallPolynomial::variable(monomials, 2);
  for (const double b : {1e-4, 1e-3, 1e-2, 0.1, 0.3}) {
    CAPTURE(b);
    const LinearLength length({kA * x, kH * y + b * v}, monomials);
    const double of_noise = kA * kA * b * b / (kA * kA - kH * kH);
    CHECK(length.square_is_at_most(kA * kA + 1.01 * of_noise + 1e-9, 1.0));
    CHECK_FALSE(length.square_is_at_most(kA * kA + of_noise - 1e-9, 1.0));
  }
}

}  // namespace
}  // namespace veritrack::checker
