#include "trackers/quadrature/quadrature_ekf.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "tests/trackers/random_tracker.hpp"
#include "tests/trackers/textbook_ekf.hpp"

namespace veritrack::trackers {
namespace {

using test::Random;
using test::random_covariance;
using test::random_design;
using test::random_estimate;
using test::TextbookEkf;

template <typename Real>
TextbookEkf<Real> textbook_of(const ToneModel<double>& design, const QuadratureEstimate<double>& estimate) {
  return {Real(design.q1),
          Real(design.q2),
          Real(design.r),
          Real(design.epsilon),
          estimate.state().template cast<Real>(),
          estimate.covariance.matrix().template cast<Real>()};
}

template <typename Real>
double condition_of(const Eigen::Matrix<Real, 2, 2>& s) {
  const Eigen::Vector2d values = oracle::symmetric_eigenvalues(s.template cast<double>());
  return values(1) / values(0);
}

/// Largest entry of |P - textbook P|, each relative to what its units are: sqrt(P_ii P_jj).
template <typename Real>
double covariance_gap(const Eigen::Matrix3d& p, const Eigen::Matrix<Real, 3, 3>& textbook,
                      const Eigen::Matrix3d& unit) {
  double gap = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double scale = std::sqrt(unit(i, i) * unit(j, j));
      gap = std::max(gap, std::fabs(static_cast<double>(Real(p(i, j)) - textbook(i, j))) / scale);
    }
  }
  return gap;
}

/// Largest entry of |x - textbook x|, relative to the size of state and measurement.
template <typename Real>
double state_gap(const Eigen::Vector3d& x, const Eigen::Matrix<Real, 3, 1>& textbook, double size) {
  const Eigen::Matrix<Real, 3, 1> difference = x.template cast<Real>() - textbook;
  return static_cast<double>(difference.cwiseAbs().maxCoeff()) / size;
}

TEST_CASE("one step is the textbook's step, to 1e-12 times the condition of S, from random estimates") {
  Random random(1);
  const std::int64_t count = test::effort(100000);
  double worst_state = 0.0;
  double worst_covariance = 0.0;
  for (std::int64_t k = 0; k < count; ++k) {
    const auto design = random_design(random);
    const auto start = random_estimate(random);
    const Eigen::Vector2d y(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0));
    auto textbook = textbook_of<double>(design, start);

    QuadratureEkf<double> tracker(design, start);
    tracker.time_update();
    textbook.time_update();
    // The prediction's size before anything cancels in F P F'.
    const Eigen::Vector3d before = start.covariance.matrix().diagonal().cwiseSqrt();
    const double deviation = before(0) + before(1) + start.state().head<2>().norm() * before(2);
    const Eigen::Matrix3d unit =
        Eigen::Vector3d(deviation * deviation + design.q1, deviation * deviation + design.q1,
                        before(2) * before(2) + design.q2)
            .asDiagonal();
    const double size = 1.0 + start.state().norm() + y.norm();
    CHECK(state_gap<double>(tracker.predicted().state(), textbook.x, size) <= 1e-14);
    CHECK(covariance_gap<double>(tracker.predicted().covariance.matrix(), textbook.P, unit) <= 1e-14);

    tracker.measurement_update(y(0), y(1));
    textbook.measurement_update(y);
    const double condition = condition_of<double>(textbook.S);
    // The gain has the units of a covariance ratio, so the frequency moves by up to sqrt(P33 / r) per unit of
    // y.
    const double gain = 1.0 + std::sqrt(unit(2, 2) / design.r);
    worst_state = std::max(
        worst_state, state_gap<double>(tracker.filtered().state(), textbook.x, size * gain) / condition);
    worst_covariance = std::max(
        worst_covariance,
        covariance_gap<double>(tracker.filtered().covariance.matrix(), textbook.P, unit) / condition);
  }
  CAPTURE(worst_state);
  CAPTURE(worst_covariance);
  CHECK(worst_state <= 1e-12);
  CHECK(worst_covariance <= 1e-12);
}

TEST_CASE("a run follows the textbook in extended precision") {
  Random random(2);
  for (int run = 0; run < 100; ++run) {
    const auto design = random_design(random);
    const double frequency = random.uniform(-3.0, 3.0);
    const QuadratureEstimate<double> start{
        1.0, 0.0, frequency, FactoredCovariance<double>::from_matrix(random_covariance(random))};
    QuadratureEkf<double> tracker(design, start);
    auto textbook = textbook_of<long double>(design, start);
    long double phase = 0.0L;
    const std::int64_t steps = test::effort(300);
    for (std::int64_t k = 0; k < steps; ++k) {
      phase += static_cast<long double>(frequency);
      const double in_phase = static_cast<double>(std::cos(phase)) + random.uniform(-0.01, 0.01);
      const double quadrature = static_cast<double>(std::sin(phase)) + random.uniform(-0.01, 0.01);
      tracker.step(in_phase, quadrature);
      textbook.step({static_cast<long double>(in_phase), static_cast<long double>(quadrature)});
      const Eigen::Matrix3d p = tracker.filtered().covariance.matrix();
      REQUIRE(state_gap<long double>(tracker.filtered().state(), textbook.x, 1.0) <= 1e-9);
      REQUIRE(covariance_gap<long double>(p, textbook.P, p) <= 1e-9);
    }
  }
}

TEST_CASE("step is time_update followed by measurement_update") {
  Random random(3);
  for (int k = 0; k < 2000; ++k) {
    const auto design = random_design(random);
    const auto start = random_estimate(random);
    const double in_phase = random.uniform(-2.0, 2.0);
    const double quadrature = random.uniform(-2.0, 2.0);
    QuadratureEkf<double> whole(design, start);
    whole.step(in_phase, quadrature);
    QuadratureEkf<double> parts(design, start);
    parts.time_update();
    parts.measurement_update(in_phase, quadrature);
    CHECK((whole.predicted().state() - parts.predicted().state()).isZero(0.0));
    const Eigen::Matrix3d unit = parts.predicted().covariance.matrix();
    CHECK(covariance_gap<double>(whole.predicted().covariance.matrix(), unit, unit) == 0.0);
    const double gain = 4.0 * (1.0 + std::sqrt(unit(2, 2) / design.r));
    CHECK(state_gap<double>(whole.filtered().state(), parts.filtered().state(), gain) <= 1e-12);
    CHECK(covariance_gap<double>(whole.filtered().covariance.matrix(), parts.filtered().covariance.matrix(),
                                 unit) <= 1e-12);
  }
}

TEST_CASE("the filter commutes with rotations of the plane") {
  Random random(4);
  for (int k = 0; k < 5000; ++k) {
    const auto design = random_design(random);
    const auto start = random_estimate(random);
    const double angle = random.uniform(-3.2, 3.2);
    const double s = std::sin(angle);
    const double c = std::cos(angle);
    const double y1 = random.uniform(-2.0, 2.0);
    const double y2 = random.uniform(-2.0, 2.0);
    const auto turned_after = turned(step(start, y1, y2, design).filtered, s, c);
    const auto turned_before = step(turned(start, s, c), c * y1 - s * y2, s * y1 + c * y2, design).filtered;
    const Eigen::Matrix3d unit = start.covariance.matrix();
    const double gain = 4.0 * (1.0 + std::sqrt(unit(2, 2) / design.r));
    CHECK(state_gap<double>(turned_after.state(), turned_before.state(), gain) <= 1e-12);
    // `turned` against U P U'.
    Eigen::Matrix3d u;
    u << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
    const Eigen::Matrix3d expected = u * unit * u.transpose();
    CHECK((turned(start, s, c).covariance.matrix() - expected).norm() <= 1e-14 * unit.norm());
  }
}

TEST_CASE("factors and matrix are the same covariance") {
  Random random(5);
  for (int k = 0; k < 5000; ++k) {
    const Eigen::Matrix3d p = random_covariance(random);
    const auto factors = FactoredCovariance<double>::from_matrix(p);
    CHECK(covariance_gap<double>(factors.matrix(), p, p) <= 1e-15);
    CHECK(factors.matrix() == factors.matrix().transpose());
  }
  const auto nothing = FactoredCovariance<double>::from_matrix(Eigen::Matrix3d::Zero());
  CHECK(nothing.matrix() == Eigen::Matrix3d::Zero());
}

TEST_CASE("a start without any doubt is left alone by the first measurement and then doubted by Q") {
  const ToneModel<double> design{0.01, 0.02, 0.5, 0.1};
  QuadratureEkf<double> tracker(
      design, {1.0, 0.0, 0.3, FactoredCovariance<double>::from_matrix(Eigen::Matrix3d::Zero())});
  tracker.measurement_update(5.0, 5.0);
  CHECK(tracker.filtered().state() == Eigen::Vector3d(1.0, 0.0, 0.3));
  tracker.time_update();
  CHECK((tracker.predicted().covariance.matrix() -
         Eigen::Vector3d(0.01, 0.01, 0.02).asDiagonal().toDenseMatrix())
            .norm() <= 1e-17);
}

TEST_CASE("from P(0) as good as infinite the second measurement leaves P33 = 2r + q1 + q2") {
  // By hand: the first measurement leaves P_zz = r I and P33 = infinity; the frequency then is the difference
  // of two measurements with the noise of both, q1 and q2 between them. A covariance stored as a plain matrix
  // has lost this at 1e18.
  for (const double huge : {1e6, 1e12, 1e18, 1e30}) {
    const ToneModel<double> design{0.0023, 0.0065, 0.05, 0.0};
    QuadratureEkf<double> tracker(
        design, {1.0, 0.0, 0.3, FactoredCovariance<double>::from_matrix(huge * Eigen::Matrix3d::Identity())});
    tracker.measurement_update(1.0, 0.0);
    tracker.step(std::cos(0.3), std::sin(0.3));
    CHECK(tracker.filtered().frequency == doctest::Approx(0.3).epsilon(1e-9));
    const double expected = 2.0 * design.r + design.q1 + design.q2;
    const double p33 = tracker.filtered().covariance.frequency_variance;
    CHECK(std::fabs(p33 - expected) <= 1e-12 * expected + 2.0 / huge);
  }
}

/// Positive definite by its leading minors, in extended precision.
bool is_positive_definite(const Eigen::Matrix3d& p) {
  const Eigen::Matrix<long double, 3, 3> m = p.cast<long double>();
  return m(0, 0) > 0.0L && m.topLeftCorner<2, 2>().determinant() > 0.0L && m.determinant() > 0.0L;
}

TEST_CASE("P stays symmetric and positive definite over ten million steps") {
  struct Run {
    ToneModel<double> design;
    double initial_variance;
    std::int64_t steps;
  };
  const std::array<Run, 7> runs{{
      {{0.0023, 0.0023, 0.05, 0.0}, 1.0, 10000000},   // Table 3.2, Figure 3.5, without the leak
      {{0.0005, 0.0005, 0.01, 0.05}, 1e18, 1000000},  // Figure 3.2, from nothing known
      {{1e-18, 1e-18, 1.0, 0.0}, 1e12, 1000000},      // a nearly frozen filter
      {{0.0, 1e-9, 0.05, 0.0}, 1.0, 1000000},         // q1 = 0: the amplitude's variance decays like 1/k
      {{1e-12, 1e3, 1e-6, 0.01}, 1e-20, 1000000},     // a wild frequency
      {{1e6, 1e-14, 1e-12, 0.0}, 1e30, 1000000},      // measurements trusted blindly
      {{1e-20, 1e-20, 1e6, 0.999}, 1e-30, 1000000},   // measurements hardly believed
  }};
  for (const Run& run : runs) {
    Random random(6);
    QuadratureEkf<double> tracker(
        run.design,
        {1.0, 0.0, 0.7,
         FactoredCovariance<double>::from_matrix(run.initial_variance * Eigen::Matrix3d::Identity())});
    double in_phase = 1.0;
    double quadrature = 0.0;
    const double c = std::cos(0.7);
    const double s = std::sin(0.7);
    bool factors_positive = true;
    bool matrix_positive = true;
    bool symmetric = true;
    for (std::int64_t k = 0; k < run.steps; ++k) {
      const double turned_in_phase = c * in_phase - s * quadrature;
      quadrature = s * in_phase + c * quadrature;
      in_phase = turned_in_phase;
      tracker.step(in_phase + random.uniform(-0.1, 0.1), quadrature + random.uniform(-0.1, 0.1));
      const FactoredCovariance<double>& p = tracker.filtered().covariance;
      // Never the negation of a comparison: NaN must fail.
      factors_positive = factors_positive && p.frequency_variance > 0.0 && p.conditional_11 > 0.0 &&
                         p.conditional_11 * p.conditional_22 > p.conditional_12 * p.conditional_12;
      if (k % 1000 == 0) {
        const Eigen::Matrix3d filtered = p.matrix();
        const Eigen::Matrix3d predicted = tracker.predicted().covariance.matrix();
        symmetric = symmetric && filtered == filtered.transpose() && predicted == predicted.transpose();
        matrix_positive = matrix_positive && is_positive_definite(filtered);
      }
    }
    CAPTURE(run.design.q1);
    CAPTURE(run.design.r);
    CHECK(factors_positive);
    CHECK(symmetric);
    CHECK(matrix_positive);
    CHECK(tracker.filtered().state().allFinite());
  }
}

}  // namespace
}  // namespace veritrack::trackers
