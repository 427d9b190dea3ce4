#include "analysis/quadrature/leak/steady_motion.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>

#include "tests/support/oracles.hpp"

namespace {

using namespace veritrack;
using namespace veritrack::quadrature;
using rigor::Interval;

Eigen::Matrix3d covariance_of(const sets::BranchCell& tube) {
  const auto& x = tube.center;
  Eigen::Matrix3d p;
  p << x[3], x[4], x[5], x[4], x[6], x[7], x[5], x[7], x[8];
  return p;
}

/// The eigenvalue of x, relative to the bound, that is largest in size.
double decisive_eigenvalue(const Eigen::Matrix3d& x, const Eigen::Matrix3d& bound) {
  const Eigen::Vector3d values = oracle::relative_eigenvalues(x, bound);
  return -values[0] > values[2] ? values[0] : values[2];
}

}  // namespace

TEST_CASE("the motion with the slew covers the way between steady states, whichever its sign") {
  const rigor::UpwardRounding upward;
  const trackers::ToneModel<Interval> design{Interval(0.0013), Interval(0.0013), Interval(0.01),
                                             Interval(0.01)};
  const auto branch = sets::verify_lock_branch(design, Interval::from_bounds(0.5, 0.55), {.largest = 0.02});
  REQUIRE(branch.verdict == rigor::Verdict::proved);
  const sets::BranchCell& first = branch.cells.front();
  const sets::BranchCell& last = branch.cells.back();
  const double way = last.parameter_center - first.parameter_center;
  REQUIRE(way > 0.0);
  const Eigen::Matrix3d slope = (covariance_of(last) - covariance_of(first)) / way;
  Eigen::Vector3d error = (last.center.head<3>() - first.center.head<3>()) / way;
  error[2] += 1.0;  // the frequency moves, the estimate does not
  const Eigen::Matrix3d directions = oracle::symmetric_eigenvectors(slope);
  for (const int sign : {-1, 1}) {
    CAPTURE(sign);
    // A bound that is wide where the covariance moves with the other sign.
    const Eigen::Vector3d wide = directions.col(sign > 0 ? 0 : 2);
    const Eigen::Matrix3d bound =
        rigor::Matrix<3>::Identity() + 1e4 * Eigen::Matrix3d(wide * wide.transpose());
    const double needed = decisive_eigenvalue(slope, bound);
    REQUIRE(sign * needed > 0.0);
    SteadySet set;
    set.metric = rigor::Matrix<3>::Identity();
    set.below = set.above = rigor::Matrix<3>(0.5 * (bound + bound.transpose()));
    set.slew = 0x1p-10;
    const auto motion = steady_motion(design, branch.cells, set);
    REQUIRE(motion.has_value());
    CHECK(motion->errors.lower() >= set.slew * error.norm() * (1.0 - 1e-6));
    CHECK(motion->covariance.lower() >= set.slew * std::fabs(needed) * (1.0 - 1e-3));
  }
}
