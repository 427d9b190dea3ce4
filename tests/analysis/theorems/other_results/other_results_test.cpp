#include "analysis/theorems/other_results/other_results.hpp"

#include <doctest/doctest.h>

#include <set>

#include "tests/analysis/theorems/tracker_inputs.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Verdict;

}  // namespace

TEST_CASE("every result has an id of its own, reasons, and quantities that are finite or say why not") {
  for (const test::TableRow& row : test::kTable32) {
    std::set<std::string> ids;
    for (const auto& derivation :
         theorems::evaluate_other_results(test::tracker_input(test::table_design(row)))) {
      CAPTURE(derivation.id);
      CHECK(ids.insert(derivation.id).second);
      CHECK_FALSE(derivation.conditions.empty());
      std::set<std::string> names;
      for (const auto& quantity : derivation.quantities) {
        CAPTURE(quantity.name);
        CHECK(names.insert(quantity.name).second);
        CHECK(is_finite(quantity.value) != quantity.not_applicable.has_value());
      }
      for (const auto& condition : derivation.conditions) {
        CHECK_MESSAGE(!condition.reason.empty(), condition.id);
      }
    }
    CHECK(ids.size() == 17);
  }
}

TEST_CASE("nothing is proved from values that are not finite") {
  // What is proved all the same is about no design at all.
  const std::set<std::string> without_design = {"printed-gram"};
  for (const Interval& bad : {Interval::empty(), Interval::entire()}) {
    theorems::TrackerInput input;
    input.theorem_2_9.q1 = input.theorem_2_9.q2 = input.theorem_2_9.r = input.theorem_2_9.epsilon = bad;
    input.theorem_2_9.sigma = input.theorem_2_9.state_bound = input.theorem_2_9.gamma_fraction = bad;
    input.theorem_2_9.c1 = input.theorem_2_9.c2 = bad;
    input.theorem_2_9.initial_error = input.theorem_2_9.measurement_noise = input.theorem_2_9.process_noise =
        bad;
    for (const auto& derivation : theorems::evaluate_other_results(input)) {
      CAPTURE(derivation.id);
      CHECK(derivation.verdict != Verdict::proved);
      for (const auto& condition : derivation.conditions) {
        CHECK_MESSAGE((condition.verdict != Verdict::proved || without_design.contains(condition.id)),
                      condition.id);
      }
      for (const auto& quantity : derivation.quantities) {
        CHECK_MESSAGE((quantity.not_applicable || quantity.name == "radius" ||
                       quantity.name == "epsilon_prime" || quantity.name == "a_bar" ||
                       quantity.name == "curvature" || quantity.name == "phase_term_printed"),
                      quantity.name);
      }
    }
  }
}
