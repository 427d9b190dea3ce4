#include "analysis/sets/controllability.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"
#include "tests/trackers/textbook_ekf.hpp"

using namespace veritrack;
using rigor::Interval;
using rigor::UpwardRounding;
using rigor::Verdict;
using sets::find_uncontrollable_mode;

namespace {

trackers::ToneModel<Interval> design_of(double q1, double q2, double r, double epsilon) {
  return {Interval(q1), Interval(q2), Interval(r), Interval(epsilon)};
}

/// The variance of the amplitude after `steps` steps of the textbook filter locked on a tone.
double amplitude_variance(double q1, double q2, double r, double epsilon, double frequency, int steps) {
  test::TextbookEkf<double> filter{
      q1, q2, r, epsilon, Eigen::Vector3d(1.0, 0.0, frequency), r * Eigen::Matrix3d::Identity()};
  double phase = 0.0;
  for (int k = 0; k < steps; ++k) {
    phase += frequency;
    filter.step(Eigen::Vector2d(std::cos(phase), std::sin(phase)));
  }
  const double angle = std::atan2(filter.x[1], filter.x[0]);
  const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0.0);
  return along.dot(filter.P * along);
}

}  // namespace

TEST_CASE("q1 = 0 without a leak: the amplitude is the witness") {
  test::Random random(920);
  for (std::int64_t round = 0; round < test::effort(50); ++round) {
    const double q2 = std::pow(10.0, random.uniform(-6.0, 1.0));
    const double r = std::pow(10.0, random.uniform(-6.0, 1.0));
    const UpwardRounding upward;
    const auto mode = find_uncontrollable_mode(design_of(0.0, q2, r, 0.0));
    REQUIRE(mode.verdict == Verdict::proved);
    // The witness, in plain doubles.
    const Eigen::RowVector3d w = mode.left_eigenvector.transpose();
    Eigen::Matrix3d f;
    f << 1, 0, 0, 0, 1, 1, 0, 0, 1;
    CHECK(w.norm() > 0.0);
    CHECK(std::fabs(mode.eigenvalue) == 1.0);
    CHECK((w * f - mode.eigenvalue * w).norm() == 0.0);
    CHECK((w * Eigen::Vector3d(0.0, 0.0, q2).asDiagonal()).norm() == 0.0);
    CHECK(contains(mode.transition, f));
  }
}

TEST_CASE("what the witness says is seen: the variance falls like 1/k, and not with q1 or a leak") {
  const double late = amplitude_variance(0.0, 0.0013, 0.01, 0.0, 1.0, 20000);
  const double later = amplitude_variance(0.0, 0.0013, 0.01, 0.0, 1.0, 40000);
  CHECK(std::fabs(20000.0 * late / 0.01 - 1.0) < 0.01);
  CHECK(std::fabs(later / late - 0.5) < 0.01);
  for (const auto& [q1, epsilon] : {std::pair{0.001, 0.0}, std::pair{0.0, 0.05}}) {
    const double settled = amplitude_variance(q1, 0.0013, 0.01, epsilon, 1.0, 20000);
    CHECK(std::fabs(amplitude_variance(q1, 0.0013, 0.01, epsilon, 1.0, 40000) / settled - 1.0) < 1e-6);
  }
}

TEST_CASE("with q1 > 0, with a leak, or without numbers nothing is said") {
  const UpwardRounding upward;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double tiny = std::numeric_limits<double>::denorm_min();
  for (const auto& design : {design_of(0.001, 0.0013, 0.01, 0.0), design_of(tiny, 0.0013, 0.01, 0.0),
                             design_of(0.0, 0.0013, 0.01, 0.01), design_of(0.0, 0.0013, 0.01, tiny),
                             design_of(0.0013, 0.0013, 0.01, 0.05), design_of(nan, 0.0013, 0.01, 0.0),
                             design_of(0.0, nan, 0.01, 0.0), design_of(0.0, 0.0013, nan, 0.0),
                             design_of(0.0, 0.0013, 0.01, nan)}) {
    const auto mode = find_uncontrollable_mode(design);
    CHECK(mode.verdict == Verdict::undecided);
    CHECK_FALSE(mode.reason.empty());
  }
  auto uncertain = design_of(0.0, 0.0013, 0.01, 0.0);
  uncertain.q1 = Interval::from_bounds(0.0, 1e-300);
  CHECK(find_uncontrollable_mode(uncertain).verdict == Verdict::undecided);
}
