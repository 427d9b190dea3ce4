#include "analysis/theorems/theorem_2_9_gaps.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "tests/analysis/theorems/theorem_2_9_designs.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Verdict;

std::map<std::string, Verdict> verdicts(const theorems::Theorem29Input& input) {
  std::map<std::string, Verdict> result;
  for (const theorems::Statement& statement : theorems::theorem_2_9_gaps(input)) {
    REQUIRE(statement.id.starts_with("theorem-2.9/"));
    REQUIRE(result.emplace(statement.id.substr(12), statement.verdict).second);  // no id twice
    CHECK_FALSE(statement.sentence.empty());
    CHECK_FALSE(statement.witness.empty());
    std::set<std::string> names;
    for (const theorems::Quantity& quantity : statement.evidence) {
      CHECK(names.insert(quantity.name).second);
    }
  }
  return result;
}

// What an independent look at the thesis says of its own four designs: worked out by hand.
TEST_CASE("the verdicts for the designs of Table 3.2") {
  const std::map<std::string, Verdict> expected{{"gramian-eigenvalue/printed", Verdict::refuted},
                                                {"gramian-eigenvalue/repaired", Verdict::proved},
                                                {"gramian-time-index", Verdict::refuted},
                                                {"w_3-range/printed", Verdict::proved},
                                                {"w_3-range/errata", Verdict::proved},
                                                {"b_1/printed", Verdict::proved},
                                                {"b_1/errata", Verdict::proved},
                                                {"b_2/printed", Verdict::proved},
                                                {"b_2/errata", Verdict::refuted},
                                                {"R_x", Verdict::proved},
                                                {"rho_1/printed", Verdict::proved},
                                                {"rho_1/errata", Verdict::proved},
                                                {"rho_2/printed", Verdict::proved},
                                                {"rho_2/errata", Verdict::proved},
                                                {"rho_3/printed", Verdict::proved},
                                                {"rho_3/errata", Verdict::proved},
                                                {"remainder-constant/general", Verdict::refuted},
                                                {"remainder-constant/printed", Verdict::proved},
                                                {"remainder-constant/errata", Verdict::proved},
                                                {"decomposition/printed", Verdict::refuted},
                                                {"decomposition/repaired", Verdict::proved},
                                                {"remainder-sign/2.12", Verdict::proved},
                                                {"remainder-sign/theorem-2.9", Verdict::refuted},
                                                {"s/general", Verdict::refuted},
                                                {"s/printed", Verdict::proved},
                                                {"bounds-from-the-start", Verdict::refuted},
                                                {"decrease-factor/displayed", Verdict::refuted},
                                                {"decrease-factor/2.36", Verdict::proved},
                                                {"past-errors", Verdict::refuted},
                                                {"lemma-3.1", Verdict::refuted},
                                                {"zeta/general", Verdict::refuted},
                                                {"zeta/printed", Verdict::proved},
                                                {"zeta/errata", Verdict::proved},
                                                {"eta-size/printed", Verdict::proved},
                                                {"eta-size/errata", Verdict::proved},
                                                {"eta-slope/printed", Verdict::refuted},
                                                {"eta-slope/errata", Verdict::refuted},
                                                {"final-bound/printed", Verdict::refuted},
                                                {"final-bound/errata", Verdict::refuted},
                                                {"final-bound-sum", Verdict::refuted},
                                                {"2.44-follows/printed", Verdict::proved},
                                                {"2.44-follows/errata", Verdict::proved},
                                                {"linearised-rate/printed", Verdict::refuted},
                                                {"linearised-rate/errata", Verdict::refuted},
                                                {"radius-order/printed", Verdict::proved},
                                                {"radius-order/errata", Verdict::proved}};
  for (const test::TableRow& row : test::kTable32) {
    std::map<std::string, Verdict> found = verdicts(test::table_design(row).input());
    CAPTURE(row.figure);
    found.erase("s/errata");  // depends on how sharp the sound bound is
    CHECK(found.size() == expected.size());
    for (const auto& place : expected) {
      CHECK_MESSAGE(found.at(place.first) == place.second, place.first);
    }
  }
}

TEST_CASE("without a leak the printed eigenvalues are right") {
  test::TestDesign design;
  design.epsilon = 0.0;
  CHECK(verdicts(design.input()).at("gramian-eigenvalue/printed") == Verdict::proved);
}

/// The eigenvalues of the textbook O(k,1) for an estimate, by Eigen.
Eigen::Vector3d textbook_eigenvalues(const Eigen::Vector3d& estimate, double r, double epsilon) {
  const double c = std::cos(estimate[2]);
  const double s = std::sin(estimate[2]);
  Eigen::Matrix3d transition;
  transition << c, -s, -estimate[0] * s - estimate[1] * c,  //
      s, c, estimate[0] * c - estimate[1] * s,              //
      0.0, 0.0, 1.0 - epsilon;
  const Eigen::Matrix<double, 2, 3> output = Eigen::Matrix<double, 2, 3>::Identity();
  const Eigen::Matrix<double, 2, 3> before = output * transition.inverse();
  const Eigen::Matrix3d gramian = (output.transpose() * output + before.transpose() * before) / r;
  return oracle::symmetric_eigenvalues(gramian);
}

TEST_CASE("sampled estimates never break a proved b_1 or b_2, and the witness breaks a refuted one") {
  test::Random random(2950);
  const std::int64_t count = test::effort(300);
  int refuted = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    const test::TestDesign design = test::random_design(random);
    CAPTURE(i);
    const auto found = verdicts(design.input());
    for (const bool errata : {false, true}) {
      const std::string name = errata ? "errata" : "printed";
      // The errata sheet: 2 sigma <= (1 - eps_r)^2 for b_1, every eps_r below 1 for b_2.
      const double radius = errata ? 1.0 - std::sqrt(2.0 * design.sigma) : std::sqrt(0.5) - design.sigma;
      const double upper_radius = errata ? 1.0 - 1e-12 : radius;
      const double t = std::sqrt(2.0) * design.sigma;
      const double b_1 = (errata ? design.sigma : t * t * (1.0 - t * t / 4.0)) / (2.0 * design.r);
      const double b_2 = (errata ? 5.0 : 3.0 * (2.0 - t) * (2.0 - t)) / design.r;
      const auto smallest = [&](double m) {
        return textbook_eigenvalues({m, 0.0, 0.7}, design.r, design.epsilon)[0];
      };
      const auto largest = [&](double m) {
        return textbook_eigenvalues({m, 0.0, 0.7}, design.r, design.epsilon)[2];
      };
      for (int sample = 0; sample < 5; ++sample) {
        const double part = random.uniform(-1.0, 1.0);
        const double m = 1.0 + radius * part;
        if (found.at("b_1/" + name) == Verdict::proved && m > 1e-3) {
          CHECK(smallest(m) >= b_1 * (1.0 - 1e-9));
        }
        if (found.at("b_2/" + name) == Verdict::proved) {
          CHECK(largest(1.0 + upper_radius * part) <= b_2 * (1.0 + 1e-9));
        }
      }
      if (found.at("b_1/" + name) == Verdict::refuted && 1.0 - radius > 1e-3) {
        ++refuted;
        CHECK(smallest(1.0 - radius) <= b_1 * (1.0 + 1e-9));
      }
      if (found.at("b_2/" + name) == Verdict::refuted) {
        ++refuted;
        CHECK(largest(1.0 + upper_radius) >= b_2 * (1.0 - 1e-9));
      }
    }
  }
  CHECK(refuted > 0);
}

TEST_CASE("the errata sheet's sigma is read as small: no sigma, or a large one, decides nothing") {
  test::TestDesign design = test::table_design(test::kTable32[0]);
  for (const double sigma : {0.0, 0.5, 0.9}) {
    design.sigma = sigma;
    const auto found = verdicts(design.input());
    CHECK(found.at("w_3-range/errata") == Verdict::undecided);
    CHECK(found.at("b_1/errata") == Verdict::undecided);
  }
  // A bound on the state that is too small is found out, at an error that the sheet admits.
  design.sigma = 1e-3;
  design.state_bound = 0.2;
  CHECK(verdicts(design.input()).at("w_3-range/errata") == Verdict::refuted);
}

TEST_CASE("a radius of no estimates, or of estimates through zero, proves no bound on predictions") {
  test::TestDesign design = test::table_design(test::kTable32[0]);
  for (const double sigma : {-0.5, 0.9, 1.5}) {
    CAPTURE(sigma);
    design.sigma = sigma;
    CHECK(verdicts(design.input()).at("s/printed") != Verdict::proved);
    CHECK((sigma == 0.9 || verdicts(design.input()).at("s/errata") != Verdict::proved));
  }
}

TEST_CASE("without a positive radius, or room beside epsilon_z, nothing is said of the printed constants") {
  test::TestDesign design = test::table_design(test::kTable32[0]);
  design.sigma = 0.9;  // epsilon_r < 0
  CHECK(verdicts(design.input()).at("w_3-range/printed") == Verdict::undecided);
  design.sigma = 0.7071067;  // epsilon_r = 8e-8 = epsilon_z, and beta > 1
  CHECK(verdicts(design.input()).at("eta-size/printed") != Verdict::proved);
}

TEST_CASE("designs that are hardly known leave open whether past errors matter") {
  theorems::Theorem29Input input = test::TestDesign{}.input();
  CHECK(verdicts(input).at("past-errors") == Verdict::refuted);
  for (const double factor : {1.5, 2.0}) {
    input.q1 = input.q2 = Interval::from_bounds(input.q2.lower(), factor * input.q2.lower());
    input.r = Interval::from_bounds(input.r.lower(), factor * input.r.lower());
    CHECK(verdicts(input).at("past-errors") == Verdict::undecided);
  }
}

TEST_CASE("inputs that are no numbers decide nothing about the design") {
  theorems::Theorem29Input input;  // everything empty
  for (const auto& decided : verdicts(input)) {
    const std::string& id = decided.first;
    const Verdict verdict = decided.second;
    const bool speaks_of_design = !(id.ends_with("general") || id == "lemma-3.1" || id == "final-bound-sum" ||
                                    id == "decomposition/printed" || id.starts_with("remainder-sign"));
    CHECK_MESSAGE((!speaks_of_design || verdict == Verdict::undecided), id);
  }
  input = test::TestDesign{}.input();
  input.q1 = Interval::from_bounds(0.0, std::numeric_limits<double>::infinity());
  const auto found = verdicts(input);
  for (const char* id : {"decrease-factor/2.36", "eta-size/printed", "2.44-follows/errata", "past-errors"}) {
    CHECK_MESSAGE(found.at(id) == Verdict::undecided, id);
  }
}

TEST_CASE("without process noise in the plane what divides by it is undecided, and says so") {
  test::TestDesign design;
  design.q1 = 0.0;
  design.q1_equals_q2 = false;
  for (const theorems::Statement& statement : theorems::theorem_2_9_gaps(design.input())) {
    if (statement.id == "theorem-2.9/eta-slope/printed") {
      CHECK(statement.verdict == Verdict::undecided);
      CHECK(statement.witness.find("undefined") != std::string::npos);
    }
  }
}

}  // namespace
