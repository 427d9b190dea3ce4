#include "analysis/quadrature/gaussian/lock_search.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/quadrature/gaussian/drift_inequality.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/gaussian/lock_sets.hpp"
#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

LockRequest request(std::size_t design, double decibels, int evaluations) {
  LockRequest result;
  result.design = test_sets::kDesigns[design];
  result.noise_deviation = std::sqrt(0.5 * std::pow(10.0, -decibels / 10.0));
  result.evaluations = evaluations;
  return result;
}

}  // namespace

TEST_CASE("proposals hold at points that the search has not looked at, the same ones each time") {
  const rigor::UpwardRounding upward;
  test::Random random(4330);
  for (std::size_t design = 0; design < 2; ++design) {
    const auto found = propose_lock_set(request(design, 20.0, 200));
    REQUIRE(found.has_value());
    MESSAGE("design " << design << ": margin " << found->margin);
    CHECK(found->margin > 0.05);
    const auto again = propose_lock_set(request(design, 20.0, 200));
    CHECK(again->set.weight == found->set.weight);
    CHECK(again->margin == found->margin);
    const trackers::ToneModel<double>& d = test_sets::kDesigns[design];
    const DriftInequality inequality({Interval(d.q1), Interval(d.q2), Interval(d.r), Interval(0.0)},
                                     found->set);
    for (int k = 0; k < 500; ++k) {
      std::array<double, 4> x{};
      double length = 0.0;
      for (double& value : x) {
        value = random.uniform(-1.0, 1.0);
        length += value * value;
      }
      for (double& value : x) {
        value *= std::sqrt(2.0 * found->set.level * random.uniform(0.0, 1.0) / length);
      }
      x[3] = std::fabs(x[3]) / std::sqrt(found->set.weight);
      CHECK(inequality.margin_at(x) > 0.0);
    }
  }
}

TEST_CASE("a design that is unlike La Scala's gets a proposal, too" * doctest::test_suite("nightly")) {
  const rigor::UpwardRounding upward;
  LockRequest unusual = request(0, 17.0, 400);
  unusual.design = {3.49, 0.318, 0.00998, 0.0};  // nearly a deadbeat filter
  unusual.frequency_walk = 0.00157;
  const auto found = propose_lock_set(unusual);
  REQUIRE(found.has_value());
  MESSAGE("margin " << found->margin);
  CHECK(found->margin > 0.1);
  CHECK(found->set.noise_deviation == unusual.noise_deviation);
  CHECK(found->set.frequency_walk == unusual.frequency_walk);
}

TEST_CASE("without a steady state nothing is proposed") {
  const rigor::UpwardRounding upward;
  LockRequest undriven = request(0, 20.0, 10);
  undriven.design.q1 = 0.0;
  CHECK_FALSE(propose_lock_set(undriven).has_value());
}

}  // namespace veritrack::quadrature
