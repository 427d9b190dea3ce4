// The checker's step about the steady state of the tracker with a leak against the tracker that runs.
#include "checker/quadrature/steady_step.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "checker/quadrature/steady_state.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"

namespace {

using namespace veritrack;
using checker::Ball;
using TrackerCovariance = trackers::PolarCovariance<double>;
using Errors = std::array<double, 3>;

TrackerCovariance in_double(const checker::Symmetric<Ball>& p) {
  return {p[0].near(), p[1].near(), p[2].near(), p[3].near(), p[4].near(), p[5].near()};
}
std::array<double, 6> entries(const TrackerCovariance& p) {
  return {p.p11, p.p12, p.p13, p.p22, p.p23, p.p33};
}

/// T e.
Errors image(const checker::TriangularMetric& t, const Errors& e) {
  const auto result = t.image<Ball>(Ball(e[0]), Ball(e[1]), Ball(e[2]));
  return {result[0].near(), result[1].near(), result[2].near()};
}

void check_close(double found, double expected) {
  CHECK(std::fabs(found - expected) <= 1e-6 * (1.0 + std::fabs(expected)));
}

}  // namespace

TEST_CASE("a step about the steady state is the tracker's") {
  test::Random random(79);
  for (std::int64_t trial = 0; trial < test::effort(6); ++trial) {
    CAPTURE(trial);
    const trackers::ToneModel<double> tracker{random.uniform(1e-3, 0.01), random.uniform(1e-3, 0.01),
                                              random.uniform(0.01, 0.05), random.uniform(0.005, 0.03)};
    const double omega = random.uniform(0.2, 1.0);
    checker::Design design;
    design.q1 = Ball(tracker.q1);
    design.q2 = Ball(tracker.q2);
    design.r = Ball(tracker.r);
    design.epsilon = Ball(tracker.epsilon);
    design.lowest_frequency = design.highest_frequency = Ball(omega);
    const auto branch = checker::steady_branch(design, 0.3, 1e-4);
    REQUIRE(branch);
    const checker::StateVector at = branch->front().at(Ball(omega));

    checker::SteadyPlace<Ball> place;
    std::copy_n(at.begin(), 3, place.steady.error.begin());
    std::copy(at.begin() + 3, at.end(), place.steady.covariance.begin());
    const TrackerCovariance steady = in_double(place.steady.covariance);
    for (int point = 0; point < 20; ++point) {
      CAPTURE(point);
      const double level = random.uniform(0.1, 1.0);
      // One covariance, so that all gains are the mean one.
      checker::SteadySetting setting;
      setting.q1 = design.q1;
      setting.q2 = design.q2;
      setting.r = design.r;
      setting.retention = Ball(1.0) - design.epsilon;
      setting.metric = {Ball(random.uniform(0.5, 2.0)),  Ball(random.uniform(-1.0, 1.0)),
                        Ball(random.uniform(-1.0, 1.0)), Ball(random.uniform(0.5, 2.0)),
                        Ball(random.uniform(-1.0, 1.0)), Ball(random.uniform(0.5, 2.0))};
      std::array<double, 6> shift{};
      for (std::size_t i = 0; i < shift.size(); ++i) {
        shift[i] = random.uniform(-0.2, 0.2) * steady.p33;
        setting.above[i] = Ball(shift[i]);
        setting.below[i] = Ball(-shift[i]);
      }
      setting.set_directions();
      place.level = Ball(level);
      place.x = Ball(random.uniform(-0.1, 0.1));
      place.y = Ball(random.uniform(-0.1, 0.1));
      const Ball t(random.uniform(-0.1, 0.1));
      const double alpha = (setting.a11 * place.x).near();
      const double chi = (setting.a21 * place.x + setting.a22 * place.y).near();
      const double frequency = (setting.m1 * place.x + setting.m2 * place.y + setting.m3 * t).near();
      const auto step = checker::steady_step(setting, place);
      const auto deviation = checker::turned_deviation(step.high, checker::deviation_turn(place, step.turn));

      const Errors b{alpha, chi - frequency, frequency};
      const auto after = [&](double along, double across) {
        const trackers::PolarFrameState<double> state{
            {at[0].near() + level * b[0], at[1].near() + level * b[1], at[2].near() + level * b[2]},
            {steady.p11 + level * shift[0], steady.p12 + level * shift[1], steady.p13 + level * shift[2],
             steady.p22 + level * shift[3], steady.p23 + level * shift[4], steady.p33 + level * shift[5]}};
        return trackers::polar_frame_map(state, {along, across, 0.0, omega}, tracker);
      };
      const auto moved = [&](const trackers::PolarFrameState<double>& next) {
        return image(setting.metric, {(next.error.amplitude - at[0].near()) / level,
                                      (next.error.phase - at[1].near()) / level,
                                      (next.error.frequency - at[2].near()) / level});
      };
      const trackers::PolarFrameState<double> next = after(0.0, 0.0);
      const Errors expected = moved(next);
      const std::array<Ball, 3> hidden = setting.hidden();
      for (std::size_t i = 0; i < 3; ++i) {
        check_close((step.moved[i] + t * hidden[i]).near(), expected[i]);
      }
      // |T b| is that of (x, y, t): a basis of unit vectors.
      const Errors from = image(setting.metric, b);
      const Ball length = square(place.x) + square(place.y) + square(t);
      check_close(from[0] * from[0] + from[1] * from[1] + from[2] * from[2], length.near());
      const std::array<double, 6> found = entries(next.covariance);
      const std::array<double, 6> base = entries(steady);
      for (std::size_t i = 0; i < found.size(); ++i) {
        check_close(deviation[i].near(), (found[i] - base[i]) / level);
        CHECK(std::fabs(step.spread[i].near()) < 1e-12);
      }
      // Noise, to first order.
      constexpr double kSmall = 1e-6;
      const std::array<Errors, 2> pushed{moved(after(kSmall, 0.0)), moved(after(0.0, kSmall))};
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 2; ++j) {
          const double by_noise = level * (pushed[j][i] - expected[i]) / kSmall;
          CHECK(std::fabs(step.noise[i][j].near() - by_noise) <= 1e-3 * (1.0 + std::fabs(by_noise)));
        }
      }
    }
  }
}
