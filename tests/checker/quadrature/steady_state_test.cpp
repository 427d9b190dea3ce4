// Bands over which there is no branch of steady states: what is not covered is not claimed.
#include "checker/quadrature/steady_state.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "trackers/quadrature/quadrature_polar_frame.hpp"

using namespace veritrack::checker;

namespace {

Design design_over(const Ball& lowest, const Ball& highest) {
  Design design;
  design.amplitude = one;
  design.q1 = design.q2 = Ball(0.0013);
  design.r = Ball(0.01);
  design.epsilon = Ball(0.01);
  design.lowest_frequency = lowest;
  design.highest_frequency = highest;
  return design;
}

bool has_branch(const Ball& lowest, const Ball& highest) {
  return steady_branch(design_over(lowest, highest), 0.3, 1e-4).has_value();
}

}  // namespace

TEST_CASE("a branch is one over a band of frequencies that are not negative, and known to a double") {
  CHECK(has_branch(Ball(0.001), Ball(0.01)));
  CHECK_FALSE(has_branch(Ball(-0.01), Ball(0.01)));
  CHECK_FALSE(has_branch(Ball::hull(Ball(0.001), Ball(0.002)), Ball(0.01)));
  CHECK_FALSE(has_branch(Ball(0.001), Ball::hull(Ball(0.01), Ball(0.011))));
}

TEST_CASE("the steady state is where the tracker settles") {
  using namespace veritrack;
  const auto branch = steady_branch(design_over(Ball(0.02), Ball(0.0201)), 0.3, 1e-4);
  REQUIRE(branch.has_value());
  trackers::PolarFrameState<double> state{{0.0, 0.0, 0.0}, {0.01, 0.0, 0.0, 0.01, 0.0, 0.01}};
  for (int k = 0; k < 5000; ++k) {
    state = trackers::polar_frame_map(state, {0.0, 0.0, 0.0, 0.02}, {0.0013, 0.0013, 0.01, 0.01});
  }
  const StateVector found = branch->front().at(Ball(0.02));
  const std::array<double, kStates> expected{
      state.error.amplitude, state.error.phase,    state.error.frequency,
      state.covariance.p11,  state.covariance.p12, state.covariance.p13,
      state.covariance.p22,  state.covariance.p23, state.covariance.p33};
  for (std::size_t i = 0; i < kStates; ++i) {
    CAPTURE(i);
    CHECK(std::fabs(found[i].near() - expected[i]) <= 1e-4 * (1e-3 + std::fabs(expected[i])));
    CHECK_FALSE(certainly_less(found[i], Ball(expected[i] - 1e-9)));
    CHECK_FALSE(certainly_less(Ball(expected[i] + 1e-9), found[i]));
  }
}
