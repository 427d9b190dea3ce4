// Conditions on the model and the covariance that a design may fail by little.
#include <doctest/doctest.h>

#include <string>

#include "checker/theorems/published_results_parts.hpp"

using namespace veritrack::checker;

namespace {

Design design_of(double q1, double q2, double r) {
  Design design;
  design.q1 = Ball(q1);
  design.q2 = Ball(q2);
  design.r = Ball(r);
  design.epsilon = zero;
  design.state_bound = Ball(7.0);
  design.sigma = Ball(0.01);
  design.gamma_fraction = half;
  design.c1 = design.c2 = Ball(3.0);
  return design;
}

Verdict verdict_of(const Derivation& derivation, const std::string& id) {
  for (const Condition& condition : derivation.conditions) {
    if (condition.id == id) {
      return condition.verdict;
    }
  }
  FAIL("no condition " << id);
  return Verdict::undecided;
}

Verdict of_riccati_bounds(const Design& design, const std::string& id) {
  return verdict_of(riccati_bounds(design, Tree(Tree::Kind::object)), id);
}

}  // namespace

TEST_CASE("the information bound takes in the process noise of the frequency") {
  for (const std::string id : {"q-printed", "q-errata"}) {
    CAPTURE(id);
    CHECK(of_riccati_bounds(design_of(0.01, 0.01, 1.0), id) == Verdict::proved);
    CHECK(of_riccati_bounds(design_of(1.0, 0.001, 1.0), id) == Verdict::undecided);
  }
}

TEST_CASE("a covariance bound that a filter exceeds is none") {
  CHECK(of_riccati_bounds(design_of(0.01, 0.01, 1.0), "p-printed") == Verdict::proved);
  CHECK(of_riccati_bounds(design_of(1e6, 0.01, 1.0), "p-printed") == Verdict::refuted);
  CHECK(of_riccati_bounds(design_of(1e6, 0.01, 1.0), "p-errata") == Verdict::undecided);
}

TEST_CASE("a sigma that is hardly known refutes nothing") {
  Design design = design_of(0.01, 0.01, 1.0);
  design.sigma = Ball::hull(Ball(0.001), Ball(0.7));
  CHECK(of_riccati_bounds(design, "p-printed") == Verdict::undecided);
}

TEST_CASE("over-design is compared with the filter, and under-design with the optimal one") {
  const Design design = design_of(0.01, 0.01, 1.0);
  const Derivation found = theorem_3_2(design, Tree(Tree::Kind::object));
  CHECK(verdict_of(found, "over-design") == Verdict::proved);
  CHECK(verdict_of(found, "under-design") != Verdict::refuted);
  // Half the noise, under the same gains, halves what the noise leaves.
  const Ball over = found.quantities[0].value.low;
  CHECK(certainly_positive(over));
  CHECK(found.quantities[0].name == "over_design_gap");
}
