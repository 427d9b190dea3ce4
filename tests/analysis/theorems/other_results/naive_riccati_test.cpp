#include "analysis/theorems/other_results/naive_riccati.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>

#include "analysis/theorems/covariance_range.hpp"
#include "tests/analysis/theorems/tracker_inputs.hpp"
#include "tests/support/oracles.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Verdict;

/// P(k|k) of the textbook filter in double, estimates turned at random with |z| = m each step.
Eigen::Matrix3d textbook_covariance_step(const Eigen::Matrix3d& p, double m, double angle,
                                         const test::TestDesign& design) {
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  f(0, 2) = -m * std::sin(angle);
  f(1, 2) = m * std::cos(angle);
  f(2, 2) = 1.0 - design.epsilon;
  Eigen::Matrix3d predicted = f * p * f.transpose();
  predicted.diagonal() += Eigen::Vector3d(design.q1, design.q1, design.q2);
  const Eigen::Matrix2d s = predicted.topLeftCorner<2, 2>() + design.r * Eigen::Matrix2d::Identity();
  const Eigen::Matrix<double, 3, 2> gain = predicted.leftCols<2>() * s.inverse();
  Eigen::Matrix3d correction = Eigen::Matrix3d::Identity();
  correction.leftCols<2>() -= gain;
  const Eigen::Matrix3d next =
      correction * predicted * correction.transpose() + design.r * gain * gain.transpose();
  return 0.5 * (next + next.transpose());
}

}  // namespace

TEST_CASE("the covariance range holds along random runs of the textbook filter, and is nearly attained") {
  test::Random random(51);
  const rigor::UpwardRounding upward;
  for (std::int64_t i = 0; i < test::effort(200); ++i) {
    INFO("seed ", test::kSeed + 51, ", design ", i);
    test::TestDesign design = test::random_design(random);
    design.epsilon = random.uniform(0.0, 0.5);
    const double radius = random.uniform(0.01, 0.9);
    const theorems::TrackerInput input = test::tracker_input(design);
    const theorems::CovarianceRange range = theorems::covariance_range(input, Interval(radius));
    Eigen::Matrix3d p = Eigen::Matrix3d::Zero();
    double largest = 0.0;
    {
      const rigor::NearestRounding nearest;
      for (int run = 0; run < 4; ++run) {
        const double prior = std::pow(10.0, random.uniform(-9.0, 1.0));
        p = (run == 0 ? 0.0 : prior) * Eigen::Matrix3d::Identity();
        for (int step = 1; step <= 20; ++step) {
          const double m = run == 1 ? 1.0 - radius : random.uniform(1.0 - radius, 1.0 + radius);
          p = textbook_covariance_step(p, m, random.uniform(0.0, 6.3), design);
          const Eigen::Vector3d eigenvalues = oracle::symmetric_eigenvalues(p);
          CHECK(eigenvalues(0) >= range.smallest.lower() * (1.0 - 1e-6));
          if (step >= 2) {
            CHECK(eigenvalues(2) <= range.largest.upper() * (1.0 + 1e-6));
          }
        }
      }
      p = textbook_covariance_step(
          textbook_covariance_step(1e8 * (design.r + design.q1 + design.q2) * Eigen::Matrix3d::Identity(),
                                   1.0 - radius, 0.3, design),
          1.0 - radius, 0.3, design);
      largest = oracle::largest_eigenvalue(p);
    }
    if (design.r < 1e-4 * design.q2) {
      continue;  // double loses the digits of an almost infinite prior
    }
    CHECK(largest ==
          doctest::Approx(theorems::attained_covariance(input.theorem_2_9, Interval(1.0 - radius)).upper())
              .epsilon(1e-3));
  }
}

TEST_CASE("a start covariance that is given lies in the range") {
  const rigor::UpwardRounding upward;
  theorems::TrackerInput input = test::without_leak(test::kTable32[3]);
  rigor::IntervalMatrix<3> start = rigor::IntervalMatrix<3>::Constant(Interval(0.0));
  start(0, 0) = Interval(1e-9);
  start(1, 1) = Interval(2.0);
  start(2, 2) = Interval(3.0);
  input.initial_covariance = start;
  const auto range = theorems::covariance_range(input, Interval(0.125));
  CHECK(range.smallest.upper() <= 1.1e-9);
  CHECK(range.largest.lower() >= 3.0);
}

TEST_CASE("riccati-bounds: the naive forms are refuted for the designs of the thesis, p as printed holds") {
  for (const test::TableRow& row : test::kTable32) {
    CAPTURE(row.figure);
    const auto derivation = theorems::evaluate_riccati_bounds(test::tracker_input(test::table_design(row)));
    CHECK(derivation.id == "riccati-bounds");
    CHECK(test::find_condition(derivation, "naive-matrix").verdict == Verdict::refuted);
    CHECK(test::find_condition(derivation, "naive-number").verdict == Verdict::refuted);
    CHECK(test::find_condition(derivation, "p-printed").verdict == Verdict::proved);
    CHECK(test::find_condition(derivation, "p-errata").verdict == Verdict::proved);
    CHECK(test::find_condition(derivation, "q-printed").verdict == Verdict::proved);
    CHECK(test::find_condition(derivation, "q-errata").verdict == Verdict::proved);
    CHECK(derivation.verdict == Verdict::refuted);
  }
}

TEST_CASE("p of the errata sheet is never refuted: the sheet leaves sigma to be chosen smaller") {
  test::TestDesign design = test::table_design(test::kTable32[0]);
  design.q1 = design.q2 = 40.0 * design.r;
  for (const double sigma : {1e-6, 1e-3, 0.3, 0.7}) {
    design.sigma = sigma;
    const auto derivation = theorems::evaluate_riccati_bounds(test::tracker_input(design));
    const theorems::Condition& condition = test::find_condition(derivation, "p-errata");
    CHECK(condition.verdict == Verdict::undecided);
    CHECK_FALSE(condition.reason.empty());
  }
}

TEST_CASE("riccati-bounds at the corners: no process noise in the signal states, and values unknown") {
  test::TestDesign design = test::table_design(test::kTable32[0]);
  design.q1 = 0.0;
  design.q1_equals_q2 = false;
  const auto derivation = theorems::evaluate_riccati_bounds(test::tracker_input(design));
  CHECK(test::find_condition(derivation, "naive-matrix").verdict != Verdict::refuted);
  CHECK(test::find_condition(derivation, "q-printed").verdict == Verdict::undecided);
  theorems::TrackerInput unknown = test::without_leak(test::kTable32[0]);
  unknown.theorem_2_9.r = Interval::entire();
  for (const theorems::Condition& condition : theorems::evaluate_riccati_bounds(unknown).conditions) {
    CHECK(condition.verdict == Verdict::undecided);
  }
}
