#include "analysis/theorems/other_results/design_comparison.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <stdexcept>

#include "tests/analysis/theorems/tracker_inputs.hpp"
#include "tests/support/oracles.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Verdict;
using theorems::LinearWindow;
using theorems::SmallMatrix;

Eigen::MatrixXd random_entries(test::Random& random, Eigen::Index rows, Eigen::Index columns) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random.uniform(-1.0, 1.0); });
}

Eigen::MatrixXd random_noise(test::Random& random, Eigen::Index size) {
  const Eigen::MatrixXd factor = random_entries(random, size, size);
  return factor * factor.transpose() + 0.05 * Eigen::MatrixXd::Identity(size, size);
}

SmallMatrix exact(const Eigen::MatrixXd& matrix) {
  return matrix.unaryExpr([](double entry) { return Interval(entry); });
}

/// True unless larger - smaller certainly has a negative direction; `margin` is a share of the larger.
bool ordered(const SmallMatrix& smaller, const SmallMatrix& larger) {
  const Interval least = theorems::smallest_eigenvalue(larger - smaller);
  return is_finite(least) && least.upper() >= -1e-12 * rigor::magnitude(larger).maxCoeff();
}

}  // namespace

TEST_CASE("over-design and under-design keep their orders for random systems, and P^p is the textbook's") {
  test::Random random(131);
  std::int64_t strict = 0;
  const std::int64_t systems = test::effort(300);
  constexpr std::size_t kSteps = 5;
  for (std::int64_t i = 0; i < systems; ++i) {
    INFO("seed ", test::kSeed + 131, ", system ", i);
    const auto states = static_cast<Eigen::Index>(1 + random.below(4));
    const auto outputs = static_cast<Eigen::Index>(1 + random.below(static_cast<std::uint64_t>(states)));
    LinearWindow small;
    LinearWindow large;
    std::vector<Eigen::MatrixXd> f, h, q, r;
    for (std::size_t k = 0; k <= kSteps; ++k) {
      h.push_back(random_entries(random, outputs, states));
      r.push_back(random_noise(random, outputs));
      const Eigen::MatrixXd more_r = r.back() + random_noise(random, outputs);
      for (LinearWindow* window : {&small, &large}) {
        window->outputs.push_back(exact(h.back()));
        window->measurement_noises.push_back(exact(window == &small ? r.back() : more_r));
      }
      if (k < kSteps) {
        f.push_back(random_entries(random, states, states));
        q.push_back(random_noise(random, states));
        const Eigen::MatrixXd more_q = q.back() + random_noise(random, states);
        for (LinearWindow* window : {&small, &large}) {
          window->transitions.push_back(exact(f.back()));
          window->process_noises.push_back(exact(window == &small ? q.back() : more_q));
        }
      }
    }
    Eigen::MatrixXd textbook = random_noise(random, states);
    const SmallMatrix prior = exact(textbook);
    const rigor::UpwardRounding upward;
    const auto over = theorems::compare_designs(small, large, prior);
    const auto under = theorems::compare_designs(large, small, prior);
    REQUIRE(over.size() == kSteps);
    REQUIRE(under.size() == kSteps);
    for (std::size_t k = 0; k < kSteps; ++k) {
      CHECK(ordered(over.at(k).optimal, over.at(k).performed));
      CHECK(ordered(over.at(k).performed, over.at(k).designed));
      CHECK(ordered(under.at(k).designed, under.at(k).optimal));
      CHECK(ordered(under.at(k).optimal, under.at(k).performed));
      {
        const rigor::NearestRounding nearest;
        const Eigen::MatrixXd s = h.at(k) * textbook * h.at(k).transpose() + r.at(k);
        const Eigen::MatrixXd filtered =
            textbook - textbook * h.at(k).transpose() * oracle::solution(s, h.at(k) * textbook);
        textbook = f.at(k) * filtered * f.at(k).transpose() + q.at(k);
      }
      const SmallMatrix difference = over.at(k).optimal - exact(textbook);
      for (Eigen::Index entry = 0; entry < difference.size(); ++entry) {
        CHECK(rigor::mignitude(difference(entry)) <= 1e-9 * textbook.norm());
      }
      strict += certainly_positive(theorems::smallest_eigenvalue(over.at(k).designed - over.at(k).performed))
                    ? 1
                    : 0;
    }
  }
  CHECK(100 * strict > 95 * 5 * systems);  // wide enclosures leave the others undecided
}

TEST_CASE("theorem 3.2 for the designs of the thesis; as printed it needs an order at the start") {
  for (const test::TableRow& row : test::kTable32) {
    CAPTURE(row.figure);
    const auto derivation = theorems::evaluate_theorem_3_2(test::tracker_input(test::table_design(row)));
    CHECK(test::find_condition(derivation, "over-design").verdict == Verdict::proved);
    CHECK(test::find_condition(derivation, "under-design").verdict == Verdict::proved);
    CHECK(derivation.verdict == Verdict::proved);
  }
  CHECK(theorems::evaluate_theorem_3_2_any_start().verdict == Verdict::refuted);
  CHECK_THROWS_AS((void)theorems::compare_designs({}, {}, SmallMatrix(1, 1)), std::invalid_argument);
}
