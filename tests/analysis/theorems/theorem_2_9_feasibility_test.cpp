#include "analysis/theorems/theorem_2_9_feasibility.hpp"

#include <doctest/doctest.h>

#include <array>
#include <limits>

#include "tests/analysis/theorems/theorem_2_9_designs.hpp"
#include "tests/analysis/theorems/theorem_2_9_oracle.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Verdict;
using theorems::Theorem29Variant;

constexpr std::array kReadings{Theorem29Variant::printed, Theorem29Variant::errata};

TEST_CASE("no design of Table 3.2 can meet (2.43), in either reading, and none can at all") {
  for (const test::TableRow& row : test::kTable32) {
    for (const Theorem29Variant variant : kReadings) {
      const theorems::Feasibility found =
          theorems::theorem_2_9_feasibility(variant, test::table_design(row).input());
      CHECK(found.verdict == Verdict::refuted);
      CHECK(found.every_design);
      CHECK(found.witness.empty());
      REQUIRE(found.lower_bound.has_value());
      CHECK(found.lower_bound->lower() > 90.0);
      // The search gets within two decades of the bound: a bound that is far off would be suspicious.
      REQUIRE(found.best_found.size() == 5);
      const Interval& least = found.best_found.back().value;
      CHECK(least.lower() >= found.lower_bound->lower());
      CHECK(least.upper() <= 100.0 * found.lower_bound->upper());
    }
  }
}

// The oracle evaluates (2.43) as it stands, in 400-bit arithmetic.
TEST_CASE("random designs with random free parameters are above the lower bound") {
  test::Random random(2960);
  const std::int64_t count = test::effort(200);
  for (std::int64_t i = 0; i < count; ++i) {
    const test::TestDesign design = test::random_design(random);
    for (const Theorem29Variant variant : kReadings) {
      const theorems::Feasibility found = theorems::theorem_2_9_feasibility(variant, design.input());
      const auto oracle = test::theorem_2_9_oracle(
          variant == Theorem29Variant::errata, {design.q1, design.q2, design.r, design.state_bound,
                                                design.sigma, design.gamma_fraction, design.c1, design.c2});
      REQUIRE(found.verdict == Verdict::refuted);
      REQUIRE(found.lower_bound.has_value());
      CAPTURE(i);
      // lower_bound <= oracle <= infinity.
      CHECK(
          oracle.at("lhs_2_43").lies_in(found.lower_bound->lower(), std::numeric_limits<double>::infinity()));
    }
  }
}

TEST_CASE("without process noise in the plane the bound for every design remains") {
  test::TestDesign design;
  design.q1 = 0.0;
  design.q1_equals_q2 = false;
  const auto found = theorems::theorem_2_9_feasibility(Theorem29Variant::printed, design.input());
  CHECK(found.verdict == Verdict::refuted);
  CHECK(found.lower_bound->lower() > 90.0);
  CHECK(found.best_found.empty());
}

}  // namespace
