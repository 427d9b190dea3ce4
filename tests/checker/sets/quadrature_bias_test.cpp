// The bias of the quadrature tracker: enclosures against the tracker's own code, and frequencies that no cell
// of the branch contains.
#include "checker/sets/quadrature_bias.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "trackers/quadrature/quadrature_polar_frame.hpp"

namespace {

using namespace veritrack;
using checker::Ball;
using checker::QuadratureBranch;

checker::TrackerValues<Ball> values(double q, double r, double epsilon) {
  return {Ball(q), Ball(q), Ball(r), Ball(epsilon)};
}

/// Where the tracker settles without noise, rad/sample.
double settled_error(double q, double r, double epsilon, double frequency) {
  trackers::PolarFrameState<double> state{{0.0, 0.0, 0.0}, {r, 0.0, 0.0, r, 0.0, r}};
  for (int k = 0; k < 20000; ++k) {
    state = trackers::polar_frame_map(state, {0.0, 0.0, 0.0, frequency}, {q, q, r, epsilon});
  }
  return state.error.frequency;
}

bool holds(const Ball& enclosure, double value, double slack) {
  return enclosure.finite() && std::fabs(enclosure.near() - value) <= slack &&
         !certainly_less(enclosure, Ball(value - slack)) && !certainly_less(Ball(value + slack), enclosure);
}

}  // namespace

TEST_CASE("the bias is the one at which the tracker settles") {
  QuadratureBranch branch(values(0.001, 0.05, 0.01));
  for (const double frequency : {0.0, 0.02, 0.1}) {
    CAPTURE(frequency);
    CHECK(holds(branch.error_at(Ball(frequency)), settled_error(0.001, 0.05, 0.01, frequency), 1e-9));
  }
}

TEST_CASE("a frequency has the bias of the cell that contains it, and of no other") {
  QuadratureBranch near(values(0.001, 0.05, 0.01));
  const Ball before = near.error_at(Ball(0.02));
  QuadratureBranch far(values(0.001, 0.05, 0.01));
  CHECK(far.error_at(Ball(0.25)).finite());
  const Ball after = far.error_at(Ball(0.02));
  CHECK(arb_equal(before.raw(), after.raw()) != 0);
  // Frequencies on both sides of an end of two cells are in neither.
  CHECK_FALSE(far.error_at(Ball::hull(Ball(0x1.ffp-7), Ball(0x1.01p-6))).finite());
  CHECK(far.error_at(Ball::hull(Ball(0x1.fep-7), Ball(0x1.ffp-7))).finite());
}

TEST_CASE("a covariance that is not certainly positive definite may be another solution") {
  QuadratureBranch branch(values(1e-4, 1e-14, 0.01));  // of which the variances are less than the room for it
  CHECK_FALSE(branch.error_at(Ball(0.0)).finite());
  CHECK_FALSE(branch.error_at(Ball(0.1)).finite());
}
