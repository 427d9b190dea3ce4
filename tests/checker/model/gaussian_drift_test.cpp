#include "checker/model/gaussian_drift.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/model/gaussian/gaussian_set.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace veritrack::checker {
namespace {

TEST_CASE(
    "the probability of leaving a set is what the certificate's program computes, and what it is by hand") {
  test::Random random(5);
  for (int i = 0; i < 50; ++i) {
    GaussianTerms terms;
    terms.deviation = random.uniform(0.01, 0.2);
    terms.most_noise = terms.deviation * random.uniform(6.0, 9.0);
    terms.exponent = random.uniform(10.0, 35.0);
    terms.factor = random.uniform(0.9, 0.9999);
    terms.constant = random.uniform(0.1, 5.0);
    const double share = random.uniform(0.0, 0.9);
    const double samples = std::pow(10.0, random.uniform(1.0, 8.0));
    const int channels = 1 + static_cast<int>(random.below(2));
    const double found =
        leaving_probability(terms, static_cast<std::size_t>(channels), Ball(samples), Ball(share)).near();
    const double q = terms.most_noise / terms.deviation;
    const double tail = std::pow(std::exp(1.0) * q * q / channels, 0.5 * channels) * std::exp(-0.5 * q * q);
    const double by_hand = std::exp(-terms.exponent) *
                               (std::exp(terms.exponent * share * share) +
                                (terms.constant + tail * std::exp(terms.exponent)) / (1.0 - terms.factor) +
                                samples * terms.constant) +
                           samples * tail;
    CHECK(found == doctest::Approx(by_hand).epsilon(1e-9));
    const rigor::UpwardRounding upward;
    const model::GaussianTerms same{terms.deviation, terms.most_noise, terms.exponent, terms.factor,
                                    terms.constant};
    const double other = model::leaving_probability(same, channels, rigor::Interval(samples), share);
    CHECK(other == doctest::Approx(found).epsilon(1e-12));
    CHECK(other >= leaving_probability(terms, static_cast<std::size_t>(channels), Ball(samples), Ball(share))
                       .lower_double());
  }
}

TEST_CASE("noise that is shorter than a deviation of all channels says nothing") {
  const GaussianTerms terms{1.0, 1.0, 30.0, 0.9, 1.0};
  CHECK(certainly_at_most(one, leaving_probability(terms, 2, Ball(10.0), zero)));
}

}  // namespace
}  // namespace veritrack::checker
