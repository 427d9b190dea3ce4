#include "analysis/theorems/other_results/continuous_time.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/analysis/theorems/tracker_inputs.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Verdict;

/// The oscillator, the estimate and the covariance N of the continuous-time filter, side by side.
struct Loop {
  Eigen::Vector3d state, estimate;
  Eigen::Matrix3d covariance;
};
Loop slope(const Loop& now, const test::TestDesign& design, double leak) {
  const auto flow = [leak](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(-x(2) * x(1), x(2) * x(0), -leak * x(2));
  };
  Eigen::Matrix3d f;
  f << 0.0, -now.estimate(2), -now.estimate(1), now.estimate(2), 0.0, now.estimate(0), 0.0, 0.0, -leak;
  const Eigen::Matrix3d weighted = now.covariance * Eigen::Vector3d(1.0, 1.0, 0.0).asDiagonal() / design.r;
  Loop rate;
  rate.state = flow(now.state);
  rate.estimate = flow(now.estimate) + weighted * (now.state - now.estimate);
  rate.covariance = f * now.covariance + now.covariance * f.transpose() - weighted * now.covariance;
  rate.covariance.diagonal() += Eigen::Vector3d(design.q1, design.q1, design.q2);
  return rate;
}

Loop plus(const Loop& a, const Loop& b, double scale) {
  return {a.state + scale * b.state, a.estimate + scale * b.estimate, a.covariance + scale * b.covariance};
}

Loop runge_kutta(const Loop& now, const test::TestDesign& design, double leak, double h) {
  const Loop k1 = slope(now, design, leak);
  const Loop k2 = slope(plus(now, k1, h / 2.0), design, leak);
  const Loop k3 = slope(plus(now, k2, h / 2.0), design, leak);
  const Loop k4 = slope(plus(now, k3, h), design, leak);
  return plus(plus(plus(plus(now, k1, h / 6.0), k2, h / 3.0), k3, h / 3.0), k4, h / 6.0);
}

}  // namespace

TEST_CASE("a start at the sound bound converges, and the covariance stays below q") {
  test::Random random(141);
  for (const test::TableRow& row : test::kTable32) {
    CAPTURE(row.figure);
    INFO("seed ", test::kSeed + 141);
    const test::TestDesign design = test::table_design(row);
    const auto derivation = theorems::evaluate_baras_bensoussan_james(test::tracker_input(design));
    const double bound = test::value_of(derivation, "initial_frequency_error_bound").lower();
    const double q = test::value_of(derivation, "q").upper();
    CHECK(bound > 1e-6);
    const double leak = -std::log1p(-design.epsilon);
    Eigen::Vector3d error(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    error *= bound / error.norm();
    Loop loop{{1.0, 0.0, 0.7}, Eigen::Vector3d(1.0, 0.0, 0.7) - error, q / 3.0 * Eigen::Matrix3d::Identity()};
    for (int step = 0; step < 20000; ++step) {
      loop = runge_kutta(loop, design, leak, 0.005);
      CHECK(loop.covariance.norm() <= std::sqrt(3.0) * q);
    }
    CHECK((loop.state - loop.estimate).norm() < 0.1 * bound);
  }
}

TEST_CASE("the conditions over all states are refuted, (2.16) as printed depends on units") {
  for (const double epsilon : {0.0, 0.05}) {
    CAPTURE(epsilon);
    test::TestDesign design = test::table_design(test::kTable32[0]);
    design.epsilon = epsilon;
    const auto derivation = theorems::evaluate_baras_bensoussan_james(test::tracker_input(design));
    for (const char* id :
         {"bounded-derivative", "detectable-everywhere", "controllable-everywhere", "units"}) {
      CHECK_MESSAGE(test::find_condition(derivation, id).verdict == Verdict::refuted, id);
    }
    CHECK(test::find_condition(derivation, "detectable").verdict ==
          (epsilon > 0.0 ? Verdict::proved : Verdict::refuted));
    CHECK(is_empty(test::value_of(derivation, "initial_frequency_error_bound")) == (epsilon == 0.0));
  }
}
