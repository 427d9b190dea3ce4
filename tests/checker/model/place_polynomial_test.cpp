// Functions of a place in a cell against Arb at random places.
#include "checker/model/place_polynomial.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "checker/model/formula.hpp"
#include "checker/model/rounding.hpp"
#include "tests/support/random.hpp"

namespace veritrack::checker {
namespace {

struct CellPlace {
  double s = 0.0;
  double z = 0.0;
};

CellPlace random_cell_place(test::Random& random) {
  const auto coordinate = [&] {
    const std::uint64_t which = random.below(4);
    return which == 0 ? 1.0 : which == 1 ? -1.0 : random.uniform(-1.0, 1.0);
  };
  const double s = coordinate();
  return {s, coordinate()};
}

/// Whether the function with this value there may be one of those that f stands for.
bool covers_place(const PlacePolynomial& f, const CellPlace& place, const Ball& exact) {
  Ball value;
  std::size_t at = 0;
  for (int d = 0; d <= BallPolynomial::kMostDegree; ++d) {
    for (int m = 0; m <= d; ++m) {
      value += Ball(f.coefficients[at++]) * whole_power(Ball(place.s), d - m) * whole_power(Ball(place.z), m);
    }
  }
  return !certainly_less(Ball(f.error), abs(value - exact)) && !certainly_less(Ball(f.norm()), abs(value));
}

TEST_CASE("cosine and sine of an affine function") {
  test::Random random(85);
  for (std::int64_t trial = 0; trial < test::effort(500); ++trial) {
    const double c = random.uniform(-100.0, 100.0);
    const double size = std::pow(10.0, random.uniform(-8.0, 0.0));
    const Ball by_s = Ball(random.uniform(-1.0, 1.0)) * Ball(size) / Ball(3.0);
    const Ball by_z = Ball(random.uniform(-1.0, 1.0)) * Ball(size) / Ball(3.0);
    const CosineSine found{Ball(c), by_s, by_z};
    for (int i = 0; i < 5; ++i) {
      const CellPlace place = random_cell_place(random);
      const Ball argument = Ball(c) + by_s * Ball(place.s) + by_z * Ball(place.z);
      REQUIRE(covers_place(found.cosine, place, cos(argument)));
      REQUIRE(covers_place(found.sine, place, sin(argument)));
    }
    CHECK(found.cosine.error < 3e-15 + std::pow(size, 5.0));
  }
  CHECK_FALSE(std::isfinite(CosineSine(Ball::everything(), one, one).sine.error));
  CHECK_FALSE(std::isfinite(CosineSine(one, Ball::everything(), one).cosine.error));
}

TEST_CASE("powers, products and sums") {
  test::Random random(86);
  for (std::int64_t trial = 0; trial < test::effort(300); ++trial) {
    const double middle = random.uniform(-1.0, 1.0);
    const double width = random.uniform(0.0, 1.0 - std::abs(middle));
    const std::vector<PlacePolynomial> powers = powers_of_place(middle, width, 0.0, 7);
    REQUIRE(powers.size() == 7);
    const CosineSine wave{Ball(random.uniform(-3.0, 3.0)), Ball(0.2), Ball(0.1)};
    std::vector<PlacePolynomial> functions{wave.cosine, wave.sine};
    std::vector<double> factors{random.uniform(-2.0, 2.0), 0.0};
    for (const PlacePolynomial& power : powers) {
      functions.push_back(product_with_power(wave.sine, power));
      factors.push_back(random.below(3) == 0 ? 0.0 : random.uniform(-2.0, 2.0));
    }
    const BallPolynomial sum = linear_combination(factors, functions);
    for (int i = 0; i < 5; ++i) {
      const CellPlace place = random_cell_place(random);
      const Ball z = Ball(middle) + Ball(width) * Ball(place.z);
      Ball exact;
      for (std::size_t k = 0; k < functions.size(); ++k) {
        // Any function that the sine and the cosine stand for will do: their polynomials.
        Ball value;
        std::size_t at = 0;
        const PlacePolynomial& factor = k == 0 ? wave.cosine : wave.sine;
        for (int d = 0; d <= BallPolynomial::kMostDegree; ++d) {
          for (int m = 0; m <= d; ++m) {
            value += Ball(factor.coefficients[at++]) * whole_power(Ball(place.s), d - m) *
                     whole_power(Ball(place.z), m);
          }
        }
        if (k >= 2) {
          const auto power = static_cast<int>(k - 2);
          REQUIRE(covers_place(powers[k - 2], place, whole_power(z, power)));
          value = value * whole_power(z, power);
          REQUIRE(covers_place(functions[k], place, value));
        }
        exact += Ball(factors[k]) * value;
      }
      const Ball range = sum.range();
      REQUIRE_FALSE(certainly_less(range.upper(), exact));
      REQUIRE_FALSE(certainly_less(exact, range.lower()));
    }
  }
}

TEST_CASE("factors that are wrong by roundings") {
  // All of one sign, so that roundings add up.
  PlacePolynomial function;
  function.coefficients.fill(0.7);
  const double factor = 1.0 / 3.0;
  const Ball wrong = Ball(factor) * (one + Ball(static_cast<double>(kRoundingsOfFactor)) * Ball(kRounding));
  const BallPolynomial sum = linear_combination({factor, factor}, {function, function});
  // At s = z = 1.
  Ball exact;
  Ball value;
  for (std::size_t k = 0; k < function.coefficients.size(); ++k) {
    exact += two * wrong * Ball(function.coefficients[k]);
    value += Ball(sum.block(0, 0)[k]);
  }
  CHECK_FALSE(certainly_less(Ball(sum.error()), abs(value - exact)));
  CHECK(sum.error() < 1e-13);
}

TEST_CASE("what is not a number stays so") {
  PlacePolynomial nothing;
  nothing.error = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(linear_combination({1.0}, {nothing}).known());
  CHECK(linear_combination({0.0}, {nothing}).known());
  nothing.error = 0.0;
  nothing.coefficients[3] = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(linear_combination({1.0}, {nothing}).known());
  CHECK_FALSE(
      linear_combination({1.0}, {product_with_power(nothing, powers_of_place(0.5, 0.5, 0.0, 2)[1])}).known());
  CHECK_FALSE(linear_combination({std::numeric_limits<double>::quiet_NaN()}, {PlacePolynomial()}).known());
}

}  // namespace
}  // namespace veritrack::checker
