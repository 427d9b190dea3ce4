// What an established curve is about: the frequency that was asked for.
#include "checker/single_channel/invariant_curve.hpp"

#include <doctest/doctest.h>

namespace {

using namespace veritrack::checker;

TrackerValues<Ball> usual_values() {
  return {Ball(1.0), Ball(1.0), Ball(10.0), Ball(0.01)};
}

}  // namespace

TEST_CASE("curves of an interval of frequencies are those of the frequency only when it is among them") {
  // A ball of frequencies, of which the family's middle is one.
  const Ball frequency = Ball::hull(Ball(1.5), Ball(1.5 + 0x1p-40));
  const Ball rate(0.92);
  CHECK(establish_invariant_curve(usual_values(), frequency, 0x1p-30, rate).has_value());
  CHECK(!establish_invariant_curve(usual_values(), frequency, 0x1p-45, rate).has_value());
}
