// Starts that enter a set around the steady state, and starts that one guard alone keeps out of it.
#include "checker/quadrature/steady_start.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <vector>

using namespace veritrack::checker;

namespace {

constexpr double kBound = 1e-3;  // of the covariances' deviation

Design the_design() {
  Design design;
  design.amplitude = one;
  design.q1 = design.q2 = Ball(0.0013);
  design.r = Ball(0.01);
  design.epsilon = Ball(0.01);
  design.lowest_frequency = Ball(0.02);
  design.highest_frequency = Ball(0.0201);
  design.largest_frequency = Ball(0.0201);
  design.noise = design.slew = zero;
  design.amplitude_error = design.phase_error = design.frequency_error = Ball(0x1p-20);
  return design;
}

const std::vector<SteadyCell>& the_branch() {
  static const auto branch = steady_branch(the_design(), 0.3, 1e-4);
  REQUIRE(branch.has_value());
  return *branch;
}

Matrix3 steady_covariance() {
  return matrix_of(covariance_part(the_branch().back().middle));
}

SteadySet the_set() {
  SteadySet set;
  set.setting.metric = {Ball(8.0), zero, zero, Ball(8.0), zero, Ball(8.0)};
  set.setting.below = {Ball(kBound), zero, zero, Ball(kBound), zero, Ball(kBound)};
  set.setting.above = set.setting.below;
  set.noise = set.slew = Ball(0.01);
  set.levels = {one, half};
  return set;
}

/// Followed for up to so many samples.
std::optional<SteadyStart> found(const Design& design, int samples,
                                 const Matrix3& covariance = steady_covariance()) {
  return steady_start(design, the_set(), the_branch(), {covariance, covariance, ""},
                      {Ball(samples), {}, {}, zero});
}

}  // namespace

TEST_CASE("a start is at its level, and in the last set after as many steps as are left") {
  Design design = the_design();
  const auto near = found(design, 0);
  REQUIRE(near.has_value());
  CHECK(certainly_at_most(near->level, half));
  CHECK(certainly_equal(near->settling, zero));
  // Half of 1/8 rad/sample about a steady state that is biased by half a thousandth.
  CHECK(certainly_at_most(Ball(0.0625 + 0.0005), near->bound));
  design.frequency_error = Ball(0.1);
  for (const Ball& slew : {zero, Ball(0x1p-20)}) {
    design.slew = slew;
    const auto far = found(design, 0);
    REQUIRE(far.has_value());
    CHECK(certainly_at_most(Ball(0.79), far->level));
    CHECK(certainly_equal(far->settling, one));
    CHECK(certainly_at_most(Ball(0.1), far->bound));
  }
}

TEST_CASE("starts beyond the set are followed where the frequency is constant, and only there") {
  Design design = the_design();
  design.frequency_error = Ball(0.13);
  CHECK_FALSE(found(design, 0).has_value());
  const auto followed = found(design, 6);
  REQUIRE(followed.has_value());
  CHECK(certainly_at_most(one, followed->samples));
  CHECK(certainly_at_most(Ball(0.13), followed->bound));
  design.slew = Ball(0x1p-20);
  CHECK_FALSE(found(design, 6).has_value());
}

TEST_CASE("covariances of the start are in the set from below and from above") {
  const Matrix3 steady = steady_covariance();
  for (const std::size_t i : {0U, 1U, 2U}) {
    CAPTURE(i);
    for (const double off : {-0.9, 0.9, -1.1, 1.1}) {
      CAPTURE(off);
      Matrix3 p = steady;
      p[i][i] += Ball(off * kBound);
      CHECK(found(the_design(), 0, p).has_value() == (std::fabs(off) < 1.0));
    }
  }
}

TEST_CASE("no cell holds no start") {
  CHECK_FALSE(steady_start(the_design(), the_set(), {}, {steady_covariance(), steady_covariance(), ""}, {})
                  .has_value());
}
