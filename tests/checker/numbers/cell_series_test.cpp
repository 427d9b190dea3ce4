#include "checker/numbers/cell_series.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/random.hpp"

namespace {

using veritrack::checker::Ball;
using veritrack::checker::CellSeries;
using veritrack::checker::SineCosine;

/// A number with what it is over the whole cell.
struct Point {
  double value;
  CellSeries series;
};

/// 0.7 + a x + b y at a random point of the cell: all values of what is made of it must be in the series.
struct Plane {
  double a, b, x, y;
  explicit Plane(veritrack::test::Random& random)
      : a(0.2 * (random.uniform() - 0.5)),
        b(0.2 * (random.uniform() - 0.5)),
        x(2.0 * random.uniform() - 1.0),
        y(2.0 * random.uniform() - 1.0) {}
  [[nodiscard]] Point at(double constant) const {
    return {constant + a * x + b * y, CellSeries(Ball(constant), Ball(a), Ball(b))};
  }
};

void check_contains(const CellSeries& series, double value) {
  const Ball range = series.range();
  CHECK(range.lower().near() <= value + 1e-12);
  CHECK(value - 1e-12 <= range.upper().near());
}

TEST_CASE("a series contains every value over its cell") {
  veritrack::test::Random random;
  const auto runs = veritrack::test::effort(200);
  for (std::int64_t run = 0; run < runs; ++run) {
    const Plane plane(random);
    const Point p = plane.at(0.7);
    const Point q = plane.at(-1.3);
    const SineCosine angle(p.series);
    check_contains(p.series * q.series * p.series, p.value * q.value * p.value);
    check_contains(reciprocal(q.series), 1.0 / q.value);
    check_contains(angle.sine, std::sin(p.value));
    check_contains(angle.cosine * angle.sine, std::cos(p.value) * std::sin(p.value));
    check_contains(reciprocal(p.series * p.series - q.series), 1.0 / (p.value * p.value - q.value));
  }
}

TEST_CASE("what a series leaves out of its polynomial is in the remainder") {
  veritrack::test::Random random;
  for (std::int64_t run = 0; run < veritrack::test::effort(100); ++run) {
    const Plane plane(random);
    const Point p = plane.at(0.7);
    CellSeries sine = SineCosine(p.series).sine;
    const double remainder = sine.remainder().upper_double();
    CHECK(remainder < 2e-3);
    sine.drop_remainder();
    CHECK(sine.remainder().upper_double() == 0.0);
    check_contains(sine + Ball::within(Ball(remainder)), std::sin(p.value));
  }
}

TEST_CASE("nothing is known of the reciprocal where the function may vanish") {
  const CellSeries through_zero(Ball(0.1), Ball(0.2), Ball(0.0));
  CHECK(!reciprocal(through_zero).range().finite());
}

}  // namespace
