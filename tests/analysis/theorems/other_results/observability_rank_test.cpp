#include "analysis/theorems/other_results/observability_rank.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/analysis/theorems/tracker_inputs.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Verdict;

/// (h(x), h(f(x)), h(f(f(x)))) in double.
Eigen::Matrix<double, 6, 1> outputs(Eigen::Vector3d x, double epsilon) {
  Eigen::Matrix<double, 6, 1> y;
  for (int k = 0; k < 3; ++k) {
    y.segment<2>(2 * k) = x.head<2>();
    const double c = std::cos(x(2));
    const double s = std::sin(x(2));
    x = Eigen::Vector3d(c * x(0) - s * x(1), s * x(0) + c * x(1), (1.0 - epsilon) * x(2));
  }
  return y;
}

}  // namespace

TEST_CASE("the Gram matrix is that of central differences, and the printed one") {
  test::Random random(111);
  const rigor::UpwardRounding upward;
  for (std::int64_t i = 0; i < test::effort(200); ++i) {
    INFO("seed ", test::kSeed + 111, ", state ", i);
    const Eigen::Vector3d x(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-3.0, 3.0));
    const double epsilon = random.uniform(0.0, 0.9);
    const rigor::IntervalVector<3> state = rigor::to_interval(x);
    const auto gram = theorems::observability_gram(state, Interval(epsilon));
    const auto printed = theorems::printed_gram(state, Interval(epsilon));
    Eigen::Matrix3d numeric;
    {
      const rigor::NearestRounding nearest;
      Eigen::Matrix<double, 6, 3> jacobian;
      for (int j = 0; j < 3; ++j) {
        const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(j);
        jacobian.col(j) = (outputs(x + step, epsilon) - outputs(x - step, epsilon)) / 2e-6;
      }
      numeric = jacobian.transpose() * jacobian;
    }
    for (Eigen::Index entry = 0; entry < gram.size(); ++entry) {
      CHECK(rigor::midpoint(gram(entry)) == doctest::Approx(numeric(entry)).epsilon(1e-6).scale(1.0));
      CHECK_FALSE(is_empty(intersection(gram(entry), printed(entry))));
    }
  }
}

TEST_CASE("theorem 3.1: full rank on the circle, not at z = 0; the printed matrix with its parentheses") {
  for (const test::TableRow& row : test::kTable32) {
    const auto derivation =
        theorems::evaluate_observability_rank(test::tracker_input(test::table_design(row)));
    CHECK(test::find_condition(derivation, "rank").verdict == Verdict::proved);
    CHECK(test::find_condition(derivation, "printed-gram").verdict == Verdict::proved);
    CHECK(derivation.verdict == Verdict::proved);
    const auto letter =
        theorems::evaluate_observability_to_the_letter(test::tracker_input(test::table_design(row)));
    for (const theorems::Condition& condition : letter.conditions) {
      CHECK_MESSAGE(condition.verdict == Verdict::refuted, condition.id);
    }
    const double e = row.epsilon;
    CHECK(test::value_of(derivation, "gram_determinant").lower() ==
          doctest::Approx(3.0 * (3.0 * (1.0 + (2.0 - e) * (2.0 - e)) - (3.0 - e) * (3.0 - e))));
  }
}
