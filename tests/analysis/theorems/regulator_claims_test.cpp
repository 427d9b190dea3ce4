#include "analysis/theorems/regulator_claims.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <string>

#include "analysis/rigor/rounding.hpp"

using namespace veritrack;
using rigor::Verdict;

TEST_CASE("what chapter 5 prints is decided as its numbers are right or wrong") {
  const std::map<std::string, Verdict> expected{{"chapter-3/frequency-variance", Verdict::proved},
                                                {"chapter-5/example-denominator", Verdict::proved},
                                                {"chapter-5/example-poles", Verdict::proved},
                                                {"chapter-5/example-frequency", Verdict::proved},
                                                {"chapter-5/efra-constraints", Verdict::proved},
                                                {"chapter-5/efra-upper-bound", Verdict::refuted},
                                                {"chapter-5/efra-upper-approximation", Verdict::proved},
                                                {"chapter-5/efra-lower-bound/printed", Verdict::refuted},
                                                {"chapter-5/efra-lower-bound/corrected", Verdict::proved},
                                                {"chapter-5/efra-lower-approximation", Verdict::proved},
                                                {"chapter-5/efra-lower-bound-holds", Verdict::refuted}};
  const rigor::UpwardRounding upward;
  std::map<std::string, Verdict> found;
  for (const theorems::Statement& statement : theorems::regulator_claims()) {
    CHECK_FALSE(statement.witness.empty());
    CHECK(found.emplace(statement.id, statement.verdict).second);
  }
  CHECK(found == expected);
}

TEST_CASE(
    "a covariance that EFRA has driven for long is below the printed lower bound, and above the corrected "
    "one") {
  // One parameter and a regressor that is large in every sample.
  double covariance = 0.8003;
  for (int k = 0; k < 1000; ++k) {
    const double gain = 1e12 * covariance / (1.0 + 1e12 * covariance);
    covariance = covariance / 0.95 - 0.5 * gain * covariance + 0.005 - 0.005 * covariance * covariance;
  }
  CHECK(covariance < 0.0112);
  CHECK(covariance > 0.0111);
}
