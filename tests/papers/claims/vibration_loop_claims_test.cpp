#include "papers/claims/vibration_loop_claims.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

using namespace veritrack;
using rigor::Verdict;

TEST_CASE("of the loop's formulas those with slips are refuted, and every other is proved") {
  const std::set<std::string> refuted{"chapter-5/disturbance/printed", "chapter-5/initial-conditions",
                                      "chapter-5/expansion/B/printed", "chapter-5/lemma-5.3/printed",
                                      "chapter-5/monitoring/beta/printed"};
  const rigor::UpwardRounding upward;
  std::set<std::string> found;
  for (const auto& part : {theorems::vibration_model_claims(), theorems::parameter_convergence_claims()}) {
    for (const theorems::Statement& statement : part) {
      CAPTURE(statement.id);
      CAPTURE(statement.witness);
      CHECK_FALSE(statement.witness.empty());
      CHECK(found.insert(statement.id).second);
      CHECK(statement.verdict == (refuted.contains(statement.id) ? Verdict::refuted : Verdict::proved));
    }
  }
  CHECK(found.size() == 19);
}

TEST_CASE("the disturbance, run from its two kicks, is the corrected sinusoid") {
  test::Random random(5'221);
  for (std::int64_t run = 0; run < test::effort(50); ++run) {
    const double frequency = random.uniform(0.1, 3.0);
    const double first = random.uniform(-1.0, 1.0);   // e_{-1}
    const double second = random.uniform(-1.0, 1.0);  // e_{-2}
    const double c = 2.0 * std::cos(frequency);
    double before = second;
    double last = c * second + first;
    for (int k = 0; k < 50; ++k) {
      const double next = c * last - before;
      before = last;
      last = next;
      const double formula =
          (first * std::sin((k + 2) * frequency) + second * std::sin((k + 3) * frequency)) /
          std::sin(frequency);
      REQUIRE(last == doctest::Approx(formula).epsilon(1e-8));
    }
  }
}

TEST_CASE("the regulator, written out: steps are summable, M never decreases, P falls to zero") {
  // Section 5.4's plant with order 3: theta = (-a, b), phi = (y, y, y, u, u, u).
  using Matrix = Eigen::Matrix<double, 6, 6>;
  using Vector = Eigen::Matrix<double, 6, 1>;
  const double c = 2.0 * std::cos(0.5235987755982988);
  Vector truth;
  truth << 0.5 + c, -(1.0 + 0.5 * c), 0.5, 3.0, -3.0 * c, 3.0;
  for (const double limit : {20.0, 100.0}) {
    CAPTURE(limit);
    Vector estimate = Vector::Zero();
    estimate(3) = 2.0;
    Matrix p = Matrix::Identity();
    double rbar = 1.0;
    double product = 1.0;
    double before = 0.5, last = 1.0, x = 0.0;
    Vector phi = Vector::Zero();
    double sum = 0.0;
    double allowed = -1.0;
    double smallest = -1e300;
    for (int k = 0; k < 3000; ++k) {
      const double next = c * last - before;
      before = last;
      last = next;
      x = 0.5 * x + 3.0 * phi(3);
      const double y = x + last;
      if (k > 3) {  // the regressor holds samples of this run only
        if (allowed < 0.0) {
          const Vector off = estimate - truth;
          allowed = limit * off.dot(oracle::solution(p, off).col(0)) / rbar;
        }
        const Vector w = p * phi;
        const double g = phi.dot(w);
        const Vector step = w * ((y - phi.dot(estimate)) / (1.0 + g));
        estimate += step;
        sum += step.squaredNorm();
        p = (p - w * w.transpose() / (1.0 + g)).eval();
        rbar *= 1.0 + g;
        const double largest = oracle::largest_eigenvalue(p);
        const double beta = std::min(1.0, limit / (rbar * largest));
        REQUIRE(beta >= (1.0 - 1e-9) / (1.0 + g));
        p *= beta;
        product *= beta;
      }
      Vector moved;
      moved << y, phi(0), phi(1), 0.0, phi(3), phi(4);
      const double rest = estimate.head<3>().dot(moved.head<3>()) + estimate.tail<2>().dot(moved.tail<2>());
      moved(3) = -rest / estimate(3);
      phi = moved;
      if (k == 3 || k % 500 == 0) {
        const double smallest_now = product / oracle::largest_eigenvalue(p);
        CHECK(smallest_now >= smallest * (1.0 - 1e-6));
        smallest = smallest_now;
      }
    }
    CHECK(sum <= allowed * (1.0 + 1e-9));
    CHECK(oracle::largest_eigenvalue(p) < 0.05);  // from 1
  }
}
