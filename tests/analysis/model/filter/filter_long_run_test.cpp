#include "analysis/model/filter/filter_long_run.hpp"

#include <doctest/doctest.h>

#include "tests/analysis/model/filter/filter_examples.hpp"

namespace veritrack::model::detail {
namespace {

TEST_CASE("a linear filter's tube in the long run is about as small as its noise lets it be") {
  const test::ScalarFilter scalar;
  const test::ExampleFilter filter = scalar.filter();
  const TrackedTone tone = test::tone_of(filter);
  const double covariance = scalar.updated(scalar.settled(scalar.a * scalar.a, scalar.q));
  const double rate = (1.0 - scalar.gain(covariance)) * scalar.a;
  const CurveFit curve = test::constant_fit(0.3, 0.01, {0.0, covariance});
  Tube around;
  around.frequency = 0.3;
  around.half_width = 0.01;
  around.curve.resize(1);
  around.shape = {{{{1.0}}}};
  const VectorXd sizes = VectorXd::Constant(1, std::sqrt(covariance));
  VectorXd of_around(6);
  of_around << -1.0, -1.0, 1.0, -2.0, -3.0, -1.0;
  const auto point_for = [&](double noise, const VectorXd& nearby) {
    const FilterCoordinates coordinates{rate * rate, sizes, noise, false};
    return LongRunSearch(tone, curve, coordinates, around, 0.5, 30).run(of_around, nearby);
  };
  for (const double noise : {0.05, 0.2}) {
    CAPTURE(noise);
    const auto point = point_for(noise, {});
    REQUIRE(point);
    const FilterCoordinates coordinates{rate * rate, sizes, noise, false};
    const LongRunSearch search(tone, curve, coordinates, around, 0.5, 30);
    const FilterWorth worth = search.worth_at(coordinates.at(*point), 64);
    CHECK(worth.growth <= kLargestGrowth + 1e-9);
    // |x| <= reach becomes rate |x| + K V, at most 0.985 reach.
    const double least = scalar.gain(covariance) * noise / (0.985 - rate);
    CHECK(worth.most_reach >= least);
    CHECK(worth.most_reach < 1.2 * least);
    CHECK(search.worth_at(coordinates.at(*point), 64, 1e-3).growth ==
          std::numeric_limits<double>::infinity());
    // What is found from there is as small.
    const auto again = point_for(noise, *point);
    REQUIRE(again);
    CHECK(search.worth_at(coordinates.at(*again), 64).most_reach <= 1.02 * worth.most_reach);
  }
  CHECK_FALSE(point_for(1e6, {}));
}

TEST_CASE("bounds in the long run are those for all estimates around") {
  const test::ScalarFilter bent{.bend = 0.3};
  const test::ExampleFilter filter = bent.filter();
  const TrackedTone tone = test::tone_of(filter);
  const double covariance = bent.updated(bent.settled(bent.a * bent.a, bent.q));
  const double rate = (1.0 - bent.gain(covariance)) * bent.a;
  const CurveFit curve = test::constant_fit(0.3, 0.01, {0.0, covariance});
  Tube around;
  around.frequency = 0.3;
  around.half_width = 0.01;
  around.curve.resize(1);
  around.shape = {{{{1.0, 0.5}}}};  // wider at higher frequencies
  FilterCoordinates coordinates{rate * rate, VectorXd::Constant(1, std::sqrt(covariance)), 0.05, false};
  VectorXd x(6);
  x << -2.0, -2.0, 1.0, -2.0, -3.0, -3.0;
  const auto growth_in = [&](double radius) {
    return LongRunSearch(tone, curve, coordinates, around, radius, 30).worth_at(coordinates.at(x), 20).growth;
  };
  // The lower bound at z = 1: (1 - theta) a^2 p - (1/theta - 1) 1.1 (1.5 radius bend)^2 p + q, times 0.988.
  const double theta = 1.0 / (1.0 + std::exp(2.0));
  const double linear = (1.0 - theta) * bent.a * bent.a;
  const auto has_bound = [&](double radius) {
    const double wide = 1.5 * radius * bent.bend;
    double predicted = covariance;
    double updated = covariance;
    for (int i = 0; i < 60 && predicted > 0.0; ++i) {
      predicted =
          (1.0 - kWideSlack) * (bent.q + (linear - 1.1 * (1.0 / theta - 1.0) * wide * wide) * updated);
      updated = bent.updated(predicted);
    }
    return predicted > 0.0;
  };
  double least = 0.0;
  double most = 10.0;
  while (most - least > 1e-3) {
    const double middle = 0.5 * (least + most);
    (has_bound(middle) ? least : most) = middle;
  }
  REQUIRE(least > 0.1);
  CHECK(std::isfinite(growth_in(0.3 * least)));
  CHECK(growth_in(0.3 * least) > growth_in(0.1 * least));
  CHECK(growth_in(1.02 * most) == std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace veritrack::model::detail
