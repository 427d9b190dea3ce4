#include "analysis/quadrature/gaussian/level_step.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>

#include "tests/analysis/quadrature/gaussian/lock_sets.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

Eigen::Matrix3d whole(const SymmetricMatrix<double>& x) {
  Eigen::Matrix3d m;
  m << x[0][0], x[1][0], x[2][0], x[1][0], x[1][1], x[2][1], x[2][0], x[2][1], x[2][2];
  return m;
}

LockSetting<double> some_setting(double epsilon = 0.0) {
  LockSet set = test_sets::lock_set(0, 20.0);
  trackers::ToneModel<double> design = test_sets::kDesigns[0];
  design.epsilon = epsilon;
  if (epsilon != 0.0) {
    for (LevelCovariance<double>* p : {&set.centre, &set.spread_above, &set.spread_below}) {
      p->p12 = 0.2 * std::sqrt(p->p11 * p->p22);
      p->p13 = -0.1 * std::sqrt(p->p11 * p->p33);
      p->apart = false;
    }
  }
  return {design,
          set.metric,
          set.centre,
          inverse(set.centre),
          set.spread_above,
          set.spread_below,
          set.weight,
          set.noise_deviation,
          set.noise_deviation * set.noise_deviation,
          0.0};
}

std::array<double, 3> some_errors(test::Random& random) {
  return {random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), random.uniform(-0.5, 0.5)};
}

}  // namespace

TEST_CASE("the image of a covariance is that of the tracker's map, and its mean error too") {
  test::Random random(4301);
  for (int k = 0; k < 500; ++k) {
    const LockSetting<double> setting = some_setting(k % 2 == 0 ? 0.0 : random.uniform(0.0, 0.5));
    const std::array<double, 3> e = some_errors(random);
    const LevelCovariance<double> p = upper_covariance(setting, random.uniform(0.0, 3.0));
    const auto image = covariance_image(setting.design, p, setting.spread_above, e);
    trackers::RotatingFrameState<double> state;
    state << e[0], e[1], e[2], p.p11, p.p12, p.p13, p.p22, p.p23, p.p33;
    const auto next = trackers::rotating_frame_map(state, {0.0, 0.0, 0.0, 0.0}, setting.design);
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(std::fabs(image.mean[i] - next(static_cast<Eigen::Index>(i))) < 1e-13);
    }
    Eigen::Matrix3d expected;
    expected << next(3), next(4), next(5), next(4), next(6), next(7), next(5), next(7), next(8);
    CHECK((whole(image.covariance) - expected).norm() < 1e-15);
  }
}

TEST_CASE("the slope of an image is its derivative along the covariance") {
  test::Random random(4302);
  for (int k = 0; k < 200; ++k) {
    const LockSetting<double> setting = some_setting(k % 2 == 0 ? 0.0 : random.uniform(0.0, 0.5));
    const std::array<double, 3> e = some_errors(random);
    const double s = random.uniform(0.1, 3.0);
    const double h = 1e-4;
    const auto at = [&](double level) {
      const LevelCovariance<double> low = lower_covariance(setting, level);
      return std::pair{
          covariance_image(setting.design, low, lower_slope(low, setting.spread_below), e),
          covariance_image(setting.design, upper_covariance(setting, level), setting.spread_above, e)};
    };
    const auto [low, high] = at(s);
    const auto [low_before, high_before] = at(s - h);
    const auto [low_after, high_after] = at(s + h);
    const Eigen::Matrix3d of_low = (whole(low_after.covariance) - whole(low_before.covariance)) / (2.0 * h);
    const Eigen::Matrix3d of_high =
        (whole(high_after.covariance) - whole(high_before.covariance)) / (2.0 * h);
    CHECK((whole(low.slope) - of_low).norm() < 1e-9);
    CHECK((whole(high.slope) - of_high).norm() < 1e-9);
  }
}

TEST_CASE("with a leak a step is that of the tracker's map at its frequency, about the errors e_0") {
  test::Random random(4304);
  for (int k = 0; k < 500; ++k) {
    LockSetting<double> setting = some_setting(random.uniform(0.0, 0.1));
    setting.frequency = random.uniform(-3.0, 3.0);
    for (double& error : setting.bias) {
      error = random.uniform(-0.1, 0.1);
    }
    std::array<double, 3> u{};
    for (double& coordinate : u) {
      coordinate = random.uniform(-5.0, 5.0);
    }
    const double s = random.uniform(0.0, 3.0);
    const LevelStep<double> step = level_step(setting, u, s);
    const std::array<double, 3> e = errors_of(setting.metric, u);
    const auto next_of = [&](const LevelCovariance<double>& p) {
      trackers::RotatingFrameState<double> state;
      state << e[0] + setting.bias[0], e[1] + setting.bias[1], e[2] + setting.bias[2], p.p11, p.p12, p.p13,
          p.p22, p.p23, p.p33;
      return trackers::rotating_frame_map(state, {0.0, 0.0, 0.0, setting.frequency}, setting.design);
    };
    const auto low = next_of(lower_covariance(setting, s));
    const auto high = next_of(upper_covariance(setting, s));
    for (std::size_t i = 0; i < 3; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      CHECK(std::fabs(step.lower.mean[i] - (low(row) - setting.bias[i])) < 1e-13);
      CHECK(std::fabs(step.upper.mean[i] - (high(row) - setting.bias[i])) < 1e-13);
    }
    CHECK(std::fabs(step.lower.covariance[2][2] - low(8)) < 1e-15);
    CHECK(std::fabs(step.upper.covariance[2][2] - high(8)) < 1e-15);
  }
}

TEST_CASE("tangents along the level bound the images: from above those of hi, from below those of lo") {
  test::Random random(4303);
  for (int k = 0; k < 500; ++k) {
    const LockSetting<double> setting = some_setting(k % 2 == 0 ? 0.0 : random.uniform(0.0, 0.5));
    const std::array<double, 3> e = some_errors(random);
    const std::array<double, 3> u{e[0] * setting.metric.amplitude,
                                  e[1] * setting.metric.phase + e[2] * setting.metric.coupling,
                                  e[2] * setting.metric.frequency};
    const double s = random.uniform(0.0, 3.0);
    const double other = random.uniform(0.0, 3.0);
    const LevelStep<double> step = level_step(setting, u, s);
    const LevelStep<double> there = level_step(setting, u, other);
    const auto tangent = [&](const LevelImage<double>& image) {
      return whole(moved(image.covariance, other - s, image.slope));
    };
    CHECK(oracle::least_eigenvalue(tangent(step.upper) - whole(there.upper.covariance)) > -1e-15);
    CHECK(oracle::least_eigenvalue(whole(there.lower.covariance) - tangent(step.lower)) > -1e-15);
    CHECK(oracle::least_eigenvalue(whole(there.upper.covariance) - whole(there.lower.covariance)) > -1e-15);
  }
}

}  // namespace veritrack::quadrature
