#include "papers/experiments/repeated_runs.hpp"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "trackers/signals/random.hpp"

namespace veritrack::experiments {
namespace {

TEST_CASE("the seeds come in order, whatever the number of threads") {
  const auto run = [](std::uint64_t seed) { return trackers::RandomStream(seed).normal(); };
  const auto many = repeat(50, run);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  CHECK(repeat(50, run) == many);
  CHECK(many.at(6) == run(7));
}

TEST_CASE("mean, deviation and their errors of a sample that one can do by hand") {
  const std::array<double, 4> values{1.0, 3.0, 1.0, 3.0};
  const Summary summary = summary_of(values);
  CHECK(summary.mean == 2.0);
  CHECK(summary.deviation == doctest::Approx(std::sqrt(4.0 / 3.0)));
  CHECK(summary.mean_error == doctest::Approx(std::sqrt(1.0 / 3.0)));
  CHECK(summary.deviation_error == 0.0);  // two values of equal size: no spread of the squares
}

TEST_CASE("the error of a deviation is that of the normal distribution for normal values") {
  constexpr int kValues = 4000;
  const auto values =
      repeat(kValues, [](std::uint64_t seed) { return trackers::RandomStream(seed).normal(); });
  const Summary summary = summary_of(values);
  CHECK(summary.deviation_error == doctest::Approx(1.0 / std::sqrt(2.0 * kValues)).epsilon(0.15));
  CHECK(std::fabs(summary.deviation - 1.0) < 4.0 * summary.deviation_error);
}

TEST_CASE("one value has no error, and none has no summary") {
  const std::array<double, 1> one{2.0};
  CHECK(std::isnan(summary_of(one).mean_error));
  CHECK(std::isnan(summary_of(one).deviation));
  CHECK_THROWS_AS((void)summary_of({}), std::invalid_argument);
  CHECK_THROWS_AS((void)quantile_of({}, 0.5), std::invalid_argument);
}

TEST_CASE("quantiles; what is no number is large") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::array<double, 5> values{3.0, nan, 1.0, 2.0, 4.0};
  CHECK(quantile_of(values, 0.0) == 1.0);
  CHECK(quantile_of(values, 0.5) == 3.0);
  CHECK(std::isinf(quantile_of(values, 1.0)));
}

TEST_CASE("the error of a median is its deviation over repetitions, for a distribution that is not normal") {
  // Exponential values: the median of n has the deviation 1/sqrt(n), about, since the density there is 1/2.
  constexpr int kValues = 400;
  constexpr int kRepetitions = 600;
  std::vector<double> medians;
  double error = 0.0;
  for (int k = 0; k < kRepetitions; ++k) {
    trackers::RandomStream random(static_cast<std::uint64_t>(k) + 1);
    std::vector<double> values;
    for (int i = 0; i < kValues; ++i) {
      values.push_back(-std::log(random.uniform()));
    }
    const Median found = median_of(values);
    medians.push_back(found.value);
    error += found.error / kRepetitions;
  }
  const Summary over = summary_of(medians);
  CHECK(std::fabs(over.mean - std::log(2.0)) < 5.0 * over.mean_error + 2.0 / kValues);
  CHECK(error == doctest::Approx(over.deviation).epsilon(0.15));
  CHECK(over.deviation == doctest::Approx(1.0 / std::sqrt(kValues)).epsilon(0.15));
}

TEST_CASE("the median of one value has no error, and one among infinities is infinite") {
  const std::array<double, 1> one{2.0};
  CHECK(median_of(one).value == 2.0);
  CHECK(std::isnan(median_of(one).error));
  const double infinite = std::numeric_limits<double>::infinity();
  const std::array<double, 4> values{1.0, infinite, 2.0, infinite};
  CHECK_FALSE(std::isfinite(median_of(values).error));
  CHECK_THROWS_AS((void)median_of({}), std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::experiments
