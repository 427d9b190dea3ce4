#include "analysis/quadrature/leak/steady_cell.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

SteadyCell cell_of(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y + height}};
}

/// The largest of c X + s Y over the corners of the cell's polygon.
double reach(const SteadyCell& cell, double c, double s) {
  double most = -1e300;
  for (const SteadyCell::Point& point : cell.corners()) {
    most = std::max(most, c * point.x + s * point.y);
  }
  return most;
}

TEST_CASE("the polygon of a cell holds all of the cell that lies in the disc, and little else") {
  const rigor::UpwardRounding upward;
  test::Random random(61);
  for (std::int64_t trial = 0; trial < test::effort(300); ++trial) {
    CAPTURE(trial);
    const SteadyCell cell = cell_of(random.uniform(-1.0, 0.8), random.uniform(-1.0, 0.8),
                                    random.uniform(0.01, 1.0), random.uniform(0.01, 1.0));
    if (cell.is_outside()) {
      for (int k = 0; k < 50; ++k) {
        CHECK(std::hypot(random.uniform(cell.low[kX], cell.high[kX]),
                         random.uniform(cell.low[kY], cell.high[kY])) > 1.0 - 1e-12);
      }
      continue;
    }
    for (int k = 0; k < 40; ++k) {
      const double angle = random.uniform(-3.2, 3.2);
      const double c = std::cos(angle);
      const double s = std::sin(angle);
      const double polygon = reach(cell, c, s);
      for (int i = 0; i < 20; ++i) {
        double x = random.uniform(cell.low[kX], cell.high[kX]);
        double y = random.uniform(cell.low[kY], cell.high[kY]);
        x = i % 3 == 0 ? cell.low[kX] : i % 3 == 1 ? cell.high[kX] : x;
        if (std::hypot(x, y) <= 1.0) {
          CHECK(c * x + s * y <= polygon + 1e-12);
        }
      }
    }
  }
}

TEST_CASE("a cell within the disc keeps its corners, and one beyond it is outside") {
  const rigor::UpwardRounding upward;
  const SteadyCell inside = cell_of(0.25, -0.5, 0.25, 0.25);
  CHECK_FALSE(inside.is_outside());
  CHECK(inside.corners().size() == 4);
  for (const SteadyCell::Point& point : inside.corners()) {
    CHECK((point.x == 0.25 || point.x == 0.5));
    CHECK((point.y == -0.5 || point.y == -0.25));
  }
  CHECK(cell_of(0.75, 0.75, 0.25, 0.25).is_outside());
  CHECK_FALSE(cell_of(0.5, 0.5, 0.5, 0.5).is_outside());
  CHECK_FALSE(cell_of(-1.0, -1.0, 2.0, 2.0).is_outside());
}

TEST_CASE("corners are looked at at both ends of the frequencies") {
  const rigor::UpwardRounding upward;
  const SteadyCell cell = cell_of(0.0, 0.0, 0.5, 0.5);
  const auto offsets = corner_offsets(cell, Interval::from_bounds(-0.125, 0.25));
  CHECK(offsets.size() == 2 * cell.corners().size());
  for (const double frequency : {-0.125, 0.25}) {
    for (const double x : {-0.25, 0.25}) {
      for (const double y : {-0.25, 0.25}) {
        CHECK(std::any_of(offsets.begin(), offsets.end(), [&](const SteadyOffset& offset) {
          return offset[kX] == Interval(x) && offset[kY] == Interval(y) &&
                 offset[kFrequency] == Interval(frequency);
        }));
      }
    }
  }
}

}  // namespace
}  // namespace veritrack::quadrature
