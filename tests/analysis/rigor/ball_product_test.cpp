// Products, sums, copies and norms of ball models.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "analysis/rigor/ball_model.hpp"
#include "tests/analysis/rigor/ball_points.hpp"
#include "tests/support/random.hpp"

using namespace veritrack;
using rigor::BallModel;
using rigor::BallModelScope;
using rigor::Interval;
using test::BallPoint;
using test::effort;
using test::polynomial_at;
using test::random_point;

namespace {

/// A model whose coefficients are random, of many sizes, some of them zero.
BallModel random_model(test::Random& random, int balls, int disturbances) {
  std::vector<BallModel> factors{BallModel::s(), BallModel::z(), BallModel(1.0)};
  for (int i = 0; i < balls; ++i) {
    factors.push_back(BallModel::ball(i));
  }
  for (int i = 0; i < disturbances; ++i) {
    factors.push_back(BallModel::disturbance(i));
  }
  BallModel sum;
  for (int term = 0; term < 12; ++term) {
    BallModel product(1.0);
    for (int k = 0; k < 3; ++k) {
      product = product * factors[random.below(factors.size())];
    }
    sum.add_multiple(product, random.uniform(-1.0, 1.0) * std::pow(10.0, random.uniform(-8.0, 1.0)));
  }
  return sum;
}

/// Of a product, from its definition: the classes of which it drops the product, norm by norm.
long double dropped_from(const BallModel& a, const BallModel& b) {
  const auto& classes = a.monomials().classes();
  long double sum = 0;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    for (std::size_t j = 0; j < classes.size(); ++j) {
      const int vectors = classes[i].ball + classes[j].ball + classes[i].disturbance + classes[j].disturbance;
      const int all = vectors + classes[i].s + classes[j].s + classes[i].z + classes[j].z;
      if (vectors > 3 || all > 4) {
        sum += static_cast<long double>(a.norm(i)) * static_cast<long double>(b.norm(j));
      }
    }
  }
  return sum;
}

/// Of a class, in higher precision and from the exponents: Bombieri's norm.
long double norm_of(const BallModel& model, const rigor::BallMonomials::Class& here) {
  long double sum = 0;
  for (std::size_t i = here.first; i < here.last; ++i) {
    const auto c = static_cast<long double>(model.coefficients()[i]);
    sum += c * c * static_cast<long double>(model.monomials().weights()[i]);
  }
  return std::sqrt(sum);
}

TEST_CASE("the error of a product is at least what it drops, and norms at least those of the coefficients") {
  test::Random random(63);
  for (std::int64_t round = effort(400); round > 0; --round) {
    const int balls = static_cast<int>(random.below(4));
    const int disturbances = static_cast<int>(random.below(3));
    const BallModelScope scope(balls, disturbances);
    const BallModel a = random_model(random, balls, disturbances);
    const BallModel b = random_model(random, balls, disturbances);
    const BallModel product = a * b;
    const long double dropped = dropped_from(a, b);
    CHECK(static_cast<long double>(product.error()) >= dropped);
    CHECK(static_cast<long double>(product.error()) <= dropped * (1 + 1e-12L) + 1e-8L);
    BallModel sum = product;
    sum += a;
    sum -= b;
    sum.add_multiple(a, -0.3);
    for (const BallModel& model : {a, b, product, sum}) {
      const auto& classes = model.monomials().classes();
      for (std::size_t number = 0; number < classes.size(); ++number) {
        const long double norm = norm_of(model, classes[number]);
        CHECK(static_cast<long double>(model.norm(number)) >= norm * (1 - 1e-18L));
        CHECK(static_cast<long double>(model.norm(number)) <= norm * (1 + 1e-14L) + 1e-300L);
      }
    }
    for (int sample = 0; sample < 5; ++sample) {
      const BallPoint point = random_point(random, balls, disturbances);
      const long double at_a = polynomial_at(a, point);
      const long double at_b = polynomial_at(b, point);
      CHECK(std::fabs(polynomial_at(product, point) - at_a * at_b) <=
            static_cast<long double>(product.error()) + 1e-17L);
      CHECK(std::fabs(polynomial_at(sum, point) -
                      (at_a * at_b + at_a - at_b - static_cast<long double>(0.3) * at_a)) <=
            static_cast<long double>(sum.error()) + 1e-15L);
    }
  }
}

TEST_CASE("models of the place alone are the same in a scope of their own, and lifted from it") {
  test::Random random(64);
  for (std::int64_t round = effort(200); round > 0; --round) {
    const auto in_plane = [&](auto make) {
      const BallModelScope plane(0, 0);
      return make();
    };
    const BallModel a = in_plane([&] { return random_model(random, 0, 0).widened(1e-3); });
    const BallModel b = in_plane([&] { return random_model(random, 0, 0); });
    const BallModel product = in_plane([&] { return a * b - b; });
    const BallModelScope scope(2, 1);
    const BallModel lifted = product.lifted();
    const BallModel again = a.lifted() * b.lifted() - b.lifted();
    CHECK(lifted.error() == product.error());
    CHECK(again.error() == doctest::Approx(product.error()).epsilon(1e-12));
    for (std::size_t i = 0; i < again.coefficients().size(); ++i) {
      CHECK(lifted.coefficients()[i] == again.coefficients()[i]);
    }
    for (std::size_t number = 0; number < again.monomials().classes().size(); ++number) {
      CHECK(lifted.norm(number) == again.norm(number));
    }
    const BallPoint point = random_point(random, 2, 1);
    CHECK(polynomial_at(lifted, point) == polynomial_at(product, {{}, {}, point.s, point.z}));
  }
  const BallModelScope scope(1, 0);
  const BallModel with_ball = BallModel::ball(0);
  const BallModelScope plane(0, 0);
  CHECK_THROWS_AS((void)with_ball.lifted(), std::logic_error);
  CHECK_THROWS_AS((void)(with_ball * BallModel::s()), std::logic_error);
  CHECK_THROWS_AS((void)(with_ball + BallModel::s()), std::logic_error);
}

TEST_CASE("of the place alone, too, nothing is known beyond the range of doubles") {
  const BallModelScope plane(0, 0);
  const auto unknown = [](const BallModel& model) {
    return !std::isfinite(model.deviation()) && is_empty(model.range());
  };
  const BallModel large = BallModel(1e200) * BallModel::s();
  CHECK_FALSE(unknown(large));
  CHECK(unknown(large * large));
  CHECK(unknown(large * large - large * large));
  CHECK(unknown(BallModel(Interval::empty()) * BallModel(0.0)));
  CHECK(unknown(BallModel::s() + BallModel(Interval::empty())));
  BallModel sum = BallModel::s();
  sum.add_multiple(BallModel(0.0), std::nan(""));
  CHECK(unknown(sum));
  // Terms whose products vanish stand in the error.
  const BallModel small = BallModel(1e-200) * BallModel::s();
  CHECK((small * small).error() > 0.0);
}

TEST_CASE("copies and moves of models of any number of terms") {
  for (const int balls : {0, 1, 3}) {
    const BallModelScope scope(balls, 0);
    const BallModel model = BallModel(2.0) * BallModel::s() + BallModel(3.0) * BallModel::z();
    const auto is_same = [&](const BallModel& other) {
      return std::equal(model.coefficients().begin(), model.coefficients().end(),
                        other.coefficients().begin()) &&
             other.deviation() == model.deviation();
    };
    BallModel copy = model;
    BallModel other(7.0);
    other = copy;
    CHECK(is_same(other));
    BallModel moved = std::move(copy);
    CHECK(is_same(moved));
    copy = moved;  // what was moved from takes a new value
    CHECK(is_same(copy));
    const BallModel* self = &copy;
    copy = *self;
    CHECK(is_same(copy));
    copy += copy;
    CHECK(copy.constant() == 0.0);
    CHECK(copy.range().upper() == doctest::Approx(2.0 * model.range().upper()));
    CHECK(is_same(model));
  }
  // From one size to another.
  const BallModelScope few(0, 0);
  BallModel model = BallModel::s();
  {
    const BallModelScope many(3, 0);
    model = BallModel::ball(1);
    CHECK(model.coefficients().size() == model.monomials().terms());
    CHECK(model.range().upper() == doctest::Approx(1.0));
  }
  model = BallModel::z();
  CHECK(model.coefficients().size() == 15);
  CHECK(model.range().upper() == doctest::Approx(1.0));
}

}  // namespace
