#include "papers/kkl_observer/injectivity_claims.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "tests/support/oracles.hpp"

using namespace veritrack;
using rigor::Verdict;

TEST_CASE("the printed injectivity constant is too small, there is none on all of O, and either (9) does") {
  std::map<std::string, Verdict> found;
  for (const theorems::Statement& statement : kkl_observer::injectivity_claims()) {
    CHECK_FALSE(statement.witness.empty());
    CHECK(found.emplace(statement.id, statement.verdict).second);
  }
  CHECK(found == std::map<std::string, Verdict>{{"kkl-paper/injectivity-constant", Verdict::refuted},
                                                {"kkl-paper/not-lipschitz", Verdict::proved},
                                                {"kkl-paper/factor-two", Verdict::proved}});
}

TEST_CASE("the witness in double, with a singular value decomposition: 240.1 against 188.3") {
  const std::array<double, 4> rates{0.1, 0.2, 0.3, 1.0};
  double squared = 0.0;
  Eigen::Matrix4d vandermonde;
  for (int i = 0; i < 4; ++i) {
    const double l = rates.at(static_cast<std::size_t>(i));
    const double difference =
        (l * 99.5743 - 139.3188) / (l * l + 100.0) - (l * 98.5743 - 137.9253) / (l * l + 99.0);
    squared += difference * difference;
    vandermonde.row(i) << l * l * l, l * l, l, 1.0;
  }
  const Eigen::Vector4d values = oracle::singular_values(vandermonde);
  // The readings of the printed denominator: 1/smallest is the largest of them.
  CHECK(1.0 / values(3) > std::max(values(0), values(3)));
  const double right = std::pow(100.5, 3) / values(3) * std::sqrt(squared);
  const double left = 1.0 + (139.3188 - 137.9253) + 0.5 * (99.5743 + 139.3188 + 98.5743 + 137.9253);
  CHECK(right == doctest::Approx(188.3).epsilon(1e-3));
  CHECK(left == doctest::Approx(240.1).epsilon(1e-3));
  const std::string ground = kkl_observer::injectivity_claims().front().witness;
  CHECK(ground.find("240.08") != std::string::npos);
  CHECK(ground.find("188.3") != std::string::npos);
}
