#include "analysis/quadrature/gaussian/linear_filter.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/quadrature/contraction/covariance_proposal.hpp"
#include "tests/analysis/quadrature/gaussian/lock_sets.hpp"
#include "tests/support/random.hpp"

namespace veritrack::quadrature {

TEST_CASE("the linear filter's variance is the one of gaussian.md's table, and of the fixed point") {
  // Deviations of the frequency at 17 dB, section 7 of the derivation: constant, and w^2 = q2.
  const std::array<std::array<double, 4>, 4> rows{{{0.0005, 0.01, 0.0185, 0.0392},
                                                   {0.0013, 0.01, 0.0257, 0.0567},
                                                   {0.0065, 0.01, 0.0422, 0.1071},
                                                   {0.0023, 0.05, 0.0179, 0.0770}}};
  const double deviation = std::sqrt(0.5 * std::pow(10.0, -1.7));
  for (const auto& [q, r, constant, walking] : rows) {
    const trackers::ToneModel<double> design{q, q, r, 0.0};
    const auto filter = linear_filter(design, level_covariance(*steady_covariance(design)));
    REQUIRE(filter);
    CHECK(std::sqrt(frequency_variance(*filter, deviation, 0.0)) == doctest::Approx(constant).epsilon(0.006));
    CHECK(std::sqrt(frequency_variance(*filter, deviation, std::sqrt(q))) ==
          doctest::Approx(walking).epsilon(0.006));
    // X = A X A' + sigma^2 K K' + w^2 e2 e2', summed as a series.
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    for (int k = 0; k < 2000; ++k) {
      sum = (filter->errors * sum * filter->errors.transpose() +
             deviation * deviation * filter->gain * filter->gain.transpose())
                .eval();
      sum(1, 1) += q;
    }
    CHECK(frequency_variance(*filter, deviation, std::sqrt(q)) == doctest::Approx(sum(1, 1)).epsilon(1e-9));
  }
}

TEST_CASE("a filter that does not settle has no variance") {
  const LevelCovariance<double> none{0.0, 0.0, 0.0, 0.0};
  CHECK_FALSE(linear_filter({0.0, 0.0, 0.01, 0.0}, none));
}

TEST_CASE(
    "no filter has less than the posterior Cramer-Rao bound, and the one for that noise has just that") {
  CHECK(least_frequency_variance(0.1, 0.0) == 0.0);
  test::Random random(4410);
  for (int k = 0; k < 20; ++k) {
    const double deviation = std::pow(10.0, random.uniform(-2.0, 0.0));
    const double walk = deviation * std::pow(10.0, random.uniform(-3.0, 0.0));
    const double least = least_frequency_variance(deviation, walk);
    // Gains of all designs, near the best one and far from it.
    double closest = 1e9;
    for (int l = 0; l < 200; ++l) {
      const double q = walk * walk * std::pow(10.0, random.uniform(-2.0, 2.0));
      const double p = walk * walk * std::pow(10.0, random.uniform(-9.0, 0.0));
      const trackers::ToneModel<double> design{p, q, deviation * deviation, 0.0};
      const auto covariance = steady_covariance(design);
      const auto filter = covariance ? linear_filter(design, level_covariance(*covariance)) : std::nullopt;
      if (filter) {
        const double variance = frequency_variance(*filter, deviation, walk);
        CHECK(variance >= least * (1.0 - 1e-6));
        closest = std::min(closest, variance / least);
      }
    }
    CHECK(closest < 1.1);
  }
}

}  // namespace veritrack::quadrature
