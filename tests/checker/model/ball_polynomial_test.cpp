// Ball polynomials against Arb at random points: every operation, every function, and random expressions.
#include "checker/model/ball_polynomial.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "checker/model/formula.hpp"
#include "checker/numbers/budget.hpp"
#include "tests/support/random.hpp"

namespace veritrack::checker {
namespace {

/// A place in both balls and in the cell.
struct Place {
  std::vector<double> vectors;
  double s = 0.0;
  double z = 0.0;
};

/// In [-1, 1], often at an end.
double coordinate(test::Random& random) {
  const std::uint64_t which = random.below(4);
  return which == 0 ? 1.0 : which == 1 ? -1.0 : random.uniform(-1.0, 1.0);
}

Place random_place(test::Random& random, std::size_t balls, std::size_t disturbances) {
  Place place{{}, coordinate(random), coordinate(random)};
  for (const std::size_t size : {balls, disturbances}) {
    std::vector<double> vector(size);
    double square = 1e-300;
    for (double& component : vector) {
      component = random.uniform(-1.0, 1.0);
      square += component * component;
    }
    const double length = (random.below(3) == 0 ? random.uniform() : 1.0 - 1e-15) / std::sqrt(square);
    for (const double component : vector) {
      place.vectors.push_back(component * length);
    }
  }
  return place;
}

/// s^l z^m in the order of the coefficients, times the factor, times the coefficients, added up.
Ball sum_of_block(std::span<const double> block, const Place& place) {
  Ball sum;
  std::size_t at = 0;
  for (int d = 0; at < block.size(); ++d) {
    for (int m = 0; m <= d; ++m) {
      sum += Ball(block[at++]) * whole_power(Ball(place.s), d - m) * whole_power(Ball(place.z), m);
    }
  }
  return sum;
}

/// The polynomial there, from its coefficients.
Ball value_at(const BallPolynomial& x, const Place& place) {
  if (x.vector_degree() < 0) {
    return zero;
  }
  Ball sum = sum_of_block(x.block(0, 0), place);
  const auto at = [&](std::size_t i) { return Ball(place.vectors.at(i)); };
  const std::size_t n = x.vector_degree() > 0 ? x.monomials()->variables() : 0;
  for (std::size_t i = 0; i < n; ++i) {
    sum += sum_of_block(x.block(1, i), place) * at(i);
    for (std::size_t j = i; j < n && x.vector_degree() > 1; ++j) {
      const std::size_t pair = x.monomials()->pair(i, j);
      sum += sum_of_block(x.block(2, pair), place) * at(i) * at(j);
      for (std::size_t k = j; k < n && x.vector_degree() > 2; ++k) {
        sum += sum_of_block(x.block(3, x.monomials()->triple(k, pair)), place) * at(i) * at(j) * at(k);
      }
    }
  }
  return sum;
}

/// Whether the function with this value there may be one of those that x stands for.
bool covers(const BallPolynomial& x, const Place& place, const Ball& exact) {
  if (!x.known()) {
    return true;
  }
  const Ball value = value_at(x, place);
  const Ball range = x.range();
  return !certainly_less(Ball(x.error()), abs(value - exact)) &&
         !certainly_less(Ball(x.norm()), abs(value)) && !certainly_less(range.upper(), exact) &&
         !certainly_less(exact, range.lower());
}

/// A function, as ball polynomials and as balls at some places.
struct Function {
  BallPolynomial polynomial;
  std::vector<Ball> values;
};

class Functions {
 public:
  Functions(test::Random& random, std::size_t balls, std::size_t disturbances)
      : random_(&random), monomials_(balls, disturbances) {
    for (int i = 0; i < 8; ++i) {
      places_.push_back(random_place(random, balls, disturbances));
    }
  }

  /// middle, and affine in everything up to a size.
  Function leaf(double middle, double size) {
    Function result{BallPolynomial(middle), std::vector<Ball>(places_.size(), Ball(middle))};
    const auto add = [&](const BallPolynomial& variable, const auto& coordinate_of) {
      const double factor = size * random_->uniform(-1.0, 1.0);
      result.polynomial.add(variable, factor);
      for (std::size_t p = 0; p < places_.size(); ++p) {
        result.values[p] += Ball(factor) * Ball(coordinate_of(places_[p]));
      }
    };
    for (std::size_t i = 0; i < monomials_.variables(); ++i) {
      if (random_->below(3) != 0) {
        add(BallPolynomial::variable(monomials_, i), [i](const Place& place) { return place.vectors[i]; });
      }
    }
    add(BallPolynomial::phase(), [](const Place& place) { return place.s; });
    add(BallPolynomial::frequency(), [](const Place& place) { return place.z; });
    if (random_->below(2) == 0) {
      result.polynomial.widen(1e-9);
    }
    return result;
  }

  template <typename Operation>
  [[nodiscard]] Function combined(const Function& x, const Function& y, const Operation& operation) const {
    Function result{operation(x.polynomial, y.polynomial), {}};
    for (std::size_t p = 0; p < places_.size(); ++p) {
      result.values.push_back(operation(x.values[p], y.values[p]));
    }
    return result;
  }
  template <typename Operation>
  [[nodiscard]] Function of(const Function& x, const Operation& operation) const {
    return combined(x, x, [&](const auto& argument, const auto& /*same*/) { return operation(argument); });
  }

  [[nodiscard]] bool cover(const Function& f) const {
    bool all = true;
    for (std::size_t p = 0; p < places_.size(); ++p) {
      all = all && covers(f.polynomial, places_[p], f.values[p]);
    }
    return all;
  }

 private:
  test::Random* random_;
  VectorMonomials monomials_;
  std::vector<Place> places_;
};

TEST_CASE("sums and products contain what they stand for, and little more") {
  test::Random random(81);
  for (std::int64_t trial = 0; trial < test::effort(400); ++trial) {
    Functions functions(random, 1 + random.below(5), random.below(3));
    const double size = std::pow(10.0, random.uniform(-4.0, 0.0));
    const Function x = functions.leaf(random.uniform(-2.0, 2.0), size);
    const Function y = functions.leaf(random.uniform(-2.0, 2.0), size);
    REQUIRE(functions.cover(x));
    const auto product = [](const auto& a, const auto& b) { return a * b; };
    const auto sum = [](const auto& a, const auto& b) { return a + b; };
    const auto difference = [](const auto& a, const auto& b) { return a - b; };
    REQUIRE(functions.cover(functions.combined(x, y, sum)));
    REQUIRE(functions.cover(functions.combined(x, y, difference)));
    const Function square = functions.combined(x, y, product);
    REQUIRE(functions.cover(square));
    // Of degree two: nothing is cut off.
    CHECK(square.polynomial.error() < 1e-7);
    const Function fourth = functions.combined(square, square, product);
    REQUIRE(functions.cover(fourth));
    CHECK(fourth.polynomial.known());
    REQUIRE(functions.cover(functions.combined(fourth, square, product)));
    REQUIRE(functions.cover(functions.combined(fourth, x, difference)));
  }
}

TEST_CASE("every function contains its values, or says that nothing is known") {
  test::Random random(82);
  const auto check = [&](double low, double high, const auto& function) {
    int known = 0;
    for (std::int64_t trial = 0; trial < test::effort(200); ++trial) {
      Functions functions(random, 1 + random.below(4), random.below(2));
      const double size = std::pow(10.0, random.uniform(-5.0, 0.0));
      const Function x = functions.leaf(random.uniform(low, high), size);
      const Function value = functions.of(x, function);
      REQUIRE(functions.cover(value));
      known += value.polynomial.known() ? 1 : 0;
    }
    CHECK(known > 0);
  };
  check(-3.0, 3.0, [](const auto& x) { return reciprocal(x); });
  check(0.0, 5.0, [](const auto& x) { return sqrt(x); });
  check(-3.0, 3.0, [](const auto& x) { return exp(x); });
  check(0.0, 5.0, [](const auto& x) { return log(x); });
  check(-9.0, 9.0, [](const auto& x) { return sin(x); });
  check(-9.0, 9.0, [](const auto& x) { return cos(x); });
  check(-9.0, 9.0, [](const auto& x) { return tangent(x); });
  check(-1.1, 1.1, [](const auto& x) { return arcsine(x); });
  check(-1.1, 1.1, [](const auto& x) { return arccosine(x); });
  check(-4.0, 4.0, [](const auto& x) { return arctangent(x); });
}

TEST_CASE("the angle of a point") {
  test::Random random(83);
  int known = 0;
  for (std::int64_t trial = 0; trial < test::effort(4000); ++trial) {
    Functions functions(random, 2, 1);
    const double size = std::pow(10.0, random.uniform(-3.0, 0.0));
    const double scale = std::pow(10.0, random.uniform(-6.0, 6.0));
    const Function y = functions.leaf(scale * random.uniform(-1.0, 1.0), scale * size);
    const Function x = functions.leaf(scale * random.uniform(-1.0, 1.0), scale * size);
    const Function angle =
        functions.combined(y, x, [](const auto& a, const auto& b) { return arctangent2(a, b); });
    REQUIRE(functions.cover(angle));
    known += angle.polynomial.known() ? 1 : 0;
  }
  CHECK(known > 0);
  const BallPolynomial s = BallPolynomial::phase();
  CHECK_FALSE(arctangent2(s, BallPolynomial(-1.0)).known());
  CHECK_FALSE(arctangent2(BallPolynomial(), BallPolynomial(-1.0)).known());
  CHECK_FALSE(arctangent2(BallPolynomial(), BallPolynomial()).known());
  CHECK_FALSE(arctangent2(BallPolynomial(0.5) * s, s).known());
  CHECK_FALSE(arctangent2(BallPolynomial::everything(), BallPolynomial(1.0)).known());
  CHECK_FALSE(arctangent2(BallPolynomial(1.0), BallPolynomial::everything()).known());
  CHECK(arctangent2(s, BallPolynomial(1.5)).known());
  // In a half plane, but further back from its middle than the middle is from the origin.
  CHECK(arctangent2(BallPolynomial(1.0), BallPolynomial(10.0) + 10.0 * s).known());
  CHECK_FALSE(arctangent2(BallPolynomial(1.0), BallPolynomial(10.0) + 11.0 * s).known());
  BallPolynomial unknown(1.0);
  unknown.widen(6.0);
  CHECK_FALSE(arctangent2(BallPolynomial(1.0), unknown).known());
  // Of a wide range: x - x^3/3 and at most x^5/5, where the series over the range is far wider.
  CHECK(certainly_less(arctangent(BallPolynomial(0.9) * s).range(), Ball(1.3)));
}

TEST_CASE("the angle of a point that turns is about as exact in every direction") {
  test::Random random(88);
  const VectorMonomials monomials(1, 0);
  const BallPolynomial x = BallPolynomial::variable(monomials, 0);
  for (std::int64_t trial = 0; trial < test::effort(300); ++trial) {
    // Not next to the cut.
    const double middle = random.uniform(-2.5, 2.5);
    const double size = random.uniform(0.01, 0.4);
    const BallPolynomial turned = BallPolynomial(middle) + size * x;
    const double length = std::pow(10.0, random.uniform(-3.0, 3.0));
    const BallPolynomial angle = arctangent2(length * sin(turned), length * cos(turned));
    REQUIRE(angle.known());
    CHECK(std::abs(angle.constant() - middle) < 1e-14);
    CHECK((angle - turned).norm() + angle.error() < 0.08 * std::pow(size, 4.0) + std::pow(size, 5.0) + 1e-13);
  }
}

TEST_CASE("the angle of a point whose length changes, and hardly its direction") {
  const BallPolynomial angle =
      arctangent2(1e-6 * BallPolynomial::phase(), BallPolynomial(1.0) + 0.4 * BallPolynomial::frequency());
  // 1e-6 s (1 - 0.4 z + ...), the rest of the geometric series: 1e-6 0.4^4/(1 - 0.4).
  CHECK(angle.error() < 1e-6 * (2.0 * std::pow(0.4, 4.0) / 0.6));
}

TEST_CASE("remainders over wide ranges are those of the fifth derivative where it is largest") {
  const BallPolynomial s = BallPolynomial::phase();
  const auto remainder = [](const BallPolynomial& value) { return value.error() * (1.0 - 1e-7); };
  const double x = 0.6;
  const double square = x * x;
  CHECK(remainder(arccosine(x * s)) <= (9.0 + 72.0 * square + 24.0 * square * square) /
                                           std::pow(1.0 - square, 4.5) / 120.0 * std::pow(x, 5.0));
  CHECK(remainder(arcsine(x * s)) <= (9.0 + 72.0 * square + 24.0 * square * square) /
                                         std::pow(1.0 - square, 4.5) / 120.0 * std::pow(x, 5.0));
  CHECK(remainder(exp(x * s)) <= std::exp(x) / 120.0 * std::pow(x, 5.0));
  CHECK(remainder(log(BallPolynomial(1.0) + x * s)) <= std::pow(1.0 - x, -5.0) / 5.0 * std::pow(x, 5.0));
  CHECK(remainder(sqrt(BallPolynomial(1.0) + x * s)) <=
        7.0 / 256.0 * std::pow(1.0 - x, -4.5) * std::pow(x, 5.0));
}

TEST_CASE("random expressions") {
  test::Random random(84);
  for (std::int64_t trial = 0; trial < test::effort(300); ++trial) {
    Functions functions(random, 1 + random.below(9), random.below(3));
    const double size = std::pow(10.0, random.uniform(-3.0, -0.5));
    std::vector<Function> made;
    made.reserve(16);
    for (int i = 0; i < 4; ++i) {
      made.push_back(functions.leaf(random.uniform(-2.0, 2.0), size));
    }
    for (int i = 0; i < 12; ++i) {
      const Function x = made[random.below(made.size())];
      const Function y = made[random.below(made.size())];
      const std::uint64_t which = random.below(10);
      made.push_back(
          which < 2   ? functions.combined(x, y, [](const auto& a, const auto& b) { return a + b; })
          : which < 4 ? functions.combined(x, y, [](const auto& a, const auto& b) { return a - b; })
          : which < 7 ? functions.combined(x, y, [](const auto& a, const auto& b) { return a * b; })
          : which < 8 ? functions.combined(x, y, [](const auto& a, const auto& b) { return a / b; })
          : which < 9 ? functions.of(x, [](const auto& a) { return sin(a); })
                      : functions.of(x, [](const auto& a) { return arctangent(a); }));
      REQUIRE(functions.cover(made.back()));
    }
  }
}

TEST_CASE("nothing is known of what is not defined, and it stays unknown") {
  const BallPolynomial s = BallPolynomial::phase();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const BallPolynomial& nothing : {reciprocal(s),
                                        sqrt(s),
                                        log(s),
                                        arcsine(s),
                                        arccosine(s),
                                        tangent(BallPolynomial(2.0) * s),
                                        BallPolynomial(nan),
                                        BallPolynomial(infinity),
                                        BallPolynomial(Ball::everything()),
                                        BallPolynomial::affine(0.0, nan, 0.0, 0.0),
                                        BallPolynomial::affine(0.0, 0.0, 0.0, nan),
                                        BallPolynomial::affine(0.0, 0.0, infinity, 0.0),
                                        BallPolynomial::affine(0.0, 0.0, 0.0, -1.0),
                                        exp(BallPolynomial(1e6)) * s,
                                        exp(BallPolynomial(700.0) * s) * exp(BallPolynomial(700.0)),
                                        stays_within(s, BallPolynomial(-1.0), BallPolynomial(2.0)),
                                        stays_within(s, BallPolynomial(-2.0), BallPolynomial(1.0)),
                                        stays_within(s, BallPolynomial(nan), BallPolynomial(2.0)),
                                        nan * s,
                                        infinity * s,
                                        1e300 * s * (1e300 * s),
                                        BallPolynomial().widen(nan),
                                        BallPolynomial().widen(infinity)}) {
    CHECK_FALSE(nothing.known());
    CHECK_FALSE(nothing.range().finite());
    for (const BallPolynomial& also :
         {nothing + s, s - nothing, nothing * s, s * nothing, nothing * BallPolynomial(),
          BallPolynomial() * nothing, nothing - nothing, 0.0 * nothing, reciprocal(nothing), sin(nothing),
          nothing.mean_over_phase(), stays_within(nothing, BallPolynomial(-1.0), s)}) {
      CHECK_FALSE(also.known());
    }
  }
  CHECK(stays_within(s, BallPolynomial(-1.1), BallPolynomial(1.1)).known());
}

TEST_CASE("the mean over s") {
  const VectorMonomials monomials(2, 0);
  const BallPolynomial s = BallPolynomial::phase();
  const BallPolynomial z = BallPolynomial::frequency();
  const BallPolynomial x = BallPolynomial::variable(monomials, 0);
  const BallPolynomial mean =
      (whole_power(BallPolynomial(1.0) + s, 4) + s * z + s * s * z + z * z * z + 0.25 * x).mean_over_phase();
  // 16/5 + z/3 + z^3, and whatever x is.
  CHECK(mean.vector_degree() == 0);
  CHECK(mean.error() == doctest::Approx(0.25));
  const auto mean_at = [&](double place) { return value_at(mean, {{}, 0.3, place}).near(); };
  CHECK(mean_at(0.0) == doctest::Approx(3.2));
  CHECK(mean_at(0.5) == doctest::Approx(3.2 + 0.5 / 3.0 + 0.125));
  CHECK(mean_at(-1.0) == doctest::Approx(3.2 - 1.0 / 3.0 - 1.0));
  CHECK(certainly_equal(BallPolynomial(2.0).mean_over_phase().range().middle(), two));
}

TEST_CASE("norms are Bombieri's: a length and its square") {
  const VectorMonomials monomials(3, 1);
  BallPolynomial square;
  for (std::size_t i = 0; i < 3; ++i) {
    const BallPolynomial x = BallPolynomial::variable(monomials, i);
    square += x * x;
  }
  CHECK(square.norm(2, 0) == doctest::Approx(std::sqrt(3.0)));
  const BallPolynomial direction =
      0.6 * BallPolynomial::variable(monomials, 0) + 0.8 * BallPolynomial::variable(monomials, 2);
  CHECK((direction * direction * direction).norm(3, 0) == doctest::Approx(1.0));
  const BallPolynomial v = BallPolynomial::variable(monomials, 3);
  CHECK((direction * v * direction).norm(3, 0) == doctest::Approx(1.0));
  CHECK((direction * v * BallPolynomial::phase()).norm(2, 1) == doctest::Approx(1.0));
  CHECK((direction * direction * v * v).vector_degree() <= 3);
  CHECK((direction * direction * v * v).error() == doctest::Approx(1.0));
}

TEST_CASE("work is counted") {
  const VectorMonomials monomials(6, 0);
  BallPolynomial x(1.0);
  for (std::size_t i = 0; i < 6; ++i) {
    x += BallPolynomial::variable(monomials, i);
  }
  set_budget(1000);
  CHECK_THROWS_AS(
      [&] {
        for (int i = 0; i < 1000; ++i) {
          x = BallPolynomial(0.1) * x * x;
        }
      }(),
      OutOfBudget);
  set_budget(kDefaultBudget);
  CHECK_THROWS_AS((void)VectorMonomials(0, 0), std::invalid_argument);
  CHECK_THROWS_AS((void)VectorMonomials(100, 0), std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::checker
