#include "analysis/theorems/theorem_2_9_constants.hpp"

#include <doctest/doctest.h>

#include <complex>
#include <numbers>

#include "tests/analysis/theorems/theorem_2_9_designs.hpp"
#include "tests/analysis/theorems/theorem_2_9_oracle.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using theorems::Theorem29Variant;

constexpr double kRelativeWidth = 1e-12;

/// Every quantity of the derivation holds the oracle's value and is narrow.
void check_against_oracle(const test::TestDesign& design, Theorem29Variant variant) {
  const auto oracle = test::theorem_2_9_oracle(
      variant == Theorem29Variant::errata, {design.q1, design.q2, design.r, design.state_bound, design.sigma,
                                            design.gamma_fraction, design.c1, design.c2});
  const auto theorem = theorems::evaluate_theorem_2_9(variant, design.input());
  REQUIRE(theorem.derivation.quantities.size() == oracle.size());
  for (const theorems::Quantity& quantity : theorem.derivation.quantities) {
    CAPTURE(quantity.name);
    CAPTURE(design.q1);
    CAPTURE(design.q2);
    CAPTURE(design.r);
    CAPTURE(design.sigma);
    CAPTURE(design.gamma_fraction);
    CAPTURE(design.state_bound);
    REQUIRE(oracle.count(quantity.name) == 1);
    const test::Big& truth = oracle.at(quantity.name);
    REQUIRE_FALSE(quantity.not_applicable.has_value());
    REQUIRE(is_finite(quantity.value));
    REQUIRE(truth.lies_in(quantity.value.lower(), quantity.value.upper()));
    REQUIRE(quantity.value.upper() - quantity.value.lower() <=
            kRelativeWidth * std::fabs(quantity.value.lower()));
  }
}

}  // namespace

TEST_CASE("the constants of the Table 3.2 designs hold the values of 400-bit arithmetic") {
  for (const test::TableRow& row : test::kTable32) {
    CAPTURE(row.figure);
    check_against_oracle(test::table_design(row), Theorem29Variant::printed);
    check_against_oracle(test::table_design(row), Theorem29Variant::errata);
  }
}

TEST_CASE("the constants of random admissible designs hold the values of 400-bit arithmetic") {
  test::Random random(2900);
  const std::int64_t count = test::effort(2500);
  for (std::int64_t i = 0; i < count; ++i) {
    const test::TestDesign design = test::random_design(random);
    check_against_oracle(design, Theorem29Variant::printed);
    check_against_oracle(design, Theorem29Variant::errata);
  }
}

TEST_CASE("inputs an ulp wide hold the constants of both their ends") {
  const test::TestDesign design = test::table_design(test::kTable32[3]);
  auto input = design.input();
  const auto widened = [](double x) {
    return Interval::from_bounds(std::nextafter(x, 0.0), std::nextafter(x, 2.0 * x));
  };
  input.q1 = widened(design.q1);
  input.q2 = widened(design.q2);
  input.r = widened(design.r);
  input.sigma = widened(design.sigma);
  const auto oracle = test::theorem_2_9_oracle(
      false,
      {std::nextafter(design.q1, 0.0), std::nextafter(design.q2, 1.0), std::nextafter(design.r, 0.0),
       design.state_bound, std::nextafter(design.sigma, 1.0), design.gamma_fraction, design.c1, design.c2});
  for (const auto& quantity :
       theorems::evaluate_theorem_2_9(Theorem29Variant::printed, input).derivation.quantities) {
    CAPTURE(quantity.name);
    CHECK(oracle.at(quantity.name).lies_in(quantity.value.lower(), quantity.value.upper()));
    CHECK(quantity.value.upper() - quantity.value.lower() <=
          kRelativeWidth * std::fabs(quantity.value.lower()));
  }
}

TEST_CASE("sqrt(1 - gamma/q) always exists: s q p^2 is at least 64 for every admissible design") {
  test::Random random(2901);
  const std::int64_t count = test::effort(2000);
  for (std::int64_t i = 0; i < count; ++i) {
    test::TestDesign design = test::random_design(random);
    design.sigma = random.uniform(0.0, std::numbers::sqrt2 / 2.0);
    design.q1 = design.q2 * std::pow(10.0, random.uniform(-3.0, 6.0));  // q1 > q2 as well
    for (const bool errata : {false, true}) {
      const auto oracle = test::theorem_2_9_oracle(
          errata, {design.q1, design.q2, design.r, design.state_bound, design.sigma, 0.5, 1.0, 1.0});
      const double product = (oracle.at("s") * oracle.at("q") * oracle.at("p") * oracle.at("p")).to_double();
      CHECK(product >= 64.0);
    }
  }
}

TEST_CASE("the largest initial error is an upper bound on random starts, and is attained") {
  test::Random random(2902);
  const std::int64_t count = test::effort(20000);
  for (std::int64_t i = 0; i < count; ++i) {
    const double amplitude = random.uniform(0.1, 3.0);
    const double amplitude_error = random.uniform(0.0, 1.5);
    const double phase_error = random.uniform(0.0, 4.0);
    const double frequency_error = random.uniform(0.0, 0.5);
    const Interval bound = theorems::largest_initial_error(Interval(amplitude), Interval(amplitude_error),
                                                           Interval(phase_error), Interval(frequency_error));
    REQUIRE(is_finite(bound));
    const auto norm = [&](double da, double dp, double df) {
      const std::complex<double> error = std::polar(1.0, dp) * (amplitude + da) - amplitude;
      return std::hypot(std::abs(error), df);
    };
    const double sample =
        norm(random.uniform(-1.0, 1.0) * amplitude_error, random.uniform(-1.0, 1.0) * phase_error,
             random.uniform(-1.0, 1.0) * frequency_error);
    CHECK(sample <= bound.upper() * (1.0 + 1e-14));
    const double worst = norm(amplitude_error, std::min(phase_error, std::numbers::pi), frequency_error);
    CHECK(std::fabs(worst - bound.upper()) <= 1e-12 * worst);
    CHECK(bound.upper() - bound.lower() <= 1e-13 * bound.upper());
  }
  const Interval one(1.0);
  CHECK(is_empty(theorems::largest_initial_error(one, Interval(-0.1), one, one)));
  CHECK(is_empty(theorems::largest_initial_error(one, Interval(), one, one)));
}
