#include "papers/claims/tracker_theory_claims.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>

#include "analysis/rigor/rounding.hpp"

using namespace veritrack;
using rigor::Verdict;

TEST_CASE("theorem 2.8 needs its start bounded, Picard's hypotheses fail, the footnote to Table 3.1 stands") {
  const std::set<std::string> refuted{"chapter-2/theorem-2.8/start",
                                      "chapter-2/theorem-2.4/inverse-derivative", "picard/injective",
                                      "picard/almost-linear-f"};
  const rigor::UpwardRounding upward;
  std::map<std::string, Verdict> found;
  for (const theorems::Statement& statement : theorems::tracker_theory_claims()) {
    CAPTURE(statement.id);
    CHECK_FALSE(statement.witness.empty());
    CHECK(found.emplace(statement.id, statement.verdict).second);
    const Verdict expected = statement.id == "chapter-2/theorem-2.8/bounded-start" ? Verdict::undecided
                             : refuted.contains(statement.id)                      ? Verdict::refuted
                                                                                   : Verdict::proved;
    CHECK(statement.verdict == expected);
  }
  CHECK(found.size() == 21);
}

TEST_CASE("the witness against theorem 2.8 runs: the error grows beyond its bound in one sample") {
  const double r = 25.0;
  double covariance = 1e-3;
  double z = 1.0;
  double first = 0.0;
  for (int k = 0; k < 50; ++k) {
    const double predicted = 100.0 * covariance + 1.0;
    const double gain = predicted / (predicted + r);
    z = (1.0 - gain) * 10.0 * z;
    covariance = (1.0 - gain) * predicted;
    first = k == 0 ? z : first;
  }
  const double p = 1.0 + r / 1.01;
  const double q = 1.0 + 1.01 / r;
  CHECK(first > std::sqrt(p * q));
  CHECK(first == doctest::Approx(10.0 * r / (1.1 + r)));
  // The filter itself is stable: the bound is about the start.
  CHECK(std::fabs(z) < 1e-3);
}
