#include "analysis/rigor/dual.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "analysis/rigor/derivatives.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

using namespace veritrack::rigor;
using namespace veritrack::test;

namespace {

/// A function with its first two derivatives as textbooks give them.
struct Textbook {
  std::string name;
  double lower, upper;  // where to sample
  std::function<long double(long double)> value, first, second;
  std::function<Dual<double, 2>(const Dual<double, 2>&)> on_double;
  std::function<Dual<Interval, 2>(const Dual<Interval, 2>&)> on_interval;
  std::function<Dual<Dual<Interval, 1>, 1>(const Dual<Dual<Interval, 1>, 1>&)> nested;
};

using Extended = long double;

template <typename Function>
Textbook textbook(std::string name, double lower, double upper, Function function,
                  std::function<Extended(Extended)> value, std::function<Extended(Extended)> first,
                  std::function<Extended(Extended)> second) {
  return {std::move(name),   lower,    upper,    std::move(value), std::move(first),
          std::move(second), function, function, function};
}

std::vector<Textbook> textbooks() {
  using E = Extended;
  return {
      textbook(
          "square", -3, 3, [](const auto& x) { return square(x); }, [](E x) { return x * x; },
          [](E x) { return 2 * x; }, [](E) { return 2.0L; }),
      textbook(
          "sqrt", 0.1, 9, [](const auto& x) { return sqrt(x); }, [](E x) { return std::sqrt(x); },
          [](E x) { return 0.5L / std::sqrt(x); }, [](E x) { return -0.25L / (x * std::sqrt(x)); }),
      textbook(
          "cube", -3, 3, [](const auto& x) { return pow(x, 3); }, [](E x) { return x * x * x; },
          [](E x) { return 3 * x * x; }, [](E x) { return 6 * x; }),
      textbook(
          "inverse square", 0.5, 3, [](const auto& x) { return pow(x, -2); }, [](E x) { return 1 / (x * x); },
          [](E x) { return -2 / (x * x * x); }, [](E x) { return 6 / (x * x * x * x); }),
      textbook(
          "zeroth power", -3, 3, [](const auto& x) { return pow(x, 0); }, [](E) { return 1.0L; },
          [](E) { return 0.0L; }, [](E) { return 0.0L; }),
      textbook(
          "first power", -3, 3, [](const auto& x) { return pow(x, 1); }, [](E x) { return x; },
          [](E) { return 1.0L; }, [](E) { return 0.0L; }),
      textbook(
          "sin", -9, 9, [](const auto& x) { return sin(x); }, [](E x) { return std::sin(x); },
          [](E x) { return std::cos(x); }, [](E x) { return -std::sin(x); }),
      textbook(
          "cos", -9, 9, [](const auto& x) { return cos(x); }, [](E x) { return std::cos(x); },
          [](E x) { return -std::sin(x); }, [](E x) { return -std::cos(x); }),
      textbook(
          "sin_cos, first", -9, 9, [](const auto& x) { return sin_cos(x).first; },
          [](E x) { return std::sin(x); }, [](E x) { return std::cos(x); }, [](E x) { return -std::sin(x); }),
      textbook(
          "sin_cos, second", -9, 9, [](const auto& x) { return sin_cos(x).second; },
          [](E x) { return std::cos(x); }, [](E x) { return -std::sin(x); },
          [](E x) { return -std::cos(x); }),
      textbook(
          "tan", -1.2, 1.2, [](const auto& x) { return tan(x); }, [](E x) { return std::tan(x); },
          [](E x) { return 1 / (std::cos(x) * std::cos(x)); },
          [](E x) { return 2 * std::sin(x) / (std::cos(x) * std::cos(x) * std::cos(x)); }),
      textbook(
          "atan", -9, 9, [](const auto& x) { return atan(x); }, [](E x) { return std::atan(x); },
          [](E x) { return 1 / (1 + x * x); }, [](E x) { return -2 * x / ((1 + x * x) * (1 + x * x)); }),
      textbook(
          "exp", -4, 4, [](const auto& x) { return exp(x); }, [](E x) { return std::exp(x); },
          [](E x) { return std::exp(x); }, [](E x) { return std::exp(x); }),
      textbook(
          "log", 0.1, 9, [](const auto& x) { return log(x); }, [](E x) { return std::log(x); },
          [](E x) { return 1 / x; }, [](E x) { return -1 / (x * x); }),
      textbook(
          "quotient", -3, 3,
          [](const auto& x) {
            using D = std::decay_t<decltype(x)>;
            return (x - D(2.0)) / (x * x + D(1.0));
          },
          [](E x) { return (x - 2) / (x * x + 1); },
          [](E x) { return (1 + 4 * x - x * x) / ((x * x + 1) * (x * x + 1)); },
          [](E x) {
            const E d = x * x + 1;
            return ((4 - 2 * x) * d - 4 * x * (1 + 4 * x - x * x)) / (d * d * d);
          }),
      textbook(
          "atan2(x, 2)", -9, 9, [](const auto& x) { return atan2(x, std::decay_t<decltype(x)>(2.0)); },
          [](E x) { return std::atan2(x, 2.0L); }, [](E x) { return 2 / (4 + x * x); },
          [](E x) { return -4 * x / ((4 + x * x) * (4 + x * x)); }),
      textbook(
          "atan2(1, x)", -9, 9, [](const auto& x) { return atan2(std::decay_t<decltype(x)>(1.0), x); },
          [](E x) { return std::atan2(1.0L, x); }, [](E x) { return -1 / (1 + x * x); },
          [](E x) { return 2 * x / ((1 + x * x) * (1 + x * x)); }),
  };
}

/// Does the enclosure hold a number known to a few units of extended precision?
bool holds(const Interval& enclosure, Extended truth) {
  const Extended margin = 1e-17L * (1 + std::fabs(truth));
  return static_cast<Extended>(enclosure.lower()) <= truth + margin &&
         static_cast<Extended>(enclosure.upper()) >= truth - margin;
}

bool close(double value, Extended truth) {
  return std::fabs(value - truth) <= 1e-14L * (1 + std::fabs(truth));
}

}  // namespace

TEST_CASE("chain rules: textbook derivatives on doubles, central differences, and enclosures") {
  Random random(700);
  for (const Textbook& entry : textbooks()) {
    CAPTURE(entry.name);
    for (std::int64_t round = 0; round < effort(500); ++round) {
      const double at = random.uniform(entry.lower, entry.upper);
      CAPTURE(at);
      const double slope = random.uniform(-2.0, 2.0);
      const Dual<double, 2> y = entry.on_double(Dual<double, 2>(at, {slope, 1.0}));
      CHECK(close(y.value(), entry.value(at)));
      CHECK(close(y.derivative(0), slope * entry.first(at)));
      CHECK(close(y.derivative(1), entry.first(at)));
      const Extended step = 1e-5L;
      const Extended difference = (entry.value(at + step) - entry.value(at - step)) / (2 * step);
      CHECK(std::fabs(y.derivative(1) - difference) < 1e-5L * (1 + std::fabs(difference)));

      const UpwardRounding upward;
      const Interval point(at);
      const Dual<Interval, 2> tight =
          entry.on_interval(Dual<Interval, 2>(point, {Interval(slope), Interval(1.0)}));
      CHECK(holds(tight.value(), entry.value(at)));
      CHECK(holds(tight.derivative(0), slope * entry.first(at)));
      CHECK(holds(tight.derivative(1), entry.first(at)));
      CHECK(width(tight.derivative(1)) <= 1e-14 * (1 + magnitude(tight.derivative(1))));
      // A box: its derivatives hold those at every point.
      const double reach = std::ldexp(1.0, -static_cast<int>(random.below(20) + 5));
      const Interval box = Interval::from_bounds(at - reach, at + reach);
      using Once = Dual<Interval, 1>;
      const auto twice =
          entry.nested(Dual<Once, 1>(Once(box, {Interval(1.0)}), {Once(Interval(1.0), {Interval(0.0)})}));
      const double inside = random.uniform(box.lower(), box.upper());
      CHECK(holds(twice.value().value(), entry.value(inside)));
      CHECK(holds(twice.value().derivative(0), entry.first(inside)));
      CHECK(holds(twice.derivative(0).value(), entry.first(inside)));
      CHECK(holds(twice.derivative(0).derivative(0), entry.second(inside)));
      const auto twice_at =
          entry.nested(Dual<Once, 1>(Once(point, {Interval(1.0)}), {Once(Interval(1.0), {Interval(0.0)})}));
      CHECK(width(twice_at.derivative(0).derivative(0)) <=
            1e-13 * (1 + magnitude(twice_at.derivative(0).derivative(0))));
    }
  }
}

TEST_CASE("operators against exact derivatives of polynomials with integer data") {
  Random random(701);
  using D = Dual<double, 2>;
  const auto integer = [&] { return static_cast<double>(random.below(21)) - 10.0; };
  for (std::int64_t round = 0; round < effort(500); ++round) {
    const double x = integer();
    const double y = integer();
    const double c = integer();
    const D dx = variable<2>(x, 0);
    const D dy = variable<2>(y, 1);
    const auto equals = [](const D& f, double value, double in_x, double in_y) {
      return f.value() == value && f.derivative(0) == in_x && f.derivative(1) == in_y;
    };
    CHECK(equals(dx + dy, x + y, 1, 1));
    CHECK(equals(dx - dy, x - y, 1, -1));
    CHECK(equals(dx * dy, x * y, y, x));
    CHECK(equals(-dx, -x, -1, 0));
    CHECK(equals(dx * dx * dy - dy * dy, x * x * y - y * y, 2 * x * y, x * x - 2 * y));
    CHECK(equals(dx + c, x + c, 1, 0));
    CHECK(equals(c + dx, x + c, 1, 0));
    CHECK(equals(dx - c, x - c, 1, 0));
    CHECK(equals(c - dx, c - x, -1, 0));
    CHECK(equals(c * dx, c * x, c, 0));
    CHECK(equals(dx * c, c * x, c, 0));
    CHECK(equals(dx / 4.0, x / 4, 0.25, 0));
    CHECK(equals(D(c), c, 0, 0));
    CHECK(equals(D(7), 7, 0, 0));
    const double power = y >= 0 ? 4.0 : 0.5;
    CHECK(equals(dx / D(power), x / power, 1 / power, 0));
    const D quotient = c / variable<2>(power, 1);
    CHECK(equals(quotient, c / power, 0, -c / (power * power)));
    D sum = dx;
    sum += dy;
    sum *= dx;
    sum -= D(1.0);
    CHECK(equals(sum, (x + y) * x - 1, 2 * x + y, x));
    D itself = dx;
    const D& same = itself;  // an alias: the operand changes under the operator
    itself *= same;
    CHECK(equals(itself, x * x, 2 * x, 0));
    itself = variable<2>(power, 0);
    itself /= same;
    CHECK(equals(itself, 1, 0, 0));
    itself = dx;
    itself -= same;
    CHECK(equals(itself, 0, 0, 0));
  }
}

TEST_CASE("construction from double at every depth") {
  using D1 = Dual<Interval, 3>;
  using D2 = Dual<D1, 3>;
  using D3 = Dual<D2, 3>;
  const D3 constant(0.75);
  CHECK(identical(constant.value().value().value(), Interval(0.75)));
  CHECK(identical(constant.derivative(2).value().value(), Interval(0.0)));
  CHECK(identical(constant.value().derivative(1).value(), Interval(0.0)));
  CHECK(identical(constant.derivative(2).derivative(1).derivative(0), Interval(0.0)));
  CHECK(D2(2) == D2(2.0));
  CHECK(is_empty(D2().value().value()));
  CHECK(is_empty(D2().derivative(0).derivative(0)));
}

TEST_CASE("what is undefined somewhere has neither a value nor derivatives") {
  const UpwardRounding upward;
  using D = Dual<Interval, 1>;
  const auto at = [](double lower, double upper) {
    return variable<1>(Interval::from_bounds(lower, upper), 0);
  };
  const auto is_nothing = [](const D& x) { return is_empty(x.value()) && is_empty(x.derivative(0)); };
  CHECK(is_nothing(log(at(-2, -1))));
  CHECK(is_nothing(log(at(-1, 2))));
  CHECK(is_nothing(log(at(0, 2))));
  CHECK(is_nothing(sqrt(at(-2, 2))));
  CHECK(is_nothing(tan(at(1, 2))));
  CHECK(is_nothing(D(1.0) / at(-1, 1)));
  CHECK(is_nothing(at(1, 2) / at(0, 1)));
  CHECK(is_nothing(pow(at(-1, 1), -1)));
  CHECK(is_nothing(atan2(at(-1, 1), D(-1.0))));  // across the branch cut
  CHECK(is_nothing(atan2(at(-1, 1), D(0.0))));
  CHECK(is_nothing(D(Interval::empty())));
  CHECK(is_nothing(variable<1>(Interval::empty(), 0)));
  CHECK(is_nothing(log(at(-2, -1)) * D(0.0)));
  CHECK(is_nothing(pow(log(at(-2, -1)), 0)));
  CHECK(is_nothing(log(at(-2, -1)) + at(1, 2)));
  // The square root is defined at zero, and not differentiable there.
  CHECK(is_finite(sqrt(at(0, 1)).value()));
  CHECK(is_empty(sqrt(at(0, 1)).derivative(0)));
  // Nested: everything goes.
  const auto twice = log(variable<1>(at(-2, -1), 0));
  CHECK(is_nothing(twice.value()));
  CHECK(is_nothing(twice.derivative(0)));
  const Dual<double, 1> not_a_number = log(variable<1>(-1.0, 0));
  CHECK(std::isnan(not_a_number.value()));
  CHECK(std::isnan(not_a_number.derivative(0)));
}

TEST_CASE("fixed-size Eigen matrices of duals") {
  const UpwardRounding upward;
  using D = Dual<Interval, 2>;
  const D x = variable<2>(Interval(3.0), 0);
  const D y = variable<2>(Interval(5.0), 1);
  Eigen::Matrix<D, 2, 2> a;
  a << x, y, D(1.0), x;
  const Eigen::Matrix<D, 2, 2> square = a * a;  // [x^2 + y, 2 x y; 2 x, y + x^2]
  CHECK(identical(square(0, 1).value(), Interval(30.0)));
  CHECK(identical(square(0, 1).derivative(0), Interval(10.0)));
  CHECK(identical(square(0, 1).derivative(1), Interval(6.0)));
  CHECK(identical(square(1, 1).derivative(0), Interval(6.0)));
  // Large enough for Eigen's blocked product.
  using Wide = Eigen::Matrix<D, 12, 12>;
  const Wide big = Wide::Constant(x);
  const Wide product = big * Wide::Constant(y).transpose();
  CHECK(identical(product(11, 3).value(), Interval(180.0)));
  CHECK(identical(product(11, 3).derivative(0), Interval(60.0)));
  CHECK(identical(product(11, 3).derivative(1), Interval(36.0)));
}
