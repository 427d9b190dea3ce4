#include "analysis/model/filter/filter_search.hpp"

#include <doctest/doctest.h>

#include "tests/analysis/model/filter/filter_examples.hpp"

namespace veritrack::model::detail {
namespace {

/// A scalar filter on a curve of constant states, searched with few evaluations.
struct SearchedFilter {
  test::ScalarFilter scalar;
  test::ExampleFilter filter;
  double covariance;
  TrackedTone tone;
  CurveFit curve;

  explicit SearchedFilter(const test::ScalarFilter& of)
      : scalar(of),
        filter(of.filter()),
        covariance(of.updated(of.settled(of.a * of.a, of.q))),
        tone(test::tone_of(filter)),
        curve(test::constant_fit(0.3, 0.01, {0.0, covariance})) {}
  SearchedFilter(const SearchedFilter&) = delete;
  SearchedFilter& operator=(const SearchedFilter&) = delete;
  SearchedFilter(SearchedFilter&&) = delete;
  SearchedFilter& operator=(SearchedFilter&&) = delete;
  ~SearchedFilter() = default;

  [[nodiscard]] double gain() const { return scalar.gain(covariance); }
  [[nodiscard]] double rate() const { return (1.0 - gain() * scalar.h) * scalar.a; }
  [[nodiscard]] FilterSearch search(const TubeSettings& settings) const {
    return {tone, curve, settings, rate()};
  }
};

TubeSettings settings_of(ShapeObjective objective, int evaluations = 60) {
  TubeSettings settings;
  settings.shape.objective = objective;
  settings.shape.evaluations = evaluations;
  return settings;
}

TEST_CASE("a search finds what its objective names, unless that is given") {
  const SearchedFilter searched(test::ScalarFilter{});
  const auto coordinates = [&searched](ShapeObjective objective, double noise, double slew) {
    TubeSettings settings = settings_of(objective);
    settings.shape.noise = noise;
    settings.shape.slew = slew;
    return searched.search(settings).coordinates();
  };
  const FilterCoordinates of_starts = coordinates(ShapeObjective::largest_starts, 0.0, 0.0);
  CHECK_FALSE(of_starts.finds());
  CHECK(of_starts.exponent == 0.0);
  CHECK(of_starts.rate_squared == doctest::Approx(searched.rate() * searched.rate()));
  REQUIRE(of_starts.sizes.size() == 1);
  CHECK(of_starts.sizes[0] == doctest::Approx(std::sqrt(searched.covariance)));
  CHECK(coordinates(ShapeObjective::largest_noise, 0.0, 0.0).finds_noise);
  CHECK_FALSE(coordinates(ShapeObjective::largest_noise, 0.1, 0.0).finds());
  CHECK(coordinates(ShapeObjective::largest_noise, 0.1, 0.0).given_noise == 0.1);
  CHECK(coordinates(ShapeObjective::largest_slew, 0.1, 0.0).finds_slew);
  CHECK_FALSE(coordinates(ShapeObjective::largest_slew, 0.1, 0.0).finds_noise);
  CHECK_FALSE(coordinates(ShapeObjective::largest_slew, 0.1, 0.01).finds());
  CHECK(coordinates(ShapeObjective::largest_slew, 0.1, 0.01).given_slew == 0.01);
  const FilterCoordinates of_deviation = coordinates(ShapeObjective::largest_deviation, 0.0, 0.0);
  CHECK(of_deviation.finds_noise);
  CHECK(of_deviation.exponent == doctest::Approx(28.0 + std::log(5.0)));
}

TEST_CASE("a search measures each state by what the filter expects of it") {
  const test::BentFilter bent;
  const test::ExampleFilter filter = bent.filter();
  const TrackedTone tone = test::tone_of(filter);
  const NodeCurve written = test::BentFilter::written_curve();
  CurveFit curve;
  curve.frequency = written.frequency;
  curve.half_width = 0.01;
  curve.turns = written.turns;
  curve.coefficients.assign(kNodes, Eigen::MatrixXcd::Zero(5, 3));
  curve.coefficients[0] = written.harmonics;
  const FilterSearch search(tone, curve, settings_of(ShapeObjective::largest_starts), 0.9);
  REQUIRE(search.coordinates().sizes.size() == 2);
  for (const Index i : {0, 1}) {
    const double variance = test::summed(written.harmonics, i == 0 ? 2 : 4, kFirstPhase);
    CHECK(search.coordinates().sizes[i] == doctest::Approx(std::sqrt(variance)));
  }
}

TEST_CASE("a linear filter tolerates the noise that its reach leaves") {
  const SearchedFilter searched(test::ScalarFilter{});
  TubeSettings settings = settings_of(ShapeObjective::largest_noise, 90);
  settings.shape.largest_reach = 0.5;
  FilterSearch search = searched.search(settings);
  const auto point = search.run({});
  REQUIRE(point);
  const FilterParameters parameters = search.coordinates().at(*point);
  const FilterWorth worth = search.worth_at(parameters, 64);
  CHECK(worth.growth <= kLargestGrowth + 1e-9);
  CHECK(worth.most_reach <= 0.97 * 0.5 + 1e-9);
  // |x| <= reach becomes rate |x| + K V, at most 0.985 reach.
  const double most = (0.985 - searched.rate()) * 0.97 * 0.5 / searched.gain();
  CHECK(parameters.noise <= most);
  CHECK(parameters.noise > 0.85 * most);
}

TEST_CASE("the largest reach of a bent filter is where the growth ends, and is found again from nearby") {
  const SearchedFilter searched(test::ScalarFilter{.bend = 0.3});
  TubeSettings settings = settings_of(ShapeObjective::largest_starts);
  FilterSearch search = searched.search(settings);
  const auto point = search.run({});
  REQUIRE(point);
  const FilterWorth worth = search.worth_at(search.coordinates().at(*point), 64);
  CHECK(worth.growth <= kLargestGrowth + 1e-9);
  VectorXd larger = *point;
  larger[3] += 0.1;
  larger[5] += 0.1;
  CHECK_FALSE(search.worth_at(search.coordinates().at(larger), 64).growth <= kLargestGrowth);
  FilterSearch again = searched.search(settings);
  CHECK(*again.run({}) == *point);
  FilterSearch near = searched.search(settings);
  const auto nearby = near.run(*point);
  REQUIRE(nearby);
  CHECK(near.worth_at(near.coordinates().at(*nearby), 64).least_reach >= 0.99 * worth.least_reach);
  settings.shape.largest_reach = 0.4 * worth.most_reach;
  FilterSearch limited = searched.search(settings);
  const auto smaller = limited.run({});
  REQUIRE(smaller);
  const double reach = limited.worth_at(limited.coordinates().at(*smaller), 64).most_reach;
  CHECK(reach <= 0.97 * settings.shape.largest_reach * (1.0 + 1e-9));
  CHECK(reach > 0.85 * settings.shape.largest_reach);
}

TEST_CASE("a search finds nothing when its time is over, and none where errors grow") {
  const SearchedFilter searched(test::ScalarFilter{.bend = 0.3});
  TubeSettings settings = settings_of(ShapeObjective::largest_starts);
  settings.shape.deadline = search::Deadline(0.0);
  CHECK_FALSE(searched.search(settings).run({}));
  TubeSettings noisy = settings_of(ShapeObjective::largest_noise, 15);
  noisy.shape.noise = 100.0;
  CHECK_FALSE(searched.search(noisy).run({}));
}

}  // namespace
}  // namespace veritrack::model::detail
