// The checker's own step of the tracker against the tracker that runs.
#include "checker/quadrature/step.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"

namespace {

using namespace veritrack;
using checker::Ball;

/// A covariance without correlation between the amplitude and the rest.
checker::Covariance<Ball> random_block_covariance(test::Random& random) {
  const double a = random.uniform(0.01, 0.2);
  const double b = random.uniform(0.01, 0.2);
  return {Ball(random.uniform(0.01, 0.2)), Ball(a), Ball(random.uniform(-0.9, 0.9) * std::sqrt(a * b)),
          Ball(b)};
}

trackers::PolarCovariance<double> in_double(const checker::Covariance<Ball>& p) {
  return {p.p11.near(), 0.0, 0.0, p.p22.near(), p.p23.near(), p.p33.near()};
}

void check_ball_close(const Ball& found, double expected) {
  CHECK(std::fabs(found.near() - expected) <= 1e-11 * (1.0 + std::fabs(expected)));
}

}  // namespace

TEST_CASE("errors, noise and covariance move as in the tracker") {
  test::Random random(71);
  for (std::int64_t i = 0; i < test::effort(2000); ++i) {
    CAPTURE(i);
    checker::Setting setting;
    const trackers::ToneModel<double> design{random.uniform(1e-4, 0.01), random.uniform(1e-4, 0.01),
                                             random.uniform(0.01, 0.2), 0.0};
    setting.q1 = Ball(design.q1);
    setting.q2 = Ball(design.q2);
    setting.r = Ball(design.r);
    setting.lower = setting.upper = random_block_covariance(random);
    const trackers::PolarFrameState<double> state{
        {random.uniform(-0.4, 0.4), random.uniform(-0.5, 0.5), random.uniform(-0.3, 0.3)},
        in_double(setting.lower)};
    const trackers::PolarInput<double> input{random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.0, 0.0};
    const trackers::PolarFrameState<double> next = trackers::polar_frame_map(state, input, design);

    const Ball a(state.error.amplitude);
    const Ball chi(state.error.phase + state.error.frequency);
    const checker::Correction<Ball> c = checker::correction(setting, a, chi);
    const auto innovation = c.innovation(a, chi);
    const Ball along = (c.k1 - Ball(1.0)) * innovation[0];
    const Ball across = (c.k2 - Ball(1.0)) * innovation[1];
    const checker::Secant<Ball> left = checker::secant(c.signal, c.mean);
    // Noise moves the corrected estimate by K v.
    const Ball moved_along = c.k1 * Ball(input.noise_along);
    const Ball moved_across = c.k2 * Ball(input.noise_across);
    const checker::Secant<Ball> moved =
        checker::secant(c.mean, {c.mean[0] + moved_along, c.mean[1] + moved_across});
    check_ball_close(left.length[0] * along + left.length[1] * across + moved.length[0] * moved_along +
                         moved.length[1] * moved_across,
                     next.error.amplitude);
    check_ball_close(left.angle[0] * along + left.angle[1] * across + moved.angle[0] * moved_along +
                         moved.angle[1] * moved_across,
                     next.error.phase);
    check_ball_close(Ball(state.error.frequency) + c.k3 * (innovation[1] + Ball(input.noise_across)),
                     next.error.frequency);

    const checker::Update<Ball> update = checker::update(setting, setting.lower, a + Ball(1.0));
    const auto predicted =
        trackers::predicted_covariance(state.covariance, 1.0 + state.error.amplitude, design);
    const auto filtered =
        trackers::filtered_covariance(predicted, trackers::gain(predicted, design.r), design.r);
    check_ball_close(update.filtered.p11, filtered.p11);
    check_ball_close(update.filtered.p22, filtered.p22);
    check_ball_close(update.filtered.p23, filtered.p23);
    check_ball_close(update.filtered.p33, filtered.p33);
  }
}

TEST_CASE("derivatives are those of finite differences") {
  test::Random random(72);
  checker::Setting setting;
  setting.q1 = setting.q2 = Ball(0.0023);
  setting.r = Ball(0.05);
  setting.lower = {Ball(0.01), Ball(0.02), Ball(0.005), Ball(0.01)};
  setting.upper = {Ball(0.02), Ball(0.03), Ball(0.007), Ball(0.02)};
  for (std::int64_t i = 0; i < test::effort(200); ++i) {
    CAPTURE(i);
    const double a = random.uniform(-0.3, 0.3);
    const double chi = random.uniform(-0.8, 0.8);
    const double step = 0x1p-40;
    const auto at = [&](double x, double y) {
      const auto c = checker::correction(setting, Ball(x), Ball(y));
      return checker::secant(c.signal, c.mean).angle[0];
    };
    const auto slope = checker::correction(setting, checker::Slope::variable(Ball(a), 0),
                                           checker::Slope::variable(Ball(chi), 1));
    const checker::Slope angle = checker::secant(slope.signal, slope.mean).angle[0];
    const Ball over(0.5 / step);
    CHECK(std::fabs((angle.along[0] - over * (at(a + step, chi) - at(a - step, chi))).near()) < 1e-9);
    CHECK(std::fabs((angle.along[1] - over * (at(a, chi + step) - at(a, chi - step))).near()) < 1e-9);
  }
}
