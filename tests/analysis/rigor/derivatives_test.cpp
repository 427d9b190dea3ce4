#include "analysis/rigor/derivatives.hpp"

#include <doctest/doctest.h>

#include <type_traits>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

using namespace veritrack::rigor;
using namespace veritrack::test;

namespace {

/// (x0^2 x1 + x2, x0 x1 x2, x2^3 - 2 x0): integer derivatives at integer points.
struct Polynomials {
  template <typename Derived>
  auto operator()(const Eigen::MatrixBase<Derived>& x) const {
    using Scalar = typename Derived::Scalar;
    Eigen::Matrix<Scalar, 3, 1> result;
    result << square(x[0]) * x[1] + x[2], x[0] * x[1] * x[2], pow(x[2], 3) - Scalar(2.0) * x[0];
    return result;
  }
};

/// (x, y) -> exp(x) sin(y), whose derivatives are the function again, shifted.
struct Wave {
  template <typename Derived>
  auto operator()(const Eigen::MatrixBase<Derived>& x) const {
    return exp(x[0]) * sin(x[1]);
  }
};

}  // namespace

TEST_CASE("linearization and Hessians of polynomials at integer points, exactly") {
  Random random(800);
  for (std::int64_t round = 0; round < effort(200); ++round) {
    Eigen::Vector3d x;
    for (Eigen::Index i = 0; i < 3; ++i) {
      x[i] = static_cast<double>(random.below(19)) - 9.0;
    }
    Eigen::Matrix3d jacobian_exact;
    jacobian_exact << 2 * x[0] * x[1], x[0] * x[0], 1, x[1] * x[2], x[0] * x[2], x[0] * x[1], -2, 0,
        3 * x[2] * x[2];
    const auto linear = linearize(Polynomials{}, x);
    static_assert(std::is_same_v<decltype(linear.jacobian), Eigen::Matrix3d>);
    CHECK(linear.value ==
          Eigen::Vector3d(x[0] * x[0] * x[1] + x[2], x[0] * x[1] * x[2], x[2] * x[2] * x[2] - 2 * x[0]));
    CHECK(linear.jacobian == jacobian_exact);
    CHECK(jacobian(Polynomials{}, x) == jacobian_exact);

    Eigen::Matrix3d first;
    first << 2 * x[1], 2 * x[0], 0, 2 * x[0], 0, 0, 0, 0, 0;
    Eigen::Matrix3d second;
    second << 0, x[2], x[1], x[2], 0, x[0], x[1], x[0], 0;
    Eigen::Matrix3d third = Eigen::Matrix3d::Zero();
    third(2, 2) = 6 * x[2];
    const auto bent = hessians(Polynomials{}, x);
    CHECK(bent[0] == first);
    CHECK(bent[1] == second);
    CHECK(bent[2] == third);

    const UpwardRounding upward;
    const auto enclosed =
        linearize(Polynomials{}, x.unaryExpr([](double entry) { return Interval(entry); }).eval());
    for (Eigen::Index i = 0; i < 9; ++i) {
      CHECK(identical(enclosed.jacobian(i), Interval(jacobian_exact(i))));
    }
  }
}

TEST_CASE("gradients, Hessians and third derivatives over boxes hold those at every point") {
  Random random(801);
  for (std::int64_t round = 0; round < effort(300); ++round) {
    const double x = random.uniform(-1.0, 1.0);
    const double y = random.uniform(-3.0, 3.0);
    const double reach = std::ldexp(1.0, -static_cast<int>(random.below(30)));
    const UpwardRounding upward;
    const auto around = [&](double center) {
      return Interval::from_bounds(center - reach * random.uniform(), center + reach * random.uniform());
    };
    const Eigen::Matrix<Interval, 2, 1> box(around(x), around(y));
    const auto slopes = gradient(Wave{}, box);
    const auto bent = hessian(Wave{}, box);
    const auto thrice = Wave{}(variables(variables(variables(box))));
    const auto holds = [](const Interval& enclosure, long double truth) {
      return static_cast<long double>(enclosure.lower()) <= truth + 1e-18L &&
             static_cast<long double>(enclosure.upper()) >= truth - 1e-18L;
    };
    const NearestRounding nearest;
    const long double sine = std::exp(static_cast<long double>(x)) * std::sin(static_cast<long double>(y));
    const long double cosine = std::exp(static_cast<long double>(x)) * std::cos(static_cast<long double>(y));
    CHECK(holds(slopes[0], sine));
    CHECK(holds(slopes[1], cosine));
    CHECK(holds(bent(0, 0), sine));
    CHECK(holds(bent(0, 1), cosine));
    CHECK(holds(bent(1, 0), cosine));
    CHECK(holds(bent(1, 1), -sine));
    CHECK(holds(thrice.derivative(0).derivative(0).derivative(1), cosine));
    CHECK(holds(thrice.derivative(1).derivative(0).derivative(1), -sine));
    CHECK(holds(thrice.derivative(1).derivative(1).derivative(1), -cosine));
  }
}

TEST_CASE("no derivatives where the function is undefined") {
  const UpwardRounding upward;
  const auto logarithm = [](const auto& x) { return log(x[0]); };
  const Eigen::Matrix<Interval, 1, 1> box(Interval::from_bounds(-1.0, 1.0));
  CHECK(is_empty(gradient(logarithm, box)[0]));
  CHECK(is_empty(hessian(logarithm, box)(0, 0)));
}
