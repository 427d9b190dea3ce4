#include "analysis/rigor/taylor_model.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::TaylorModel;

/// The polynomial at a point, in long double: coefficient by coefficient, from the exponents.
template <int Variables, int Degree>
long double polynomial_at(const TaylorModel<Variables, Degree>& model,
                          const std::array<double, static_cast<std::size_t>(Variables)>& point) {
  using Model = TaylorModel<Variables, Degree>;
  long double sum = 0.0L;
  for (std::size_t i = 0; i < Model::kTerms; ++i) {
    long double term = model.coefficients()[i];
    for (std::size_t v = 0; v < static_cast<std::size_t>(Variables); ++v) {
      for (int e = 0; e < Model::Monomials::kExponents[i][v]; ++e) {
        term *= point[v];
      }
    }
    sum += term;
  }
  return sum;
}

/// An expression with everything in it, over any scalar.
struct Expression {
  std::array<double, 4> c;
  template <typename Scalar>
  Scalar operator()(const Scalar& x, const Scalar& y) const {
    using std::cos;
    using std::sin;
    const Scalar product = x * y * Scalar(c[0]) - y * y;
    Scalar sine = x;
    Scalar cosine = y;
    if constexpr (std::is_floating_point_v<Scalar>) {
      sine = sin(product + x);
      cosine = cos(product + x);
    } else {
      const auto both = sin_cos(product + x);
      sine = both.first;
      cosine = both.second;
    }
    const Scalar divisor = Scalar(3.0) + sine * Scalar(c[1]) + x * x * y;
    return (cosine * y + Scalar(c[2])) / divisor - (-sine) * (x + Scalar(c[3]));
  }
};

template <int Degree>
void check_containment(int expressions, double width) {
  test::Random random(1000 + Degree);
  double largest_share = 0.0;
  for (int n = 0; n < expressions; ++n) {
    const Expression f{
        {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}};
    const double x0 = random.uniform(-1.0, 1.0);
    const double y0 = random.uniform(-1.0, 1.0);
    const double w = width * random.uniform();
    using Model = TaylorModel<2, Degree>;
    Model result;
    Interval range;
    double x_center = 0.0;
    double x_radius = 0.0;
    double y_center = 0.0;
    double y_radius = 0.0;
    {
      const rigor::UpwardRounding upward;
      const Model x = Model::variable(Interval::from_bounds(x0 - w, x0 + w), 0);
      const Model y = Model::variable(Interval::from_bounds(y0 - w, y0 + w), 1);
      x_center = x.constant();
      x_radius = x.linear(0);
      y_center = y.constant();
      y_radius = y.linear(1);
      result = f(x, y);
      range = result.range();
    }
    REQUIRE(std::isfinite(result.remainder()));
    for (int k = 0; k < 20; ++k) {
      std::array<double, 2> point{random.uniform(-1, 1), random.uniform(-1, 1)};
      if (k < 4) {
        point = {k % 2 == 0 ? -1.0 : 1.0, k < 2 ? -1.0 : 1.0};
      }
      const long double x =
          static_cast<long double>(x_center) + static_cast<long double>(x_radius) * point[0];
      const long double y =
          static_cast<long double>(y_center) + static_cast<long double>(y_radius) * point[1];
      const long double truth = f(x, y);
      const long double error = std::fabs(truth - polynomial_at(result, point));
      CHECK(error <= static_cast<long double>(result.remainder()) + 1e-17L);
      CHECK(truth >= static_cast<long double>(range.lower()) - 1e-17L);
      CHECK(truth <= static_cast<long double>(range.upper()) + 1e-17L);
      largest_share = std::max(largest_share, static_cast<double>(error) / result.remainder());
    }
  }
  // The bound is a bound and not a formality: somewhere a fair part of it is needed.
  CHECK(largest_share > 1e-4);
}

TEST_CASE("a Taylor model holds the function, at random points and corners") {
  const int count = static_cast<int>(test::effort(500));
  check_containment<2>(count, 0.1);
  check_containment<4>(count, 0.1);
  check_containment<7>(count, 0.05);
  check_containment<2>(count, 1e-7);
}

TEST_CASE("the error falls with the width to the power of degree + 1") {
  const rigor::UpwardRounding upward;
  const auto remainder = [](double width) {
    using Model = TaylorModel<2, 3>;
    const Model x = Model::variable(Interval::from_bounds(0.5 - width, 0.5 + width), 0);
    const Model y = Model::variable(Interval::from_bounds(0.25 - width, 0.25 + width), 1);
    return Expression{{0.5, 0.25, 0.125, 0.75}}(x, y).remainder();
  };
  const double ratio = remainder(0.04) / remainder(0.02);
  CHECK(ratio > 14.0);
  CHECK(ratio < 20.0);
}

TEST_CASE("intervals enter as constants of unknown value") {
  test::Random random(7);
  using Model = TaylorModel<1, 3>;
  for (int n = 0; n < 1000; ++n) {
    const double low = random.uniform(0.5, 1.0);
    const double high = low + random.uniform(0.0, 0.1);
    const double c = random.uniform(low, high);
    Interval range;
    {
      const rigor::UpwardRounding upward;
      const Model x = Model::variable(Interval::from_bounds(-0.1, 0.1), 0);
      range = ((x + Model(Interval::from_bounds(low, high))) /
               (Model(2.0) - x * Model(Interval::from_bounds(low, high))))
                  .range();
    }
    const double x = random.uniform(-0.1, 0.1);
    CHECK(contains(range, (x + c) / (2.0 - x * c)));
  }
}

TEST_CASE("three variables: the monomials of a product stand where they belong") {
  const rigor::UpwardRounding upward;
  using Model = TaylorModel<3, 4>;
  test::Random random(8);
  const Interval unit = rigor::symmetric(1.0);
  const Model x = Model::variable(unit, 0);
  const Model y = Model::variable(unit, 1);
  const Model z = Model::variable(unit, 2);
  const Model product = (x * x * y - z) * (y + z * Model(2.0)) + x * z;
  for (int n = 0; n < 100; ++n) {
    const std::array<double, 3> p{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const double truth = (p[0] * p[0] * p[1] - p[2]) * (p[1] + 2.0 * p[2]) + p[0] * p[2];
    CHECK(std::fabs(static_cast<double>(polynomial_at(product, p)) - truth) < 1e-12);
  }
  CHECK(product.remainder() < 1e-11);
}

TEST_CASE("lower degree and more width hold the same functions and more") {
  const rigor::UpwardRounding upward;
  using Model = TaylorModel<2, 5>;
  const Model x = Model::variable(Interval::from_bounds(0.3, 0.5), 0);
  const Model y = Model::variable(Interval::from_bounds(-0.2, 0.1), 1);
  const Model full = Expression{{0.5, 0.25, 0.125, 0.75}}(x, y);
  const auto low = full.lowered<2>();
  const auto wide = low.widened(0.5);
  test::Random random(9);
  for (int n = 0; n < 200; ++n) {
    const std::array<double, 2> p{random.uniform(-1, 1), random.uniform(-1, 1)};
    const double distance = static_cast<double>(std::fabs(polynomial_at(full, p) - polynomial_at(low, p)));
    CHECK(distance + full.remainder() <= low.remainder() * (1.0 + 1e-9));
  }
  CHECK(low.remainder() < 0.01);
  CHECK(wide.remainder() >= low.remainder() + 0.5);
}

TEST_CASE("what cannot be bounded is unknown, and stays unknown") {
  const rigor::UpwardRounding upward;
  using Model = TaylorModel<2, 3>;
  const Model x = Model::variable(Interval::from_bounds(-0.1, 0.2), 0);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Model& unknown :
       {Model(1.0) / x, Model(), Model(Interval::empty()), Model(Interval::entire()),
        Model(std::numeric_limits<double>::quiet_NaN()) * Model(0.0),
        Model(1e300) * Model(1e300) * Model(0.0), Model(infinity) - Model(infinity), Model(infinity),
        Model::variable(Interval::entire(), 1), sin_cos(Model(infinity)).first,
        sin_cos(Model(1.0) / x).second, reciprocal(Model(0.0))}) {
    CHECK_FALSE(is_finite(unknown.range()));
    CHECK_FALSE(is_finite((unknown * x + x).range()));
    CHECK_FALSE(is_finite((Model(0.0) * unknown).range()));
    CHECK_FALSE(is_finite((x / (unknown + Model(3.0))).range()));
    CHECK_FALSE(is_finite(sin_cos(unknown).first.range()));
  }
}

}  // namespace
