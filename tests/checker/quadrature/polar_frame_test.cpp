#include "checker/quadrature/polar_frame.hpp"

#include <doctest/doctest.h>

using namespace veritrack::checker;

namespace {

/// The phase error after a step of a tracker that follows its measurements.
Ball phase_after(double phase) {
  Design design;
  design.q1 = design.q2 = one;
  design.r = Ball(0x1p-20);
  design.epsilon = zero;
  const PolarState<Ball> state{{zero, Ball(phase), zero}, {one, zero, zero, one, zero, one}};
  return polar_step(design, state, Ball(0.5)).error[1];
}

}  // namespace

TEST_CASE("an estimate that a step turns by more than a right angle has no phase that is known") {
  CHECK(certainly_less(abs(phase_after(0.5)), Ball(0x1p-16)));
  CHECK(certainly_less(abs(phase_after(1.5)), Ball(0x1p-16)));
  CHECK_FALSE(phase_after(1.7).finite());
  CHECK_FALSE(phase_after(2.9).finite());
}
