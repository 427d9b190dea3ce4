#include "analysis/model/filter/filter_worth.hpp"

#include <doctest/doctest.h>

#include <array>

#include "tests/analysis/model/filter/filter_examples.hpp"

namespace veritrack::model::detail {
namespace {

constexpr double kInfiniteWorth = std::numeric_limits<double>::infinity();

TEST_CASE("a filter's coordinates are logarithms and logits, and what is given is not one of them") {
  FilterCoordinates coordinates{0.25, Eigen::Vector2d(0.5, 2.0), 0.125, false};
  CHECK(coordinates.size() == 7);
  CHECK_FALSE(coordinates.finds());
  VectorXd x(7);
  x << std::log(0.2), std::log(0.25), std::log(3.0), std::log(0.7), std::log(0.9), std::log(0.01),
      std::log(0.03);
  FilterParameters parameters = coordinates.at(x);
  CHECK(parameters.eta == doctest::Approx(0.2));
  CHECK(parameters.theta == doctest::Approx(0.25 / 1.25));
  CHECK(parameters.lambda == doctest::Approx(0.25 + 0.75 * 0.75));
  CHECK(parameters.source == doctest::Approx(0.7));
  CHECK(parameters.spread == doctest::Approx(0.9));
  CHECK(parameters.process[0] == doctest::Approx(0.01 * 0.25));
  CHECK(parameters.process[1] == doctest::Approx(0.03 * 4.0));
  CHECK(parameters.noise == 0.125);
  CHECK(parameters.slew == 0.0);
  CHECK(parameters.moving == 0.0);
  CHECK(parameters.exponent == 0.0);
  SUBCASE("the noise is searched for") {
    coordinates.finds_noise = true;
    coordinates.exponent = 30.0;
    CHECK(coordinates.size() == 8);
    x.conservativeResize(8);
    x[7] = std::log(0.3);
    parameters = coordinates.at(x);
    CHECK(parameters.noise == doctest::Approx(0.3));
    CHECK(parameters.exponent == 30.0);
    CHECK(parameters.moving == 0.0);
  }
  SUBCASE("a slew is given") {
    coordinates.given_slew = 0.002;
    CHECK(coordinates.size() == 8);
    x.conservativeResize(8);
    x[7] = std::log(0.4);
    parameters = coordinates.at(x);
    CHECK(parameters.slew == 0.002);
    CHECK(parameters.moving == doctest::Approx(0.4));
    CHECK(parameters.noise == 0.125);
  }
  SUBCASE("a slew is searched for") {
    coordinates.finds_slew = true;
    CHECK(coordinates.size() == 9);
    x.conservativeResize(9);
    x.tail(2) << std::log(0.4), std::log(0.005);
    parameters = coordinates.at(x);
    CHECK(parameters.slew == doctest::Approx(0.005));
    CHECK(parameters.moving == doctest::Approx(0.4));
  }
}

TEST_CASE("the worth on an orbit is the worst of its last samples") {
  const test::BentFilter bent;
  const test::ExampleFilter filter = bent.filter();
  const TrackedTone tone = test::tone_of(filter);
  const NodeCurve curve = test::BentFilter::written_curve();
  FilterParameters parameters;
  parameters.eta = parameters.theta = 0.2;
  parameters.source = parameters.spread = 0.01;
  parameters.noise = 0.01;
  parameters.process = Eigen::Vector2d(1e-3, 2e-3);
  FilterOrbit orbit(tone, curve, parameters);
  orbit.begin(kFirstPhase);
  FilterWorth worst{0.0, 0.0, kInfiniteWorth, 0.0};
  for (int k = 0; k < 20; ++k) {
    REQUIRE(orbit.step());
    if (k >= 12) {
      const FilterGrowth growth = orbit.growth();
      worst.growth = std::max(worst.growth, growth.whole);
      worst.linear = std::max(worst.linear, growth.linear);
      worst.least_reach = std::min(worst.least_reach, orbit.reach());
      worst.most_reach = std::max(worst.most_reach, orbit.reach());
    }
  }
  const FilterWorth worth = worth_on_orbit(tone, curve, parameters, 12, 8);
  CHECK(worth.growth == worst.growth);
  CHECK(worth.linear == worst.linear);
  CHECK(worth.least_reach == worst.least_reach);
  CHECK(worth.most_reach == worst.most_reach);
  CHECK(worth.least_reach < worth.most_reach);
  // Compared with a limit.
  const auto compared = [&](double enough) {
    return worth_on_orbit(tone, curve, parameters, 12, 8, {}, nullptr, nullptr, enough).growth;
  };
  CHECK(compared(1.001 * worst.growth) <= 1.001 * worst.growth);
  CHECK(compared(0.999 * worst.growth) == kInfiniteWorth);
  parameters.process *= 1e6;
  CHECK(worth_on_orbit(tone, curve, parameters, 12, 8).growth == kInfiniteWorth);
}

TEST_CASE("what several have is the worst of each") {
  const std::array<FilterWorth, 2> each{FilterWorth{0.5, 0.4, 0.1, 0.3}, FilterWorth{0.7, 0.2, 0.2, 0.6}};
  const FilterWorth both = least_of(each);
  CHECK(both.growth == 0.7);
  CHECK(both.linear == 0.4);
  CHECK(both.least_reach == 0.1);
  CHECK(both.most_reach == 0.6);
}

TEST_CASE("a shape remembers so many samples until less than the share is left") {
  for (const double rate_squared : {0.3, 0.9, 0.96}) {
    for (const double lambda : {0.97, 0.99}) {
      for (const double share : {1e-2, 1e-4}) {
        FilterParameters parameters;
        parameters.lambda = lambda;
        int samples = 0;
        for (double left = 1.0; left > share; left *= rate_squared / lambda) {
          ++samples;
        }
        CHECK(memory_of(rate_squared, parameters, share) == std::max(12, samples));
      }
    }
  }
  FilterParameters parameters;
  parameters.lambda = 0.9;
  CHECK(memory_of(0.95, parameters, 1e-6) == 4000);  // nothing is forgotten
}

TEST_CASE("a climb ends near the top, on points that the score returns, and never below where it began") {
  const VectorXd top = Eigen::Vector3d(1.0, -2.0, 0.5);
  int asked = 0;
  const auto score = [&](const VectorXd& x) {
    ++asked;
    // The last coordinate is found by the score itself.
    ScoredPoint scored{0.0, x};
    scored.point[2] = 0.5;
    scored.value = 3.0 - (scored.point - top).squaredNorm();
    return scored;
  };
  ScoredPoint best{-20.0, Eigen::Vector3d(-1.0, 1.0, 4.0)};
  climb(best, 1.0, 200, score);
  CHECK(best.value > 2.99);
  CHECK((best.point - top).norm() < 0.1);
  CHECK(best.point[2] == 0.5);
  CHECK(asked <= 200);
  ScoredPoint high{4.0, VectorXd::Zero(3)};
  climb(high, 1.0, 30, score);
  CHECK(high.value == 4.0);
  CHECK(high.point.isZero(0.0));
  ScoredPoint nothing{-kInfiniteWorth, VectorXd::Zero(3)};
  asked = 0;
  climb(nothing, 1.0, 30, score);
  CHECK(asked == 0);
  const std::array<ScoredPoint, 3> points{nothing, high, best};
  CHECK(&best_of(points) == &points[1]);
}

}  // namespace
}  // namespace veritrack::model::detail
