#include "papers/claims/design_paper_claims.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "analysis/rigor/rounding.hpp"
#include "analysis/statements/paper_findings.hpp"
#include "papers/claims/paper_places.hpp"
#include "tests/analysis/theorems/theorem_2_9_designs.hpp"
#include "trackers/signals/random.hpp"

using namespace veritrack;
using rigor::Verdict;

namespace {

std::vector<theorems::Statement> all_claims() {
  const rigor::UpwardRounding upward;
  std::vector<theorems::Statement> statements = theorems::design_paper_claims();
  for (auto part : {theorems::design_paper_lemma_claims(), theorems::design_paper_loop_claims()}) {
    statements.insert(statements.end(), part.begin(), part.end());
  }
  return statements;
}

}  // namespace

TEST_CASE("what the 1996 paper says is decided, each sentence once, with its place") {
  const std::set<std::string> refuted{"paper-1996/locally-observable/printed",
                                      "paper-1996/lemma-1/admits",
                                      "paper-1996/predicted",
                                      "paper-1996/over-design/printed",
                                      "paper-1996/under-estimate",
                                      "paper-1996/gramian/bounded",
                                      "paper-1996/r-less-critical",
                                      "paper-1996/slew-by-variance",
                                      "paper-1996/figure-5/over-design"};
  std::set<std::string> found;
  for (const theorems::Statement& statement : all_claims()) {
    CAPTURE(statement.id);
    CAPTURE(statement.witness);
    CHECK(found.insert(statement.id).second);
    CHECK_FALSE(statement.witness.empty());
    CHECK(statement.verdict == (refuted.contains(statement.id) ? Verdict::refuted : Verdict::proved));
    CHECK((theorems::find_paper_finding(statement.id) != nullptr || statement.verdict == Verdict::proved));
    CHECK(theorems::paper_place(statement.id).paper == theorems::Paper::la_scala_bitmead_1996);
  }
  CHECK(found.size() == 27);
}

TEST_CASE("Lemma 1 on random designs: the bound (2.45) rises with q1 up to q2, in either reading") {
  test::Random random(1996);
  for (std::int64_t i = 0; i < test::effort(100); ++i) {
    auto input = test::random_design(random).input();
    for (const auto variant : {theorems::Theorem29Variant::printed, theorems::Theorem29Variant::errata}) {
      double before = 0.0;
      for (const double share : {0.01, 0.1, 0.5, 1.0}) {
        const rigor::UpwardRounding upward;
        input.q1 = rigor::Interval(share) * input.q2;
        const double bound =
            rigor::midpoint(theorems::theorem_2_9_constants(variant, input).initial_error_bound);
        CHECK(bound >= before * (1.0 - 1e-9));
        before = bound;
      }
      CHECK(before > 0.0);
    }
  }
}

TEST_CASE("an under-designed filter, simulated: its errors outgrow what it computes") {
  // The mean square over runs of the random walk of the witness, 400 runs of 1000 samples.
  trackers::RandomStream random(12);
  double sum = 0.0;
  constexpr int kRuns = 400;
  for (int run = 0; run < kRuns; ++run) {
    double truth = random.normal();
    double estimate = 0.0;
    for (int k = 0; k < 1000; ++k) {
      estimate += (truth + random.normal() - estimate) / (k + 2.0);
      truth += random.normal();
    }
    sum += (truth - estimate) * (truth - estimate);
  }
  CHECK(sum / kRuns == doctest::Approx(334.0).epsilon(0.25));
}
