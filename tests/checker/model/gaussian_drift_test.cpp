#include "checker/model/gaussian_drift.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

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

TEST_CASE("the terms of a set in Gaussian noise are positive, and its factor is below 1") {
  const auto objections_with = [](const std::string& name, const std::string& value) {
    nlohmann::json terms;
    for (const char* each : {"deviation", "most_noise", "exponent", "factor", "constant"}) {
      terms[each] = "0x1p-1";
    }
    terms[name] = value;
    nlohmann::json set = nlohmann::json::parse(R"({"name": "assumed", "cells": [{
        "frequency": "0x1p-2", "half_width": "0x1p-6", "levels": ["0x1p-3"], "turns": [0],
        "curve": [[[["0x1p-2", "0x0p+0"]]]], "shape": [[[["0x1p-2", "0x0p+0"]]]],
        "phases": 64, "frequencies": 1}]})");
    set["gaussian"] = terms;
    Objections objections;
    (void)read_tube_set(read_json(set.dump()), 1, objections);
    return objections;
  };
  CHECK(objections_with("factor", "0x1.fffffp-1").empty());
  CHECK(objections_with("factor", "0x1p+0") == Objections{"gaussian: factor must be below 1"});
  CHECK(objections_with("factor", "0x1.4p+0") == Objections{"gaussian: factor must be below 1"});
  for (const char* name : {"deviation", "most_noise", "exponent", "factor", "constant"}) {
    CHECK(objections_with(name, "0x0p+0") ==
          Objections{std::string("gaussian: ") + name + " must be positive"});
  }
}

TEST_CASE("noise that is shorter than a deviation of all channels says nothing") {
  const GaussianTerms terms{1.0, 1.0, 30.0, 0.9, 1.0};
  CHECK(certainly_at_most(one, leaving_probability(terms, 2, Ball(10.0), zero)));
}

}  // namespace
}  // namespace veritrack::checker
