#include "papers/claims/stability_lemma_claims.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

using namespace veritrack;
using rigor::Verdict;

TEST_CASE("the lemmas of chapter 2 stand but for an exponent, a sign, a constant and a chain") {
  const std::map<std::string, Verdict> expected{{"chapter-2/lemma-2.1", Verdict::proved},
                                                {"chapter-2/lemma-2.2", Verdict::proved},
                                                {"chapter-2/lemma-2.3/transition-matrix", Verdict::refuted},
                                                {"chapter-2/lemma-2.3/gain-derivative", Verdict::proved},
                                                {"chapter-2/lemma-2.3/lipschitz", Verdict::proved},
                                                {"chapter-2/lemma-2.4/size/printed", Verdict::refuted},
                                                {"chapter-2/lemma-2.4/size/corrected", Verdict::proved},
                                                {"chapter-2/lemma-2.4/gradient", Verdict::proved},
                                                {"chapter-2/lemma-2.5/second-derivative", Verdict::proved},
                                                {"chapter-2/lemma-2.5/covariance/printed", Verdict::refuted},
                                                {"chapter-2/lemma-2.5/covariance/corrected", Verdict::proved},
                                                {"chapter-2/theorem-2.6/chain/printed", Verdict::refuted},
                                                {"chapter-2/theorem-2.6/chain/corrected", Verdict::proved},
                                                {"chapter-2/corollary-2.6.1", Verdict::proved}};
  const rigor::UpwardRounding upward;
  std::map<std::string, Verdict> found;
  for (const theorems::Statement& statement : theorems::stability_lemma_claims()) {
    CHECK_FALSE(statement.witness.empty());
    CHECK(found.emplace(statement.id, statement.verdict).second);
  }
  CHECK(found == expected);
}

TEST_CASE("the witness of lemma 2.4 runs: the perturbation is 1, eta eps_r about a half") {
  double predicted = 1.0;
  for (int k = 0; k < 100; ++k) {
    const double gain = predicted / (predicted + 1.0);
    // w = 1, v = -1, no curvature.
    CHECK(std::abs((1.0 - gain) * 1.0 - gain * -1.0) == doctest::Approx(1.0));
    predicted = 0.25 * (1.0 - gain) * predicted + 1.0;
  }
  const double p = 1.2;
  const double q = 6.0;
  CHECK(std::max(p * q + p, p * q) / 16.0 == doctest::Approx(0.525));
}

TEST_CASE("runs that satisfy theorem 2.6 stay in the ball, though not below its printed sum at the start") {
  test::Random random(2'606);
  for (std::int64_t i = 0; i < test::effort(2000); ++i) {
    const double alpha = random.uniform(0.0, 0.9);
    const double zeta = random.uniform(0.0, 0.99 - alpha);
    const double eta = 0.99 - alpha - zeta;
    double z = random.uniform(0.0, 1.0);
    for (int k = 0; k < 50; ++k) {
      z = alpha * z + zeta * std::sin(z) + eta * random.uniform(-1.0, 1.0);
      REQUIRE(std::fabs(z) <= 1.0);
    }
  }
}
