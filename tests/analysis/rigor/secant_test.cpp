#include "analysis/rigor/secant.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/support/random.hpp"

using namespace veritrack;
using rigor::Interval;
using rigor::Secant;

namespace {

using Two = Secant<2>;

/// Something that uses every operation; over double and over secants.
template <typename Scalar>
Scalar everything(const Scalar& x, const Scalar& y) {
  using rigor::arctangent_ratio;
  using rigor::sine_ratio;
  using std::cos;
  using std::sin;
  using std::sqrt;
  const Scalar three(3.0);
  Scalar sum = x * y - three * x;
  sum += (x + three) / (three + x * y);
  sum -= sqrt(three + x) * sine_ratio(y);
  sum *= arctangent_ratio(x * x - y);
  return -sum + x / (y + three);
}

double with_square_and_circle(double x, double y) {
  return x * x * std::sin(y) - std::cos(x * y);
}
Two with_square_and_circle(const Two& x, const Two& y) {
  return square(x) * sin_cos(y).first - sin_cos(x * y).second;
}

/// Holds a double computation in round to nearest up to its own rounding errors.
bool holds_rounded(const Interval& enclosure, double value) {
  const double room = 1e-12 * (1.0 + std::fabs(value));
  return enclosure.lower() <= value + room && enclosure.upper() >= value - room;
}

}  // namespace

TEST_CASE("secants hold the function at the centre, over the box, and from the centre") {
  test::Random random(11);
  const auto count = test::effort(200);
  for (int i = 0; i < count; ++i) {
    const std::array<double, 2> center{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    const double reach = std::pow(10.0, random.uniform(-6.0, -0.3));
    const rigor::UpwardRounding upward;
    const auto side = [&](std::size_t k) {
      return Interval::from_bounds(center[k] - reach, center[k] + reach);
    };
    const Two x = Two::variable(side(0), center[0], 0);
    const Two y = Two::variable(side(1), center[1], 1);
    const std::array<Two, 2> secants{everything(x, y), with_square_and_circle(x, y)};
    for (int j = 0; j < 10; ++j) {
      std::array<double, 2> point{};
      std::array<double, 2> values{};
      std::array<double, 2> at_center{};
      {
        const rigor::NearestRounding nearest;
        for (std::size_t k = 0; k < 2; ++k) {
          const double share = j < 4 ? ((j >> k) % 2 == 0 ? -1.0 : 1.0) : random.uniform(-1.0, 1.0);
          point[k] = std::min(std::max(center[k] + share * reach, side(k).lower()), side(k).upper());
        }
        values = {everything(point[0], point[1]), with_square_and_circle(point[0], point[1])};
        at_center = {everything(center[0], center[1]), with_square_and_circle(center[0], center[1])};
      }
      const Two::Slopes offset{Interval(point[0]) - Interval(center[0]),
                               Interval(point[1]) - Interval(center[1])};
      for (std::size_t f = 0; f < 2; ++f) {
        CAPTURE(i);
        CAPTURE(j);
        CAPTURE(f);
        REQUIRE(rigor::is_finite(secants[f].range()));
        CHECK(holds_rounded(secants[f].range(), values[f]));
        CHECK(holds_rounded(secants[f].center(), at_center[f]));
        CHECK(holds_rounded(secants[f].moved_by(offset), values[f]));
      }
    }
  }
}

TEST_CASE("secants: slopes of products are half as wide as derivatives") {
  const rigor::UpwardRounding upward;
  const Secant<1> x = Secant<1>::variable(Interval::from_bounds(1.0, 3.0), 2.0, 0);
  CHECK(rigor::identical((x * x).slope(0), Interval::from_bounds(3.0, 5.0)));  // the derivative: [2, 6]
  CHECK(rigor::identical(square(x).slope(0), Interval::from_bounds(3.0, 5.0)));
}

TEST_CASE("secants: what is undefined somewhere in the box says nothing") {
  const rigor::UpwardRounding upward;
  const Secant<1> x = Secant<1>::variable(Interval::from_bounds(-1.0, 3.0), 1.0, 0);
  const Secant<1>::Slopes none{Interval(0.0)};
  CHECK(rigor::is_empty(sqrt(x).moved_by(none)));
  CHECK(rigor::is_empty((Secant<1>(1.0) / x).moved_by(none)));
  CHECK(rigor::is_empty((Secant<1>() * x).moved_by(none)));
  // Also after an operation in which it plays no part any more.
  CHECK(rigor::is_empty((Secant<1>(0.0) * sqrt(x)).moved_by(none)));
  CHECK_FALSE(rigor::is_empty(sqrt(x + Secant<1>(2.0)).moved_by(none)));
}
