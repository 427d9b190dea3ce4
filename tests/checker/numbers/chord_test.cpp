#include "checker/numbers/chord.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "checker/numbers/slope.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using checker::Ball;
using checker::Chord;

/// Functions of three variables that use everything, on numbers around (1, 2, 0).
template <typename S>
std::array<S, 4> functions(const S& x, const S& y, const S& z) {
  const S quotient = sin(x * z) / (y + square(z));
  return {sqrt(x + y) * cos(quotient) - z, reciprocal(x + square(y)) + Ball(3.0) * (x * y),
          sine_over(z) * x - sine_over(y), arctangent_over(z - x) + square(quotient)};
}

}  // namespace

TEST_CASE("values lie on chords from the centre") {
  test::Random random(83);
  for (std::int64_t trial = 0; trial < test::effort(300); ++trial) {
    CAPTURE(trial);
    const double width = std::exp2(-random.uniform(1.0, 20.0));
    std::array<double, 3> low{};
    std::array<double, 3> centre{};
    const std::array<double, 3> around{1.0, 2.0, 0.0};
    std::array<Chord, 3> chords;
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = around[i] + random.uniform(-0.3, 0.3);
      centre[i] = low[i] + random.uniform() * width;
      chords[i] = Chord(Ball(centre[i]), Ball::hull(Ball(low[i]), Ball(low[i] + width)), i, Ball(1.0));
    }
    const auto over = functions(chords[0], chords[1], chords[2]);
    for (int point = 0; point < 10; ++point) {
      std::array<Ball, 3> at;
      std::array<Ball, 3> way;
      for (std::size_t i = 0; i < 3; ++i) {
        at[i] = Ball(low[i] + random.uniform() * width);
        way[i] = at[i] - Ball(centre[i]);
      }
      const auto values = functions(at[0], at[1], at[2]);
      for (std::size_t f = 0; f < values.size(); ++f) {
        CAPTURE(f);
        Ball along = over[f].centre;
        for (std::size_t i = 0; i < 3; ++i) {
          along += over[f].by[i] * way[i];
        }
        CHECK(arb_overlaps(along.raw(), values[f].raw()) != 0);
        CHECK(arb_overlaps(over[f].range.raw(), values[f].raw()) != 0);
        // Not much more than that, either.
        CHECK(arb_contains(over[f].centre.raw(),
                           functions(Ball(centre[0]), Ball(centre[1]), Ball(centre[2]))[f].raw()) != 0);
        CHECK(mag_get_d(arb_radref(along.raw())) <= 20.0 * width * width + 1e-30);
      }
    }
  }
}
