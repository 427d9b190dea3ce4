#include "analysis/quadrature/rounding/steady_rounding.hpp"

#include <doctest/doctest.h>

#include "tests/analysis/quadrature/rounding/rounding_twin.hpp"

using namespace veritrack;
using namespace veritrack::quadrature;
using namespace veritrack::test;
using rigor::Interval;

namespace {

const trackers::ToneModel<double> kLeaky{0.0013, 0.0013, 0.01, 0.01};

/// Errors of up to 0.1 in everything, and a third of the steady covariance.
SteadySet set_around(const Eigen::Matrix3d& steady) {
  SteadySet set;
  set.metric << 10.0, 1.0, 0.5, 0.0, 10.0, -2.0, 0.0, 0.0, 10.0;
  set.below = steady / 3.0;
  set.above = steady / 3.0;
  set.noise = 0.01;
  set.levels = {1.0};
  return set;
}

}  // namespace

TEST_CASE("around the steady state rounding moves errors and covariance by less than the bounds") {
  const trackers::ToneModel<Interval> design{Interval(kLeaky.q1), Interval(kLeaky.q2), Interval(kLeaky.r),
                                             Interval(kLeaky.epsilon)};
  const sets::LockBranch branch = sets::verify_lock_branch(design, Interval::from_bounds(0.5, 0.7));
  REQUIRE(branch.verdict == rigor::Verdict::proved);
  const auto steady_at = [&](double frequency) {
    const rigor::UpwardRounding upward;
    for (const auto& cell : branch.cells) {
      if (rigor::contains(cell.parameter, frequency)) {
        return rigor::Vector<9>(rigor::midpoint(cell.at(Interval(frequency))));
      }
    }
    FAIL("no cell");
    return rigor::Vector<9>();
  };
  const auto covariance_of = [](const rigor::Vector<9>& x) {
    Eigen::Matrix3d p;
    p << x[3], x[4], x[5], x[4], x[6], x[7], x[5], x[7], x[8];
    return p;
  };
  const SteadySet set = set_around(covariance_of(steady_at(0.6)));
  const auto [error, covariance] = [&] {
    const rigor::UpwardRounding upward;
    const SteadyRounding bound = steady_rounding(design, {Interval(1.0), 0.7}, branch.cells, set);
    return std::pair(bound.error.upper(), bound.covariance.upper());
  }();
  Random random(7118);
  const Eigen::Matrix3d inverse = set.metric.inverse();
  double of_error = 0.0;
  double of_covariance = 0.0;
  for (std::int64_t i = 0; i < effort(2000); ++i) {
    const double omega = random.uniform(0.51, 0.69);
    const rigor::Vector<9> steady = steady_at(omega);
    const Eigen::Matrix3d p_steady = covariance_of(steady);
    const double phase = random.uniform(-3.0, 3.0);
    const Eigen::Vector3d direction(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                                    random.uniform(-1.0, 1.0));
    const Eigen::Vector3d e = steady.head<3>() + 0.999 * inverse * direction.normalized();
    const Eigen::Matrix3d u = plane_turn(phase + e[1]);
    const Eigen::Matrix3d p =
        u * between(random, p_steady - 0.999 * set.below, p_steady + 0.999 * set.above) * u.transpose();
    const trackers::QuadratureEstimate<double> start{(1.0 + e[0]) * std::cos(phase + e[1]),
                                                     (1.0 + e[0]) * std::sin(phase + e[1]), omega + e[2],
                                                     trackers::FactoredCovariance<double>::from_matrix(p)};
    const double of_noise = random.uniform(0.0, 2.0 * M_PI);
    const Twins twins = twin_steps(kLeaky, start, std::cos(phase + omega) + set.noise * std::cos(of_noise),
                                   std::sin(phase + omega) + set.noise * std::sin(of_noise));
    const Wide next = static_cast<Wide>(phase) + static_cast<Wide>(omega);
    const WidePolar a = trackers::to_polar_frame<Wide>(estimate_as<Wide>(twins.computed), 1.0L, next, omega);
    const WidePolar b = trackers::to_polar_frame<Wide>(twins.exact, 1.0L, next, omega);
    of_error = std::max(of_error, distance(set.metric, a, b) / error);
    of_covariance = std::max(of_covariance, share_of_difference(set.below, a, b) / covariance);
  }
  MESSAGE("rounding " << error << ", of which the twin shows " << of_error << "; covariance " << covariance
                      << ", " << of_covariance);
  CHECK(of_error <= 1.0);
  CHECK(of_covariance <= 1.0);
  CHECK(of_error >= 1e-4);
  CHECK(of_covariance >= 1e-5);
  CHECK(error <= 1e-10);
}
