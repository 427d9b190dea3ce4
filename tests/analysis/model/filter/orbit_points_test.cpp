#include "analysis/model/filter/orbit_points.hpp"

#include <doctest/doctest.h>

#include "tests/analysis/model/filter/filter_examples.hpp"

namespace veritrack::model::detail {
namespace {

constexpr double kRadiusAround = 0.25;
constexpr double kPlaceAround = -0.5;

/// A tube whose shape alone is read.
Tube tube_around() {
  Tube tube;
  tube.frequency = 0.7;
  tube.half_width = 0.01;
  tube.curve.resize(2);
  tube.shape = {
      {{{0.5, 0.0625}, {}, {0.0625}}}, {{{0.25}, {{0.0, 0.0625}, 0.125}}}, {{{1.5}, {{0.125, -0.5}}}}};
  return tube;
}

Eigen::VectorXd estimate_on_curve(const NodeCurve& curve, double phase) {
  return Eigen::Vector2d(test::summed(curve.harmonics, 0, phase), test::summed(curve.harmonics, 1, phase));
}

bool are_near(const MatrixXd& a, const MatrixXd& b, double error = 1e-13) {
  return a.rows() == b.rows() && a.cols() == b.cols() && (a - b).cwiseAbs().maxCoeff() < error;
}

bool are_same(const OrbitPoint& a, const OrbitPoint& b) {
  return a.phase == b.phase && a.estimate == b.estimate && a.covariance == b.covariance &&
         a.slope == b.slope && a.innovation == b.innovation && a.correction == b.correction &&
         a.wide == b.wide && a.move == b.move;
}

TEST_CASE("a matrix of series is the sum of their terms, symmetric or lower triangular") {
  const Tube tube = tube_around();
  const test::PointTube points(tube);
  for (const double phase : {0.0, 0.4, 2.9}) {
    for (const double z : {-1.0, 0.25}) {
      const MatrixXd lower = points.shape(phase, tube.frequency + z * tube.half_width);
      CHECK(are_near(matrix_at(tube.shape, phase, z, false), lower));
      MatrixXd symmetric = lower;
      symmetric(0, 1) = lower(1, 0);
      CHECK(are_near(matrix_at(tube.shape, phase, z, true), symmetric));
    }
  }
}

TEST_CASE(
    "a sample of an orbit has the curve's estimate and covariance, and the filter's derivatives there") {
  for (const bool is_given : {false, true}) {
    CAPTURE(is_given);
    test::BentFilter bent;
    bent.gives_jacobian = is_given;
    const test::ExampleFilter filter = bent.filter();
    const TrackedTone tone = test::tone_of(filter);
    const NodeCurve curve = test::BentFilter::written_curve();
    const Tube tube = tube_around();
    const Eigen::MatrixXcd slope = 2.0 * curve.harmonics;
    OrbitWalk walk(tone, curve, {&tube, kRadiusAround, kPlaceAround}, &slope);
    constexpr double kPhase = 0.4;
    const OrbitPoint point = walk.first(kPhase);
    const Eigen::Vector2d x = estimate_on_curve(curve, kPhase);
    CHECK(point.phase == kPhase);
    CHECK(are_near(point.estimate, x));
    const double across = test::summed(curve.harmonics, 3, kPhase);
    CHECK(are_near(point.covariance, Eigen::Matrix2d{{test::summed(curve.harmonics, 2, kPhase), across},
                                                     {across, test::summed(curve.harmonics, 4, kPhase)}}));
    CHECK(are_near(point.gradient, Eigen::RowVector2d(1.0, 0.5)));
    CHECK(are_near(point.jacobian, bent.jacobian(x)));
    CHECK(are_near(point.slope, bent.slope(x), 1e-9));
    CHECK(are_near(point.predicted, bent.next(x)));
    REQUIRE(point.changes.size() == 2);
    REQUIRE(point.changes_of_slope.size() == (is_given ? 2 : 0));
    for (int j = 0; j < 2; ++j) {
      const Eigen::Vector2d moved = x + Eigen::Vector2d::Unit(j);
      const auto place = static_cast<std::size_t>(j);
      CHECK(are_near(point.changes[place], bent.jacobian(moved) - bent.jacobian(x), 1e-9));
      if (is_given) {
        CHECK(are_near(point.changes_of_slope[place], bent.slope(moved) - bent.slope(x), 1e-5));
      }
    }
    const Eigen::Vector2d direction(0.3, -0.7);
    CHECK(are_near(change_along(point.changes, direction), bent.jacobian(x + direction) - bent.jacobian(x),
                   1e-9));
    CHECK(are_near(point.wide, kRadiusAround * matrix_at(tube.shape, kPhase, kPlaceAround, false)));
    CHECK(are_near(point.move, 2.0 * x));
    CHECK(OrbitWalk(tone, curve, {}, nullptr).first(kPhase).wide.size() == 0);
    CHECK(OrbitWalk(tone, curve, {}, nullptr).first(kPhase).move.size() == 0);
  }
}

TEST_CASE("the next sample's correction is what the innovation makes, as nearly as it can") {
  const test::BentFilter bent;
  const test::ExampleFilter filter = bent.filter();
  const TrackedTone tone = test::tone_of(filter);
  const NodeCurve curve = test::BentFilter::written_curve();
  OrbitWalk walk(tone, curve, {}, nullptr);
  const OrbitPoint before = walk.first(0.3);
  const OrbitPoint after = walk.after(before);
  CHECK(after.phase == doctest::Approx(1.0));
  const Eigen::Vector2d correction = estimate_on_curve(curve, 1.0) - bent.next(estimate_on_curve(curve, 0.3));
  CHECK(are_near(after.correction, correction));
  // One channel: the least of |K y - correction|.
  const Eigen::Vector2d gain = after.covariance * bent.measured().transpose() / bent.r;
  REQUIRE(after.innovation.size() == 1);
  CHECK(after.innovation[0] == doctest::Approx(gain.dot(correction) / gain.squaredNorm()));
}

TEST_CASE("the first 128 samples of an orbit are those that are computed one after the other") {
  const test::BentFilter bent;
  const test::ExampleFilter filter = bent.filter();
  const TrackedTone tone = test::tone_of(filter);
  const NodeCurve curve = test::BentFilter::written_curve();
  const OrbitPoints points(tone, curve, 0.3);
  OrbitWalk walk(tone, curve, {}, nullptr);
  OrbitPoint point = walk.first(0.3);
  for (std::size_t i = 0; i < 128; ++i) {
    REQUIRE(points.find(i) != nullptr);
    CHECK(are_same(*points.find(i), point));
    point = walk.after(point);
  }
  CHECK(points.find(128) == nullptr);
}

}  // namespace
}  // namespace veritrack::model::detail
