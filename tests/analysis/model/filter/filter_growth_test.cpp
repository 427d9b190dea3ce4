#include "analysis/model/filter/filter_growth.hpp"

#include <doctest/doctest.h>

#include <array>

#include "tests/analysis/model/filter/filter_examples.hpp"
#include "tests/support/oracles.hpp"

namespace veritrack::model::detail {
namespace {

/// A step that nothing has proposed, of a filter with two states.
FilterStepOnOrbit random_step(test::Random& random, const test::BentFilter& bent, bool moves) {
  const auto random_matrix = [&random](double size) {
    return Eigen::Matrix2d(
        Eigen::Matrix2d::NullaryExpr([&random, size] { return random.uniform(-size, size); }));
  };
  FilterStepOnOrbit step;
  const Eigen::Matrix2d unit = Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d before = Eigen::Matrix2d{{0.5, 0.0}, {random.uniform(-0.2, 0.2), 0.4}};
  const Eigen::Matrix2d root = unit + random_matrix(0.2);
  const Eigen::Matrix2d spread = 0.05 * unit + random_matrix(0.03);
  const Eigen::Matrix2d middle = 0.08 * unit + 0.02 * root * root.transpose();
  step.before = before;
  step.after = 0.6 * root * root.transpose();
  step.delta = spread * spread.transpose();
  step.gain = middle * bent.weighted().transpose();
  step.contraction = unit - step.gain * bent.measured();
  step.slope = 0.7 * unit + random_matrix(0.3);
  for (int i = 0; i < 2; ++i) {
    step.changes.emplace_back(random_matrix(0.1));
  }
  step.innovation = SmallVector::Constant(bent.channels, random.uniform(-0.2, 0.2));
  step.offset = Eigen::Vector2d(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
  if (moves) {
    step.move = Eigen::Vector2d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
  }
  return step;
}

/// The length, in units of the shape after the step, of the error that the step makes of L xi with a gain of
/// the range, for noise v and a frequency that moves by slew zeta.
double length_of(const FilterStepOnOrbit& step, const test::BentFilter& bent, const Eigen::Vector2d& xi,
                 const Eigen::Matrix2d& within, const VectorXd& noise, double moved) {
  const Eigen::Vector2d start = step.before * xi;
  Eigen::Vector2d predicted = step.slope * start;
  for (int i = 0; i < 2; ++i) {
    predicted += 0.5 * xi[i] * step.changes[static_cast<std::size_t>(i)] * start;
  }
  const Eigen::Matrix2d root = test::lower_root(step.delta);
  const Eigen::Matrix2d more = root * within * root.transpose();
  const VectorXd unforeseen = noise - bent.measured() * predicted;
  Eigen::Vector2d error = predicted + step.gain * unforeseen + step.offset +
                          more * bent.weighted().transpose() * (step.innovation + unforeseen);
  if (step.move.size() > 0) {
    error += moved * step.move;
  }
  return oracle::solution(test::lower_root(step.after), error).norm();
}

/// The longest of many.
double longest_of(test::Random& random, const FilterStepOnOrbit& step, const test::BentFilter& bent,
                  const FilterParameters& parameters) {
  double longest = 0.0;
  for (int i = 0; i < 6000; ++i) {
    const VectorXd noise =
        parameters.noise * (bent.channels == 2 ? VectorXd(test::random_direction(random))
                                               : VectorXd::Constant(1, random.below(2) == 0 ? 1.0 : -1.0));
    const double moved = random.below(2) == 0 ? parameters.slew : -parameters.slew;
    longest = std::max(longest, length_of(step, bent, test::random_direction(random),
                                          test::random_reflection(random), noise, moved));
  }
  return longest;
}

TEST_CASE(
    "a bound of the growth is one for every gain between the bounds, with noise and a slew, and is close") {
  test::Random random(911);
  for (const int channels : {1, 2}) {
    test::BentFilter bent;
    bent.channels = channels;
    const test::ExampleFilter filter = bent.filter();
    const TrackedTone tone = test::tone_of(filter);
    const FilterNumbers numbers(tone);
    for (const double noise : {0.0, 0.1}) {
      for (const double slew : {0.0, 0.2}) {
        CAPTURE(channels);
        CAPTURE(noise);
        CAPTURE(slew);
        FilterParameters parameters;
        parameters.noise = noise;
        parameters.slew = slew;
        FilterGrowthBound bound;
        double closest = 0.0;
        for (int i = 0; i < 6; ++i) {
          const FilterStepOnOrbit step = random_step(random, bent, slew > 0.0);
          const FilterGrowth growth = bound.of(step, numbers, parameters, 0.0);
          const double longest = longest_of(random, step, bent, parameters);
          REQUIRE(std::isfinite(growth.whole));
          CHECK(longest <= growth.whole);
          CHECK(growth.linear <= growth.whole);
          closest = std::max(closest, longest / growth.whole);
          // Only compared with a limit: at most so much, or infinite.
          CHECK(bound.of(step, numbers, parameters, 1.001 * growth.whole).whole <= 1.001 * growth.whole);
          CHECK(bound.of(step, numbers, parameters, 0.999 * growth.whole).whole ==
                std::numeric_limits<double>::infinity());
        }
        CHECK(closest > (noise > 0.0 && slew > 0.0 ? 0.7 : 0.8));
      }
    }
  }
}

/// Of a scalar filter with x' = factor x before the sample, in units of a constant shape.
struct ScalarFilterStep {
  double factor, shape, delta, covariance;

  [[nodiscard]] FilterStepOnOrbit step(const test::ScalarFilter& scalar) const {
    const auto one = [](double value) { return SmallMatrix(SmallMatrix::Constant(1, 1, value)); };
    FilterStepOnOrbit result;
    result.before = one(std::sqrt(shape));
    result.after = one(shape);
    result.delta = one(delta);
    result.gain = one(scalar.gain(covariance));
    result.contraction = one(1.0 - scalar.gain(covariance) * scalar.h);
    result.slope = one(factor);
    result.changes = {one(0.0)};
    result.offset = result.innovation = SmallVector::Zero(1);
    return result;
  }
};

TEST_CASE("a scalar step grows by what the worst gain makes of it") {
  const test::ScalarFilter scalar{.h = 0.7};
  const test::ExampleFilter filter = scalar.filter();
  const TrackedTone tone = test::tone_of(filter);
  const FilterNumbers numbers(tone);
  for (const double delta : {1e-6, 0.002, 0.01}) {
    CAPTURE(delta);
    const ScalarFilterStep scalar_step{0.9, 0.3, delta, 0.02};
    const double error = 1.0 - scalar.gain(0.02) * scalar.h;
    const double more = scalar.gain(delta) * scalar.h;
    FilterParameters parameters;
    const FilterGrowth alone = FilterGrowthBound().of(scalar_step.step(scalar), numbers, parameters, 0.0);
    CHECK(alone.whole == alone.linear);
    CHECK(alone.whole >= 0.9 * (error + more));
    CHECK(alone.whole < 0.9 * (error + more) * 1.02);
    // With noise one gain is the worst of both.
    parameters.noise = 0.1;
    double worst = 0.0;
    for (const double gain : {scalar.gain(0.02 - delta), scalar.gain(0.02 + delta)}) {
      worst = std::max(worst, 0.9 * (1.0 - gain * scalar.h) + gain * 0.1 / std::sqrt(0.3));
    }
    const FilterGrowth noisy = FilterGrowthBound().of(scalar_step.step(scalar), numbers, parameters, 0.0);
    CHECK(noisy.linear == doctest::Approx(alone.linear).epsilon(0.02));
    CHECK(noisy.whole >= worst);
    CHECK(noisy.whole < 1.1 * (0.9 * (error + more) + scalar.gain(0.02 + delta) * 0.1 / std::sqrt(0.3)));
  }
}

TEST_CASE("noise alone is as large as the largest gain makes it") {
  const test::ScalarFilter scalar;
  const test::ExampleFilter filter = scalar.filter();
  const TrackedTone tone = test::tone_of(filter);
  const FilterNumbers numbers(tone);
  FilterParameters parameters;
  parameters.noise = 0.1;
  const FilterStepOnOrbit step = ScalarFilterStep{0.0, 0.3, 0.018, 0.02}.step(scalar);
  const double largest = scalar.gain(0.038) * parameters.noise / std::sqrt(0.3);
  const double whole = FilterGrowthBound().of(step, numbers, parameters, 0.0).whole;
  CHECK(whole >= largest);
  CHECK(whole < 1.5 * largest);  // half of the square is for the error before
}

TEST_CASE("what no shape has is infinite") {
  const test::ScalarFilter scalar;
  const test::ExampleFilter filter = scalar.filter();
  const TrackedTone tone = test::tone_of(filter);
  const FilterNumbers numbers(tone);
  for (const double size : {-0.3, std::numeric_limits<double>::quiet_NaN()}) {
    FilterStepOnOrbit step = ScalarFilterStep{0.9, 0.3, 0.002, 0.02}.step(scalar);
    step.after(0, 0) = size;
    CHECK(FilterGrowthBound().of(step, numbers, {}, 0.0).whole == std::numeric_limits<double>::infinity());
    step.after(0, 0) = 0.3;
    step.delta(0, 0) = size;
    CHECK(FilterGrowthBound().of(step, numbers, {}, 0.0).whole == std::numeric_limits<double>::infinity());
  }
}

/// The mean of exp(exponent (x + spread v)^2) over a standard normal v, by summation.
double mean_of_exponential(double exponent, double x, double spread) {
  double sum = 0.0;
  constexpr double kStep = 1e-3;
  for (int i = -40000; i <= 40000; ++i) {
    const double v = kStep * i;
    const double length = x + spread * v;
    sum += std::exp(exponent * length * length - 0.5 * v * v);
  }
  return kStep * sum / std::sqrt(2.0 * 3.141592653589793);
}

TEST_CASE("with Gaussian noise the growth bounds the drift at the levels that are tried") {
  const test::ScalarFilter scalar;
  const test::ExampleFilter filter = scalar.filter();
  const TrackedTone tone = test::tone_of(filter);
  const FilterNumbers numbers(tone);
  constexpr double kShape = 0.3;
  constexpr double kDelta = 1e-9;
  const ScalarFilterStep scalar_step{0.9, kShape, kDelta, 0.02};
  const double gain = scalar.gain(0.02);
  FilterParameters parameters;
  parameters.exponent = 20.0;
  for (const double noise : {0.02, 0.05, 0.1}) {
    CAPTURE(noise);
    parameters.noise = noise;
    const FilterGrowth growth = FilterGrowthBound().of(scalar_step.step(scalar), numbers, parameters, 0.0);
    double worst = 0.0;
    for (const double level : {1.0, 0.7, 0.5, 0.34, 0.25}) {
      const double all = parameters.exponent * level * level;
      const double mean = mean_of_exponential(parameters.exponent, 0.9 * (1.0 - gain) * level,
                                              gain * noise / std::sqrt(kShape));
      worst = std::max(worst, (std::log(mean) - std::log1p(5.0 * std::exp(-all))) / all);
    }
    CHECK(growth.linear == doctest::Approx(0.9 * (1.0 - gain)).epsilon(0.02));
    CHECK(growth.whole >= std::sqrt(worst));
    CHECK(growth.whole < 1.06 * std::sqrt(worst));
  }
}

}  // namespace
}  // namespace veritrack::model::detail
