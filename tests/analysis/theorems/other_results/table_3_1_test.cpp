#include "analysis/theorems/other_results/table_3_1.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/analysis/theorems/tracker_inputs.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Verdict;
using theorems::Theorem29Variant;

/// log(s p^2 q) and log(p q) of the errata reading, written down again.
struct Logarithms {
  double alpha, beta;
};
Logarithms errata(const test::TestDesign& d) {
  const double p = d.q2 + 2.0 * d.r / d.sigma;
  const double q = 1.0 / d.q1 + 5.0 / d.r;
  const double rho = 2.0 * (d.state_bound + 1.0 - d.sigma);
  const double s = q + rho * rho / d.q1;
  return {std::log(s) + 2.0 * std::log(p) + std::log(q), std::log(p) + std::log(q)};
}

}  // namespace

TEST_CASE("Table 3.1: as printed only the word maximised fails; with the errata all of it holds") {
  for (const test::TableRow& row : test::kTable32) {
    CAPTURE(row.figure);
    const theorems::TrackerInput input = test::tracker_input(test::table_design(row));
    const auto printed = theorems::evaluate_table_3_1(Theorem29Variant::printed, input);
    const auto errata = theorems::evaluate_table_3_1(Theorem29Variant::errata, input);
    for (const theorems::Condition& condition : printed.conditions) {
      INFO(condition.id, ": ", condition.reason);
      CHECK(condition.verdict == (condition.id == "alpha-r" ? Verdict::refuted : Verdict::proved));
    }
    for (const theorems::Condition& condition : errata.conditions) {
      INFO(condition.id, ": ", condition.reason);
      CHECK(condition.verdict == Verdict::proved);
    }
  }
}

TEST_CASE("the stationary points are minima of the constants computed in double") {
  test::Random random(101);
  for (std::int64_t i = 0; i < test::effort(20); ++i) {
    INFO("seed ", test::kSeed + 101, ", design ", i);
    test::TestDesign design = test::random_design(random);
    design.sigma = random.uniform(0.05, 0.5);
    const auto derivation =
        theorems::evaluate_table_3_1(Theorem29Variant::errata, test::tracker_input(design));
    const Interval alpha = test::value_of(derivation, "r_alpha");
    const Interval beta = test::value_of(derivation, "r_beta");
    REQUIRE((is_finite(alpha) && is_finite(beta)));
    test::TestDesign best = design;
    for (const double factor : {0.5, 2.0}) {
      test::TestDesign other = design;
      best.r = alpha.lower();
      other.r = factor * alpha.lower();
      CHECK(errata(best).alpha < errata(other).alpha);
      best.r = beta.lower();
      other.r = factor * beta.lower();
      CHECK(errata(best).beta < errata(other).beta);
    }
    CHECK(beta.lower() ==
          doctest::Approx(std::sqrt(2.5 * design.q1 * design.q2 * design.sigma)).epsilon(1e-6));
  }
}

TEST_CASE("q1 = 0 and values unknown decide nothing") {
  theorems::TrackerInput input = test::tracker_input(test::table_design(test::kTable32[0]));
  input.theorem_2_9.q1_equals_q2 = false;
  for (const Interval& q1 :
       {Interval(0.0), Interval::from_bounds(0.0, std::numeric_limits<double>::infinity())}) {
    input.theorem_2_9.q1 = q1;
    for (const auto& condition : theorems::evaluate_table_3_1(Theorem29Variant::errata, input).conditions) {
      CHECK(condition.verdict == Verdict::undecided);
    }
  }
}

TEST_CASE("a sigma out of its range, where the constants mean nothing, decides nothing") {
  test::TestDesign design = test::table_design(test::kTable32[3]);
  for (const double sigma : {-0.001, 0.0, 0.8, 1.5}) {
    CAPTURE(sigma);
    design.sigma = sigma;
    for (const auto variant : {Theorem29Variant::printed, Theorem29Variant::errata}) {
      if (sigma == 0.8 && variant == Theorem29Variant::errata) {
        continue;
      }
      for (const auto& condition :
           theorems::evaluate_table_3_1(variant, test::tracker_input(design)).conditions) {
        CHECK(condition.verdict == Verdict::undecided);
      }
    }
  }
}

TEST_CASE("an r that is stationary beyond the numbers that are looked at is not found") {
  test::TestDesign design = test::table_design(test::kTable32[3]);
  for (const double size : {1e-45, 1e45}) {
    CAPTURE(size);
    design.q1 = design.q2 = design.r = size;
    for (const auto& condition :
         theorems::evaluate_table_3_1(Theorem29Variant::errata, test::tracker_input(design)).conditions) {
      if (condition.id == "alpha-r" || condition.id == "beta-r" || condition.id.starts_with("r_")) {
        CHECK(condition.verdict == Verdict::undecided);
      }
    }
  }
}

TEST_CASE("q1 > q2, for which the thesis gives the opposite signs: not applicable, and nothing is decided") {
  test::TestDesign design = test::table_design(test::kTable32[3]);
  design.q1_equals_q2 = false;
  design.q1 = 1.5 * design.q2;
  for (const auto variant : {Theorem29Variant::printed, Theorem29Variant::errata}) {
    const auto derivation = theorems::evaluate_table_3_1(variant, test::tracker_input(design));
    CHECK(derivation.verdict == Verdict::undecided);
    for (const theorems::Condition& condition : derivation.conditions) {
      INFO(condition.id, ": ", condition.reason);
      CHECK(condition.verdict == Verdict::undecided);
      CHECK(condition.reason.find("q_1 > q_2") != std::string::npos);
    }
    for (const theorems::Quantity& quantity : derivation.quantities) {
      CHECK_FALSE(quantity.applies());
    }
  }
  // With q1 < q2 the table is decided, in doubles that are not the same number.
  design.q1 = 0.5 * design.q2;
  CHECK(theorems::evaluate_table_3_1(Theorem29Variant::errata, test::tracker_input(design)).verdict ==
        Verdict::proved);
}
