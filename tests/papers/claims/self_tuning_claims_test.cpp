#include "papers/claims/self_tuning_claims.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

using namespace veritrack;
using rigor::Verdict;

TEST_CASE("(5.23) and (5.24) stand, with other parameters and a start that is bounded") {
  const std::set<std::string> refuted{"chapter-5/regression/printed", "chapter-5/monitoring/trace/printed",
                                      "chapter-5/monitoring/condition-number",
                                      "chapter-5/theorem-5.2/regressor-step/printed",
                                      "chapter-5/theorem-5.2/control-exists"};
  const rigor::UpwardRounding upward;
  std::set<std::string> found;
  for (const theorems::Statement& statement : theorems::self_tuning_claims()) {
    CAPTURE(statement.id);
    CHECK_FALSE(statement.witness.empty());
    CHECK(found.insert(statement.id).second);
    CHECK(statement.verdict == (refuted.contains(statement.id) ? Verdict::refuted : Verdict::proved));
  }
  CHECK(found.size() == 12);
}

TEST_CASE(
    "monitored least squares, written out: rbar <= Lambda r and the weighted sum is bounded by the start") {
  test::Random random(5'223);
  using Matrix = Eigen::Matrix3d;
  using Vector = Eigen::Vector3d;
  for (std::int64_t run = 0; run < test::effort(100); ++run) {
    const double limit = random.uniform(1.0, 50.0);
    const Vector truth(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    Vector estimate = Vector::Zero();
    double rbar = random.uniform(0.1, 2.0);
    Matrix p = Matrix::Identity() * (random.uniform(0.1, 1.0) * limit / rbar);
    double trace = rbar / limit;
    const double allowed = (estimate - truth).dot(p.inverse() * (estimate - truth)) / rbar;
    double sum = 0.0;
    for (int k = 0; k < 200; ++k) {
      Vector phi(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0));
      // The control keeps phi'estimate = 0.
      if (estimate.norm() > 0.0) {
        phi -= estimate * (estimate.dot(phi) / estimate.squaredNorm());
      }
      const double y = phi.dot(truth);
      const Vector g = p * phi;
      const double size = phi.dot(g);
      estimate += g * ((y - phi.dot(estimate)) / (1.0 + size));
      p = (p - g * g.transpose() / (1.0 + size)).eval();
      rbar *= 1.0 + size;
      trace += phi.squaredNorm();
      const double largest = oracle::largest_eigenvalue(p);
      p *= std::min(1.0, limit / (rbar * largest));
      sum += y * y / rbar;
      REQUIRE(rbar <= limit * trace * (1.0 + 1e-9));
      REQUIRE(sum <= allowed * (1.0 + 1e-9));
    }
  }
}
