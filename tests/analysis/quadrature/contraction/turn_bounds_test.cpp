#include "analysis/quadrature/contraction/turn_bounds.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>

#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

BlockCovariance<Interval> interval_block(const BlockCovariance<double>& p) {
  return {Interval(p.p11), Interval(p.p22), Interval(p.p23), Interval(p.p33)};
}
Eigen::Matrix3d matrix_of(const BlockCovariance<double>& p) {
  Eigen::Matrix3d m;
  m << p.p11, 0.0, 0.0, 0.0, p.p22, p.p23, 0.0, p.p23, p.p33;
  return m;
}

TEST_CASE("no step turns the estimate further than its amplitude's bound says") {
  const trackers::ToneModel<double> design{0.0013, 0.002, 0.01, 0.0};
  const BlockCovariance<double> low{0.003, 0.004, 0.001, 0.002};
  const BlockCovariance<double> high{0.004, 0.006, 0.002, 0.003};
  const double amplitude = 0.3;
  const double chi_end = 0.6;
  const double noise = 0.04;
  std::vector<TurnBound> turns;
  {
    const rigor::UpwardRounding upward;
    turns = bound_turns({{Interval(design.q1), Interval(design.q2), Interval(design.r), Interval(0.0)},
                         {Interval(1.0), Interval(1.0), Interval(0.0), Interval(1.0)},
                         interval_block(low),
                         interval_block(high),
                         Interval(amplitude),
                         Interval(chi_end),
                         Interval(noise)});
  }
  REQUIRE(!turns.empty());
  const Eigen::Matrix3d root = oracle::cholesky_factor(matrix_of(high) - matrix_of(low));
  test::Random random(78);
  double closest = 0.0;
  for (std::int64_t k = 0; k < test::effort(20000); ++k) {
    const double angle = random.uniform(-3.15, 3.15);
    const double s = random.below(2) == 0 ? 1.0 : random.uniform();
    const double a = s * amplitude * std::cos(angle);
    const double chi = s * chi_end * std::sin(angle);
    const Eigen::Vector3d u =
        Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
    const Eigen::Matrix3d p = matrix_of(low) + root * (u * u.transpose()) * root.transpose();
    const double nu = random.uniform(-0.3, 0.3);
    const double direction = random.uniform(-3.15, 3.15);
    const trackers::PolarFrameState<double> state{{a, chi - nu, nu},
                                                  trackers::PolarCovariance<double>::from_matrix(p)};
    const auto predicted = trackers::predicted_covariance(state.covariance, 1.0 + a, design);
    const auto step =
        trackers::error_step(state.error, trackers::gain(predicted, design.r),
                             {noise * std::cos(direction), noise * std::sin(direction), 0.0, 0.0}, 0.0);
    const double tangent = std::fabs(step.turn_sine / step.turn_cosine);
    REQUIRE(step.turn_cosine > 0.0);
    bool covered = false;
    for (const TurnBound& turn : turns) {
      if (turn.rho.lower() <= 1.0 + a && 1.0 + a <= turn.rho.upper()) {
        covered = true;
        CHECK(tangent <= turn.tangent);
        closest = std::max(closest, tangent / turn.tangent);
      }
    }
    CHECK(covered);
  }
  CHECK(closest > 0.8);
}

TEST_CASE("turns that may be right angles have no bound") {
  const rigor::UpwardRounding upward;
  const BlockCovariance<Interval> p = interval_block({0.003, 0.004, 0.001, 0.002});
  StepSetting<Interval> setting{{Interval(0.001), Interval(0.001), Interval(0.01), Interval(0.0)},
                                {Interval(1.0), Interval(1.0), Interval(0.0), Interval(1.0)},
                                p,
                                p,
                                Interval(0.3),
                                Interval(0.6),
                                Interval(5.0)};
  CHECK(bound_turns(setting).empty());
  setting.noise = Interval::empty();
  CHECK(bound_turns(setting).empty());
  setting.noise = Interval(0.0);
  setting.largest_chi = Interval::entire();
  CHECK(bound_turns(setting).empty());
}

}  // namespace
}  // namespace veritrack::quadrature
