#include "papers/claims/paper_places.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

#include "analysis/statements/paper_findings.hpp"
#include "analysis/theorems/other_results/other_results.hpp"
#include "analysis/theorems/theorem_2_9_gaps.hpp"
#include "tests/analysis/theorems/tracker_inputs.hpp"

namespace {

using namespace veritrack;
using theorems::Paper;
using theorems::PaperRole;

}  // namespace

TEST_CASE("every statement and every condition of a published theorem has a place, ours have none") {
  const theorems::TrackerInput input = test::tracker_input(test::table_design(test::kTable32[0]));
  for (const theorems::Statement& statement : theorems::theorem_2_9_gaps(input.theorem_2_9)) {
    CAPTURE(statement.id);
    CHECK(theorems::is_published(statement.id));
  }
  for (const theorems::Derivation& derivation : theorems::evaluate_other_results(input)) {
    const bool ours = derivation.id.ends_with("/local") || derivation.id.ends_with("/corrected") ||
                      derivation.id.ends_with("/two-step");
    for (const theorems::Condition& condition : derivation.conditions) {
      const std::string id = derivation.id + "/" + condition.id;
      CAPTURE(id);
      CHECK(theorems::is_published(id) != ours);
    }
    CHECK_FALSE(theorems::is_published(derivation.id + "/conditions"));
  }
}

TEST_CASE("every finding in print is about a claim with a place, which is the finding's") {
  for (const theorems::PaperFinding& finding : theorems::paper_findings()) {
    CAPTURE(finding.claim);
    REQUIRE(theorems::is_published(finding.claim));
    const theorems::PaperPlace place = theorems::paper_place(finding.claim);
    CHECK(place.place == finding.place);
    CHECK(place.role == PaperRole::sentence);
  }
}

TEST_CASE("a place names the publication, the equation and the reading") {
  const theorems::PaperPlace condition = theorems::paper_place("theorem-2.9/printed/2.43");
  CHECK(condition.paper == Paper::la_scala_1994);
  CHECK(condition.role == PaperRole::hypothesis);
  CHECK(condition.place == "thesis, theorem 2.9, (2.43)");
  CHECK_FALSE(condition.repair.empty());
  CHECK(theorems::paper_place("theorem-2.9/rho_1/errata").place ==
        "thesis, section 3.5, with the errata sheet");
  CHECK(theorems::paper_place("theorem-2.9/gramian-eigenvalue/repaired").role == PaperRole::repair);
  CHECK(theorems::paper_place("proposition-1/response-corrected").role == PaperRole::repair);
  CHECK(theorems::paper_place("kkl-paper/dimensions").paper == Paper::praly_marconi_isidori);
  CHECK(theorems::paper_place("reif-1999/noise").paper == Paper::cited);
}

TEST_CASE("a claim about a design has no place") {
  for (const char* claim :
       {"ekf/guarantee", "contraction/error", "theorem-2.9/repaired/2.45", "", "theorem-2.9"}) {
    CAPTURE(claim);
    CHECK_FALSE(theorems::is_published(claim));
    CHECK_THROWS_AS((void)theorems::paper_place(claim), std::out_of_range);
  }
}
