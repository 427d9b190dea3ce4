#include "papers/claims/regulator_claims.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

using namespace veritrack;
using rigor::Verdict;

TEST_CASE("what chapter 5 prints is decided as its numbers are right or wrong") {
  const std::map<std::string, Verdict> expected{
      {"chapter-3/frequency-variance", Verdict::proved},
      {"chapter-5/example-denominator", Verdict::proved},
      {"chapter-5/example-poles", Verdict::proved},
      {"chapter-5/example-frequency", Verdict::proved},
      {"chapter-5/efra-constraints", Verdict::proved},
      {"chapter-5/efra-upper-bound", Verdict::refuted},
      {"chapter-5/efra-upper-approximation", Verdict::proved},
      {"chapter-5/efra-lower-bound/printed", Verdict::refuted},
      {"chapter-5/efra-lower-bound/corrected", Verdict::proved},
      {"chapter-5/efra-lower-approximation", Verdict::proved},
      {"chapter-5/efra-lower-bound-holds", Verdict::refuted},
      {"chapter-5/efra-interval/corrected", Verdict::proved},
      {"chapter-5/theorem-5.2/a-posteriori-error", Verdict::proved},
      {"chapter-5/theorem-5.2/lyapunov-function", Verdict::proved},
      {"chapter-5/corollary-5.2.1/step/printed", Verdict::refuted},
      {"chapter-5/corollary-5.2.1/step/corrected", Verdict::proved}};
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

TEST_CASE(
    "EFRA keeps a covariance between its corrected bounds, for any admissible choice and any regressor") {
  test::Random random(20'253);
  int admissible = 0;
  const std::int64_t cases = test::effort(3000);
  for (std::int64_t i = 0; i < cases; ++i) {
    const double alpha = random.uniform(0.01, 0.99);
    const double gamma = random.uniform(0.001, 0.999);
    const double beta = random.uniform(0.0, 1.0);
    const double delta = random.uniform(0.0, 1.0);
    const double constraint = (gamma - alpha) * (gamma - alpha) + 4.0 * beta * delta;
    if (!(constraint < (1.0 - alpha) * (1.0 - alpha)) || !(beta > 1e-6) || !(delta > 1e-6)) {
      continue;
    }
    ++admissible;
    const double lower = (gamma - alpha + std::sqrt(constraint)) / (2.0 * delta);
    const double upper = (gamma + std::sqrt(gamma * gamma + 4.0 * beta * delta)) / (2.0 * delta);
    Eigen::Matrix2d p = Eigen::Vector2d(lower, upper).asDiagonal();
    for (int k = 0; k < 20; ++k) {
      const double angle = random.uniform(0.0, 3.2);
      const Eigen::Vector2d phi =
          std::pow(10.0, random.uniform(-3.0, 5.0)) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      const Eigen::Vector2d g = p * phi;
      p = ((1.0 + gamma) * p - alpha * g * g.transpose() / (1.0 + phi.dot(g)) +
           beta * Eigen::Matrix2d::Identity() - delta * p * p)
              .eval();
      const Eigen::Vector2d values = oracle::symmetric_eigenvalues(p);
      REQUIRE(values(0) >= lower * (1.0 - 1e-6));
      REQUIRE(values(1) <= upper * (1.0 + 1e-6));
    }
  }
  CHECK(admissible > cases / 50);
}
