#include "analysis/model/filter/filter_orbit.hpp"

#include <doctest/doctest.h>

#include "tests/analysis/model/filter/filter_examples.hpp"
#include "tests/support/oracles.hpp"

namespace veritrack::model::detail {
namespace {

FilterParameters parameters_of(Index states, double process) {
  FilterParameters parameters;
  parameters.eta = 0.2;
  parameters.theta = 0.15;
  parameters.lambda = 0.8;
  parameters.source = 0.02;
  parameters.spread = 0.03;
  parameters.process = VectorXd::Constant(states, process);
  return parameters;
}

TEST_CASE("a linear scalar filter's bounds and shape settle where their equations say") {
  const test::ScalarFilter scalar{.a = 0.95, .h = 1.3};
  const test::ExampleFilter filter = scalar.filter();
  const TrackedTone tone = test::tone_of(filter);
  const NodeCurve curve = test::constant_curve(0.3, {0.0, 0.01});
  FilterParameters parameters = parameters_of(1, 1e-3);
  parameters.noise = 0.05;
  FilterOrbit orbit(tone, curve, parameters);
  orbit.begin(0.3);
  for (int i = 0; i < 300; ++i) {
    REQUIRE(orbit.step());
  }
  const double square = scalar.a * scalar.a;
  const double more = 1.0 + kSlack;
  const double less = 1.0 - kSlack;
  const double high = scalar.settled(more * (1.0 + parameters.eta) * square, more * scalar.q);
  const double low = scalar.settled(less * (1.0 - parameters.theta) * square, less * scalar.q);
  CHECK(orbit.here().high(0, 0) == doctest::Approx(high).epsilon(1e-12));
  CHECK(orbit.here().low(0, 0) == doctest::Approx(low).epsilon(1e-12));
  const double updated_high = scalar.updated(high);
  const double updated_low = scalar.updated(low);
  const double gain = scalar.gain(0.5 * (updated_high + updated_low));
  const double factor = (1.0 - gain * scalar.h) * scalar.a;
  const double source = parameters.source * gain * gain +
                        0.5 * parameters.spread * (updated_high - updated_low) + parameters.process[0];
  const double shape = source / (1.0 - factor * factor / parameters.lambda);
  CHECK(orbit.here().shape(0, 0) == doctest::Approx(shape).epsilon(1e-12));
  CHECK(orbit.reach() == doctest::Approx(std::sqrt(shape)).epsilon(1e-12));
  // The growth, with the gains at both ends.
  const FilterGrowth growth = orbit.growth();
  double least = 0.0;
  double most = 0.0;
  for (const double covariance : {updated_high, updated_low}) {
    const double worst = (1.0 - scalar.gain(covariance) * scalar.h) * scalar.a;
    const double of_noise = scalar.gain(covariance) * parameters.noise / std::sqrt(shape);
    least = std::max(least, worst + of_noise);
    most = std::max(most, worst) + of_noise;
  }
  CHECK(growth.whole >= least);
  CHECK(growth.whole < 1.1 * (most + 0.1));
  CHECK(growth.linear >= (1.0 - scalar.gain(updated_low) * scalar.h) * scalar.a);
}

/// Samples of the textbook's filter from the bounds and the shape at a sample to those at the next one.
struct SampledStep {
  const test::BentFilter* bent;
  const NodeCurve* curve;
  double phase;
  FilterOnOrbit here, next;
  /// The largest covariance there in units of its bound, and the smallest bound in units of one.
  double of_high = 0.0, of_low = 0.0;

  [[nodiscard]] Eigen::Vector2d on_curve(double at) const {
    return {test::summed(curve->harmonics, 0, at), test::summed(curve->harmonics, 1, at)};
  }
  void try_all(test::Random& random, const Eigen::Matrix2d& wide) {
    const Eigen::Matrix2d low = bent->updated(here.low);
    const Eigen::Matrix2d high = bent->updated(here.high);
    for (int i = 0; i < 400; ++i) {
      const Eigen::Vector2d x = on_curve(phase) + wide * test::random_direction(random);
      const Eigen::Matrix2d covariance =
          i % 4 == 0 ? low : (i % 4 == 1 ? high : test::random_between(random, low, high));
      const Eigen::Matrix2d f = bent->jacobian(x);
      const Eigen::Matrix2d predicted = f * covariance * f.transpose() + bent->process();
      const Eigen::Matrix2d above = next.high;
      const Eigen::Matrix2d below = next.low;
      CHECK(test::least_of_both(above - predicted) > 0.0);
      CHECK(test::least_of_both(predicted - below) > 0.0);
      of_high = std::max(of_high, oracle::eigenvalues(above.inverse() * predicted).real().maxCoeff());
      of_low = std::max(of_low, oracle::eigenvalues(predicted.inverse() * below).real().maxCoeff());
    }
  }
};

TEST_CASE("bounds contain the covariances of all estimates in the shape, or around, and are close") {
  test::Random random(921);
  Tube around;
  around.frequency = 0.7;
  around.half_width = 0.01;
  around.curve.resize(2);
  around.shape = {{{{0.4}, {0.05}}}, {{{0.1}}}, {{{0.3}}}};
  for (const bool is_given : {false, true}) {
    for (const bool is_inside : {false, true}) {
      CAPTURE(is_given);
      CAPTURE(is_inside);
      test::BentFilter bent;
      bent.gives_jacobian = is_given;
      const test::ExampleFilter filter = bent.filter();
      const TrackedTone tone = test::tone_of(filter);
      const NodeCurve curve = test::BentFilter::written_curve();
      const Surroundings surroundings{is_inside ? &around : nullptr, 0.5, 0.0};
      FilterOrbit orbit(tone, curve, parameters_of(2, 4e-3), surroundings);
      orbit.begin(0.3);
      REQUIRE(orbit.step());
      double of_high = 0.0;
      double of_low = 0.0;
      for (int k = 1; k < 25; ++k) {
        const FilterOnOrbit here = orbit.here();
        REQUIRE(orbit.step());
        const double phase = 0.3 + k * curve.frequency;
        SampledStep step{&bent, &curve, phase, here, orbit.here()};
        const Eigen::Matrix2d of_around = 0.5 * test::PointTube(around).shape(phase, around.frequency);
        step.try_all(random, is_inside ? of_around : test::lower_root(here.shape));
        of_high = std::max(of_high, step.of_high);
        of_low = std::max(of_low, step.of_low);
      }
      CHECK(of_high > 0.8);
      CHECK(of_low > 0.75);
    }
  }
}

TEST_CASE(
    "a shape's step is a Lyapunov recursion with the gain in the middle; a slew adds the curve's move") {
  const test::BentFilter bent;
  const test::ExampleFilter filter = bent.filter();
  const TrackedTone tone = test::tone_of(filter);
  const NodeCurve curve = test::BentFilter::written_curve();
  const Eigen::MatrixXcd slope = 0.5 * curve.harmonics;
  for (const double slew : {0.0, 0.01}) {
    CAPTURE(slew);
    FilterParameters parameters = parameters_of(2, 1e-3);
    parameters.process[1] = 2e-3;
    parameters.slew = slew;
    parameters.moving = 0.3;
    FilterOrbit orbit(tone, curve, parameters, {}, &slope);
    orbit.begin(0.3);
    CHECK(orbit.here().shape == MatrixXd(parameters.process.asDiagonal()));
    for (int k = 0; k < 6; ++k) {
      const FilterOnOrbit here = orbit.here();
      REQUIRE(orbit.step());
      const double phase = 0.3 + k * curve.frequency;
      const auto on_curve = [&curve](double at) {
        return Eigen::Vector2d(test::summed(curve.harmonics, 0, at), test::summed(curve.harmonics, 1, at));
      };
      const Eigen::Matrix2d low = bent.updated(orbit.here().low);
      const Eigen::Matrix2d high = bent.updated(orbit.here().high);
      const Eigen::Vector2d gain = 0.5 * (low + high) * bent.measured().transpose() / bent.r;
      const Eigen::Matrix2d a =
          (Eigen::Matrix2d::Identity() - gain * bent.measured()) * bent.slope(on_curve(phase));
      Eigen::Matrix2d shape = a * here.shape * a.transpose() / parameters.lambda +
                              parameters.source * gain * gain.transpose() +
                              0.5 * parameters.spread * (high - low);
      shape += parameters.process.asDiagonal();
      if (slew > 0.0) {
        const Eigen::Vector2d move = 0.5 * on_curve(phase + curve.frequency);
        shape += parameters.moving * move * move.transpose();
      }
      CHECK((orbit.here().shape - shape).cwiseAbs().maxCoeff() < 1e-13);
      const Eigen::RowVector2d gradient(1.0, 0.5);
      CHECK(orbit.reach() == doctest::Approx(std::sqrt((gradient * shape * gradient.transpose())(0, 0))));
    }
  }
}

TEST_CASE(
    "the textbook's filter stays in the next shape times the growth, from every estimate and covariance") {
  // A leak: the curve has innovations of its own.
  const test::ScalarFilter scalar{.a = 0.85, .bend = 0.15};
  const test::ExampleFilter filter = scalar.filter();
  const TrackedTone tone = test::tone_of(filter);
  NodeCurve curve = test::constant_curve(0.7, {0.2, 0.012});
  curve.harmonics.conservativeResize(2, 2);
  curve.harmonics.col(1) << 0.3, 0.002;
  FilterParameters parameters = parameters_of(1, 1e-3);
  parameters.noise = 0.05;
  FilterOrbit orbit(tone, curve, parameters);
  orbit.begin(0.3);
  test::Random random(923);
  double closest = 0.0;
  for (int k = 0; k < 30; ++k) {
    const double here = std::sqrt(orbit.here().shape(0, 0));
    REQUIRE(orbit.step());
    const double growth = orbit.growth().whole;
    const double phase = 0.3 + k * curve.frequency;
    const double x = test::summed(curve.harmonics, 0, phase);
    const double next = test::summed(curve.harmonics, 0, phase + curve.frequency);
    const double settled_gain = scalar.gain(test::summed(curve.harmonics, 1, phase + curve.frequency));
    const double sample = scalar.next(x) + (next - scalar.next(x)) / settled_gain;
    double longest = 0.0;
    for (int i = 0; i < 400; ++i) {
      const double from = x + here * (random.below(2) == 0 ? 1.0 : -1.0);
      const double predicted = random.below(2) == 0 ? orbit.here().low(0, 0) : orbit.here().high(0, 0);
      const double noise = random.below(2) == 0 ? parameters.noise : -parameters.noise;
      const double gain = predicted / (predicted + scalar.r);
      const double to = scalar.next(from) + gain * (sample + noise - scalar.next(from));
      longest = std::max(longest, std::fabs(to - next) / std::sqrt(orbit.here().shape(0, 0)));
    }
    CHECK(longest <= growth);
    closest = std::max(closest, longest / growth);
  }
  CHECK(closest > 0.85);
}

TEST_CASE("an orbit whose samples are given is the one whose samples are computed, also beyond them") {
  const test::BentFilter bent;
  const test::ExampleFilter filter = bent.filter();
  const TrackedTone tone = test::tone_of(filter);
  const NodeCurve curve = test::BentFilter::written_curve();
  const OrbitPoints points(tone, curve, 0.3);
  const FilterParameters parameters = parameters_of(2, 1e-4);
  FilterOrbit with(tone, curve, parameters, {}, nullptr, &points);
  FilterOrbit without(tone, curve, parameters);
  with.begin(0.3);
  without.begin(0.3);
  for (int k = 0; k < 140; ++k) {
    REQUIRE(with.step());
    REQUIRE(without.step());
    CHECK(with.here().shape == without.here().shape);
    CHECK(with.here().high == without.here().high);
    CHECK(with.growth().whole == without.growth().whole);
  }
}

TEST_CASE("an orbit ends where its shape or its bounds are none") {
  const test::ScalarFilter bent{.bend = 0.5};
  const test::ExampleFilter filter = bent.filter();
  const TrackedTone tone = test::tone_of(filter);
  const NodeCurve curve = test::constant_curve(0.3, {0.0, 0.01});
  const auto steps = [&](double process) {
    FilterOrbit orbit(tone, curve, parameters_of(1, process));
    orbit.begin(0.0);
    int count = 0;
    while (count < 20 && orbit.step()) {
      ++count;
    }
    return count;
  };
  CHECK(steps(1e-3) == 20);
  CHECK(steps(0.0) == 0);   // no shape
  CHECK(steps(10.0) == 0);  // what the Jacobian may be leaves no lower bound
  CHECK(steps(1e13) == 0);
}

}  // namespace
}  // namespace veritrack::model::detail
