#include "checker/model/place_matrix.hpp"

#include <doctest/doctest.h>

#include <limits>

namespace veritrack::checker {
namespace {

BallPolynomial at_place(double constant, double by_phase, double by_frequency, double error = 0.0) {
  return BallPolynomial::affine(constant, by_phase, by_frequency, error);
}

TEST_CASE("a matrix over a cell is certainly definite only where it is at all places") {
  const auto matrix = [](double a, double b, double error) {
    return symmetric_of({at_place(2.0, a, 0.0), BallPolynomial(1.0), at_place(2.0, 0.0, b, error)}, 2);
  };
  CHECK(certainly_definite(matrix(0.0, 0.0, 0.0)));
  CHECK(certainly_definite(matrix(0.3, 0.3, 0.0)));
  CHECK_FALSE(certainly_definite(matrix(1.6, 0.0, 0.0)));
  CHECK_FALSE(certainly_definite(matrix(0.0, 1.6, 0.0)));
  CHECK_FALSE(certainly_definite(matrix(0.0, 0.0, 1.6)));
  CHECK_FALSE(certainly_definite(matrix(0.0, 0.0, std::numeric_limits<double>::infinity())));
  CHECK_FALSE(
      certainly_definite(symmetric_of({BallPolynomial(1.0), BallPolynomial(1.0), BallPolynomial(1.0)}, 2)));
  CHECK_FALSE(certainly_definite(symmetric_of({BallPolynomial::everything()}, 1)));
  CHECK_FALSE(certainly_definite(symmetric_of({BallPolynomial(-1.0)}, 1)));
}

TEST_CASE("roots, inverses and products of matrices over a cell contain those at its places") {
  const PlaceMatrix a =
      symmetric_of({at_place(2.0, 0.1, 0.0), at_place(0.5, 0.0, 0.05), at_place(1.0, -0.1, 0.1)}, 2);
  const PlaceMatrix root = root_of(a);
  const PlaceMatrix again = sum(product(root, mirrored(root)), a, BallPolynomial(-1.0));
  const PlaceMatrix one_again = product(positive_inverse(a), a);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      CHECK(certainly_at_most(abs(again[i][j].range()), Ball(1e-3)));
      CHECK(certainly_at_most(abs(one_again[i][j].range() - Ball(i == j ? 1.0 : 0.0)), Ball(0.02)));
    }
  }
  const std::vector<BallPolynomial> x = forward(root, {a[0][0], a[1][0]});
  // L^-1 A e_0 = L' e_0, of which the second entry is 0.
  CHECK(certainly_at_most(abs((x[0] - root[0][0]).range()), Ball(1e-3)));
  CHECK(certainly_at_most(abs(x[1].range()), Ball(1e-3)));
  // Nothing is known where a pivot can vanish, or a matrix is not certainly positive definite.
  CHECK_FALSE(root_of(symmetric_of({at_place(1.0, 2.0, 0.0)}, 1))[0][0].known());
  CHECK_FALSE(positive_inverse(symmetric_of({at_place(1.0, 2.0, 0.0)}, 1))[0][0].known());
  CHECK_FALSE(
      positive_inverse(symmetric_of({BallPolynomial(1.0), BallPolynomial(2.0), BallPolynomial(1.0)}, 2))[0][0]
          .known());
}

}  // namespace
}  // namespace veritrack::checker
