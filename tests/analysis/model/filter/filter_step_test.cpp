#include "analysis/model/filter/filter_step.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "analysis/rigor/ball_model.hpp"
#include "tests/analysis/model/filter/filter_examples.hpp"

namespace veritrack::model {
namespace {

/// A tube of the scalar filter that nothing has proposed.
Tube tube_of_scalar(double low, double high, double shape) {
  Tube tube;
  tube.frequency = 0.3;
  tube.half_width = 0.03125;
  tube.turns = {0};
  tube.curve = {{{{0.2}, {0.3, 0.03125}, {{0.0, 0.0625}}}}};
  tube.shape = {{{{shape, 0.125 * shape}, {0.125 * shape}}}};
  tube.covariance_low = {{{{low, 0.0625 * low}}}};
  tube.covariance_high = {{{{high}, {{0.0, 0.0625 * high}}}}};
  return tube;
}

double value_in(const PhaseSeries& series, double phase, double z) {
  double sum = 0.0;
  for (std::size_t h = 0; h < series.coefficients.size(); ++h) {
    for (std::size_t d = 0; d < series.coefficients[h].size(); ++d) {
      sum += (series.coefficients[h][d] * std::polar(1.0, static_cast<double>(h) * phase)).real() *
             std::pow(z, static_cast<double>(d));
    }
  }
  return sum;
}

/// A random step of the textbook's filter from the tube, for a covariance between its bounds.
struct RandomStep {
  double length, frequency_error;

  RandomStep(test::Random& random, const test::ScalarFilter& scalar, const Tube& tube, const TubeCell& cell,
             const FilterStepQuestion& question, double scale) {
    const double z = cell.z + cell.half_z * random.uniform(-1.0, 1.0);
    const double phase = 2.0 * std::numbers::pi * (cell.turn + cell.half_turn * random.uniform(-1.0, 1.0));
    const auto sign = [&random] { return random.below(2) == 0 ? 1.0 : -1.0; };
    const double xi = scale * question.radius * sign();
    const double x = value_in(tube.curve[0], phase, z) + value_in(tube.shape[0], phase, z) * xi;
    const double frequency = tube.frequency + z * tube.half_width;
    const double next_phase = phase + frequency;
    const double next_z = z + question.slew * sign() / tube.half_width;
    const double low = value_in(tube.covariance_low[0], next_phase, next_z);
    const double high = value_in(tube.covariance_high[0], next_phase, next_z);
    const double predicted = random.below(4) == 0   ? random.uniform(low, high)
                             : random.below(2) == 0 ? low
                                                    : high;
    const double gain = predicted * scalar.h / (scalar.h * scalar.h * predicted + scalar.r);
    const double sample = std::cos(next_phase) + question.noise * sign();
    const double next = scalar.next(x) + gain * (sample - scalar.h * scalar.next(x));
    length = std::fabs(next - value_in(tube.curve[0], next_phase, next_z)) /
             value_in(tube.shape[0], next_phase, next_z);
    frequency_error = x - frequency;
  }
};

TEST_CASE(
    "no step of the textbook's filter from a tube is longer than the bounds over a cell, and some are "
    "nearly") {
  const test::ScalarFilter scalar{.bend = 0.25, .h = 1.25};
  const test::FilterExample filter(scalar.filter());
  const Tube tube = tube_of_scalar(0.02, 0.03, 0.3);
  const std::vector<double> scales{1.0, 0.5};
  test::Random random(971);
  for (const double noise : {0.0, 0.25}) {
    for (const double slew : {0.0, 0.004}) {
      CAPTURE(noise);
      CAPTURE(slew);
      const FilterStepQuestion question{0.75, noise, slew, false, 0.0};
      double closest = 0.0;
      for (int trial = 0; trial < 10; ++trial) {
        const TubeCell cell{(2.0 * static_cast<double>(random.below(64)) + 1.0) / 128.0, 1.0 / 128.0,
                            random.below(2) == 0 ? -0.5 : 0.5, 0.5};
        const StepBounds bounds = bound_filter_step(filter.example.model, tube, cell, question, scales);
        REQUIRE(bounds.steps.size() == 2);
        for (int i = 0; i < 200; ++i) {
          const std::size_t which = random.below(2);
          const RandomStep step(random, scalar, tube, cell, question, scales[which]);
          REQUIRE(step.length <= bounds.steps[which]);
          REQUIRE(step.frequency_error <= bounds.frequency_error.upper());
          REQUIRE(step.frequency_error >= bounds.frequency_error.lower());
          closest = std::max(closest, step.length / bounds.steps[which]);
        }
      }
      CHECK(closest > (noise > 0.0 && slew > 0.0 ? 0.7 : 0.8));
      CHECK(closest < 1.0);
    }
  }
}

/// The longest random step from a tiny tube at 32 places, in units of its bound.
double closest_step(const Tube& tube, const FilterStepQuestion& question) {
  const test::ScalarFilter scalar;
  const test::FilterExample filter(scalar.filter());
  test::Random random(972);
  double closest = 0.0;
  for (int place = 0; place < 32; ++place) {
    const TubeCell cell{(2.0 * place + 1.0) / 64.0, 0x1p-14, 0.25, 0x1p-10};
    const StepBounds bounds = bound_filter_step(filter.example.model, tube, cell, question, {1.0});
    REQUIRE(bounds.steps.size() == 1);
    for (int i = 0; i < 60; ++i) {
      const RandomStep step(random, scalar, tube, cell, question, 1.0);
      CHECK(step.length <= bounds.steps.front());
      closest = std::max(closest, step.length / bounds.steps.front());
    }
  }
  return closest;
}

TEST_CASE("noise and slew at their largest together are within the bounds") {
  constexpr double kLittle = 1e-6;
  constexpr double kSlewOfStep = 0.02;
  Tube tube = tube_of_scalar(0.0249, 0.0251, 1.0);
  tube.covariance_low = {{{{0.0249}}}};
  tube.covariance_high = {{{{0.0251}}}};
  tube.curve = {{{{0.0, 0.25}}}};
  CHECK(closest_step(tube, {kLittle, 0.5, kSlewOfStep, false, 0.0}) > 0.9);
}

/// A constant tube about 0 of the scalar filter.
Tube constant_tube(double low, double high, double shape = 0.3) {
  Tube tube;
  tube.frequency = 0.3;
  tube.half_width = 0.03125;
  tube.turns = {0};
  tube.curve = {{}};
  tube.shape = {{{{shape}}}};
  tube.covariance_low = {{{{low}}}};
  tube.covariance_high = {{{{high}}}};
  return tube;
}

TEST_CASE(
    "bounds of a covariance are kept with the margin that the recursion leaves them, and with no more") {
  const test::ScalarFilter scalar{.h = 1.25};
  const test::FilterExample filter(scalar.filter());
  const TubeCell cell{0.5, 0.125, 0.0, 1.0};
  const double settled = scalar.settled(scalar.a * scalar.a, scalar.q);
  const auto after = [&scalar](double covariance) {
    return scalar.a * scalar.a * scalar.updated(covariance) + scalar.q;
  };
  const auto keeps = [&](double low, double high, double margin, double ratio = 1.0) {
    return keeps_range(filter.example.model, constant_tube(low, high), cell, {0.5, margin, ratio});
  };
  const double high = 1.1 * settled;
  const double low = 0.9 * settled;
  const double of_high = 1.0 - after(high) / high;
  const double of_low = 1.0 - low / after(low);
  const double least = std::min(of_high, of_low);
  REQUIRE(least > 0.02);
  CHECK(keeps(low, high, 0.0));
  CHECK(keeps(low, high, 0.97 * least));
  CHECK_FALSE(keeps(low, high, 1.03 * least));
  CHECK(keeps(low, high, 0.97 * least, 4.0));
  // Each bound decides: the other one has much to spare.
  CHECK_FALSE(keeps(0.3 * settled, high, 1.03 * of_high));
  CHECK(keeps(0.3 * settled, high, 0.97 * of_high));
  CHECK_FALSE(keeps(low, 4.0 * settled, 1.03 * of_low));
  CHECK(keeps(low, 4.0 * settled, 0.97 * of_low));
  CHECK_FALSE(keeps(0.9 * settled, 0.99 * settled, 0.0));
  CHECK_FALSE(keeps(1.01 * settled, 1.1 * settled, 0.0));
  CHECK_FALSE(keeps(high, low, 0.0));
  CHECK_FALSE(keeps(-low, high, 0.0));
}

TEST_CASE("bounds are kept for the Jacobians of all estimates in the tube, and of no larger one") {
  const test::ScalarFilter scalar{.bend = 0.4};
  const test::FilterExample filter(scalar.filter());
  const TubeCell cell{0.5, 0.125, 0.0, 1.0};
  const double high = 0.06;
  const double low = 0.004;
  // F = a + bend 0.3 xi.
  const auto is_kept = [&](double radius) {
    const double most = scalar.a + scalar.bend * 0.3 * radius;
    const double least = scalar.a - scalar.bend * 0.3 * radius;
    return most * most * scalar.updated(high) + scalar.q < high &&
           least * least * scalar.updated(low) + scalar.q > low;
  };
  int proved = 0;
  int kept = 0;
  int asked = 0;
  for (double radius = 0.1; radius < 8.0; radius *= 1.1) {
    const bool is_proved =
        keeps_range(filter.example.model, constant_tube(low, high), cell, {radius, 0.0, 1.0});
    proved += is_proved ? 1 : 0;
    kept += is_kept(radius) ? 1 : 0;
    ++asked;
    CHECK((is_kept(radius) || !is_proved));
    const FilterStepQuestion question{radius, 0.0, 0.0, true, 0.0};
    const StepBounds bounds =
        bound_filter_step(filter.example.model, constant_tube(low, high), cell, question, {1.0});
    // With a little more room.
    CHECK((is_proved || std::isnan(bounds.steps.front())));
    CHECK(std::isfinite(bounds.steps.front()) ==
          keeps_range(filter.example.model, constant_tube(low, high), cell, {1.01 * radius, 0.0, 1.0}));
  }
  CHECK(proved > 0);
  CHECK(kept < asked - 2);
  CHECK(proved >= kept - 2);
}

TEST_CASE("a tube must have as many bounds of a covariance as the filter has entries") {
  const test::FilterExample filter(test::ScalarFilter{}.filter());
  Tube tube = constant_tube(0.01, 0.02);
  tube.covariance_low.clear();
  const TubeCell cell{0.5, 0.125, 0.0, 1.0};
  CHECK_THROWS_AS(bound_filter_step(filter.example.model, tube, cell, {0.5}, {1.0}), std::invalid_argument);
  CHECK_THROWS_AS((void)keeps_range(filter.example.model, tube, cell, {0.5}), std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::model
