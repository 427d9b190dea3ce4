#include "analysis/model/shape/shape_search.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/analysis/model/shape/shape_examples.hpp"

namespace veritrack::model::detail {
namespace {

constexpr double kRate = 0.75;
constexpr double kNoiseGain = 0.5;

/// Two states that know nothing of each other, with the same noise on both.
CurveDynamics two_alike(double drift = 0.0) {
  const MatrixXd a = kRate * MatrixXd::Identity(2, 2);
  CurveDynamics dynamics =
      test::constant_dynamics(a, MatrixXd::Constant(2, 1, kNoiseGain), {2, MatrixXd::Zero(3, 3)});
  dynamics.slew.setConstant(drift);
  return dynamics;
}

ShapeSettings search_settings(ShapeObjective objective) {
  ShapeSettings settings;
  settings.objective = objective;
  return settings;
}

/// Of the covariance: S/(1 - a^2/lambda) with lambda halfway from a^2 to 1.
double variance() {
  const double lambda = 0.5 * (1.0 + kRate * kRate);
  return kNoiseGain * kNoiseGain / (1.0 - kRate * kRate / lambda);
}

TEST_CASE("lambda is between the square of the rate and 1, by its logit") {
  const SearchCoordinates coordinates(two_alike(), search_settings(ShapeObjective::largest_noise),
                                      Axes::of_states);
  REQUIRE(coordinates.is_usable());
  CHECK(coordinates.size() == 3);  // lambda and two axes
  const auto lambda = [&](double logit) {
    return coordinates.at(coordinates.start(logit, 0.0, -50.0)).lambda;
  };
  CHECK(lambda(0.0) == doctest::Approx(0.5 * (1.0 + kRate * kRate)).epsilon(1e-9));
  CHECK(lambda(std::log(3.0)) == doctest::Approx(0.25 * kRate * kRate + 0.75).epsilon(1e-9));
  ShapeSettings others = search_settings(ShapeObjective::largest_noise);
  others.largest_rate = 0.9;  // at another frequency
  const SearchCoordinates wider(two_alike(), others, Axes::of_states);
  CHECK(wider.at(wider.start(0.0, 0.0, -50.0)).lambda == doctest::Approx(0.5 * (1.0 + 0.81)).epsilon(1e-9));
}

TEST_CASE("W is a multiple of the covariance along its axes, or of its diagonal") {
  const auto source = [](Axes axes) {
    const SearchCoordinates coordinates(two_alike(), search_settings(ShapeObjective::largest_noise), axes);
    return coordinates.at(coordinates.start(0.0, std::log(0.25), -50.0)).source;
  };
  // Both states have the same errors: the covariance is one number in all its entries.
  const MatrixXd together = source(Axes::of_covariance);
  CHECK(together(0, 0) == doctest::Approx(0.25 * variance()).epsilon(1e-4));
  CHECK(together(0, 1) == doctest::Approx(0.25 * variance()).epsilon(1e-4));
  CHECK(together(1, 1) == doctest::Approx(0.25 * variance()).epsilon(1e-4));
  // By its factor (1, 1)/(0, tiny), the diagonal is the first state's variance and hardly anything.
  const MatrixXd apart = source(Axes::of_states);
  CHECK(apart(0, 1) == 0.0);
  CHECK(apart(0, 0) == doctest::Approx(0.25 * variance()).epsilon(1e-4));
  CHECK(apart(1, 1) < 1e-4 * apart(0, 0));
}

TEST_CASE("along every axis W is at least the floor, in units of the states' sizes") {
  CurveDynamics dynamics = two_alike();
  dynamics.size = Eigen::Vector2d(2.0, 8.0);
  const SearchCoordinates coordinates(dynamics, search_settings(ShapeObjective::largest_noise),
                                      Axes::of_states);
  const MatrixXd source = coordinates.at(coordinates.start(0.0, -100.0, std::log(0.5))).source;
  CHECK(source(0, 0) == doctest::Approx(1.0));
  CHECK(source(1, 1) == doctest::Approx(16.0));
}

TEST_CASE("weights are for the disturbances of the objective; a slew's makes it as large as a noise of 1") {
  const auto weights = [](const ShapeSettings& settings, double drift) {
    const SearchCoordinates coordinates(two_alike(drift), settings, Axes::of_states);
    return coordinates.at(Eigen::VectorXd::Zero(coordinates.size())).weights;
  };
  CHECK(weights(search_settings(ShapeObjective::largest_noise), 0.25).noise == 1.0);
  CHECK(weights(search_settings(ShapeObjective::largest_noise), 0.25).slew == 0.0);
  const DisturbanceWeights slew = weights(search_settings(ShapeObjective::largest_slew), 0.25);
  CHECK(slew.noise == 0.0);
  // The entries of B B' add up to 1, those of the square of the drift's length to 1/8.
  CHECK(slew.slew == doctest::Approx(8.0));
  ShapeSettings both = search_settings(ShapeObjective::least_long_run_error);
  both.noise = 0.01;
  both.slew = 1e-4;
  CHECK(weights(both, 0.25).noise == 1.0);
  CHECK(weights(both, 0.25).slew == doctest::Approx(8.0));
  const SearchCoordinates coordinates(two_alike(0.25), both, Axes::of_states);
  REQUIRE(coordinates.size() == 4);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(4);
  x[3] = std::log(3.0);
  CHECK(coordinates.at(x).weights.slew == doctest::Approx(24.0));
}

TEST_CASE("parameters that were good nearby are the place where the search begins") {
  ShapeParameters nearby;
  nearby.lambda = 0.8;
  nearby.weights = {2.0, 0.5};
  nearby.source = MatrixXd{{0.5, 0.125}, {0.125, 0.25}};
  const SearchCoordinates coordinates(two_alike(), search_settings(ShapeObjective::largest_noise), nearby);
  REQUIRE(coordinates.is_usable());
  const ShapeParameters at = coordinates.at(coordinates.nearby());
  CHECK(at.lambda == doctest::Approx(0.8));
  CHECK((at.source - nearby.source).norm() < 1e-12);
  CHECK(at.weights.noise == 2.0);
  CHECK(at.weights.slew == doctest::Approx(0.5));
  nearby.lambda = 0.5;  // below the square of the rate: halfway is better
  const SearchCoordinates other(two_alike(), search_settings(ShapeObjective::largest_noise), nearby);
  CHECK(other.at(other.nearby()).lambda == doctest::Approx(0.5 * (1.0 + kRate * kRate)));
  nearby.source = -nearby.source;
  CHECK_FALSE(
      SearchCoordinates(two_alike(), search_settings(ShapeObjective::largest_noise), nearby).is_usable());
}

}  // namespace
}  // namespace veritrack::model::detail
