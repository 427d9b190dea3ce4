#include "analysis/model/step/point_tube.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>

#include "tests/analysis/model/tube_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

PhaseSeries point_series(test::Random& random) {
  PhaseSeries series;
  for (std::size_t h = 0; h < 1 + random.below(5); ++h) {
    series.coefficients.emplace_back();
    for (std::size_t d = 0; d < random.below(4); ++d) {
      series.coefficients.back().emplace_back(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    }
  }
  return series;
}

/// Two states, of which the second turns twice as fast as the phase.
Tube tube_of_points(test::Random& random) {
  Tube tube;
  tube.frequency = 0.5;
  tube.half_width = 0.25;
  tube.turns = {0, 2};
  tube.curve = {point_series(random), point_series(random)};
  tube.shape = {point_series(random), point_series(random), point_series(random)};
  return tube;
}

/// Re sum_h sum_d c_hd z^d exp(i h phi), in long double.
double exact_value(const PhaseSeries& series, long double z, long double phase) {
  long double sum = 0.0L;
  for (std::size_t h = 0; h < series.coefficients.size(); ++h) {
    for (std::size_t d = 0; d < series.coefficients[h].size(); ++d) {
      const std::complex<long double> c(series.coefficients[h][d]);
      const long double angle = static_cast<long double>(h) * phase;
      sum += (c.real() * std::cos(angle) - c.imag() * std::sin(angle)) *
             std::pow(z, static_cast<long double>(d));
    }
  }
  return static_cast<double>(sum);
}

TEST_CASE("a frame has the values of the tube's series, at any frequency it is moved to") {
  test::Random random(64);
  for (int trial = 0; trial < 50; ++trial) {
    const Tube tube = tube_of_points(random);
    PointTube points(tube, 0.5);
    for (int move = 0; move < 4; ++move) {
      const double z = random.uniform(-1.0, 1.0);
      points.move_to(0.5 + 0.25 * z);
      const double phase = random.uniform(-10.0, 10.0);
      PointFrame frame;
      points.at(phase, frame);
      CHECK(frame.curve[0] == doctest::Approx(exact_value(tube.curve[0], z, phase)).epsilon(1e-12));
      CHECK(frame.curve[1] ==
            doctest::Approx(2.0 * phase + exact_value(tube.curve[1], z, phase)).epsilon(1e-12));
      CHECK(frame.shape(0, 0) == doctest::Approx(exact_value(tube.shape[0], z, phase)).epsilon(1e-12));
      CHECK(frame.shape(1, 0) == doctest::Approx(exact_value(tube.shape[1], z, phase)).epsilon(1e-12));
      CHECK(frame.shape(1, 1) == doctest::Approx(exact_value(tube.shape[2], z, phase)).epsilon(1e-12));
      CHECK(frame.shape(0, 1) == 0.0);
      CHECK(frame.covariance.size() == 0);
    }
  }
}

TEST_CASE("coordinates are those of the state, and the state is that of the coordinates") {
  PointFrame frame;
  frame.curve = Eigen::Vector2d(1.0, -2.0);
  frame.shape = Eigen::Matrix2d{{2.0, 0.0}, {-1.0, 0.5}};
  const Eigen::VectorXd state = frame.state(Eigen::Vector2d(0.25, -3.0));
  CHECK(state[0] == 1.5);    // 1 + 2/4
  CHECK(state[1] == -3.75);  // -2 - 1/4 - 3/2
  CHECK(frame.coordinates(state) == Eigen::Vector2d(0.25, -3.0));
}

TEST_CASE(
    "of a tube that bounds a covariance the frame has the middle and half the difference of the bounds") {
  test::Random random(65);
  Tube tube = tube_of_points(random);
  tube.covariance_low = {point_series(random), point_series(random), point_series(random)};
  tube.covariance_high = {point_series(random), point_series(random), point_series(random)};
  constexpr double kZ = 0.375, kPhase = 1.25;
  const PointTube points(tube, 0.5 + 0.25 * kZ);
  PointFrame frame;
  points.at(kPhase, frame);
  const std::array<std::pair<int, int>, 3> places{{{0, 0}, {1, 0}, {1, 1}}};
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double low = exact_value(tube.covariance_low[k], kZ, kPhase);
    const double high = exact_value(tube.covariance_high[k], kZ, kPhase);
    const auto [i, j] = places[k];
    CHECK(frame.covariance(i, j) == doctest::Approx(0.5 * (low + high)).epsilon(1e-12));
    CHECK(frame.covariance(j, i) == frame.covariance(i, j));
    CHECK(frame.spread(i, j) == doctest::Approx(0.5 * (high - low)).epsilon(1e-12));
    CHECK(frame.spread(j, i) == frame.spread(i, j));
  }
}

TEST_CASE("a tracker at points: samples at an amplitude of the range, and the step of its formula") {
  test::Example loop(test::phase_locked_loop());
  loop.model.amplitude = rigor::Interval::from_bounds(0.5, 1.5);
  PointTracker tracker(loop.model);
  CHECK(tracker.states() == 2);
  CHECK(tracker.channels() == 1);
  for (const double phase : {0.0, 0.7, 4.0}) {
    CHECK(tracker.samples(phase)[0] == doctest::Approx(std::cos(phase)));
    CHECK(tracker.samples(phase, 0.0)[0] == doctest::Approx(0.5 * std::cos(phase)));
    CHECK(tracker.samples(phase, 1.0)[0] == doctest::Approx(1.5 * std::cos(phase)));
  }
  // e = -y sin theta; w' = w + ki e; theta' = theta + w + kp e.
  const double ki = loop.tracker.constants[0], kp = loop.tracker.constants[1];
  const double w = 0.3, theta = 1.0, y = 0.75;
  const double e = -y * std::sin(theta);
  const Eigen::VectorXd next = tracker.next(Eigen::Vector2d(w, theta), Eigen::VectorXd::Constant(1, y));
  CHECK(next[0] == doctest::Approx(w + ki * e));
  CHECK(next[1] == doctest::Approx(theta + w + kp * e));
  CHECK(tracker.frequency(next) == next[0]);
  PointFrame frame;
  frame.curve = Eigen::Vector2d(1.0, 2.0);
  frame.shape = Eigen::Matrix2d::Identity();
  CHECK(tracker.state(frame, Eigen::Vector2d(0.5, -0.5)) == Eigen::Vector2d(1.5, 1.5));
}

}  // namespace
}  // namespace veritrack::model
