#include "analysis/theorems/other_results/total_stability.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

#include "tests/analysis/theorems/simulated_errors.hpp"
#include "tests/analysis/theorems/tracker_inputs.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Verdict;

}  // namespace

TEST_CASE("theorem 2.6 on random equations that meet its hypotheses: |z| <= r and the bound") {
  test::Random random(81);
  const rigor::UpwardRounding upward;
  for (std::int64_t i = 0; i < test::effort(500); ++i) {
    INFO("seed ", test::kSeed + 81, ", equation ", i);
    // A = [[a, b], [0, a]] has |A^k| <= a^k (1 + k b/a) <= beta alpha^k with alpha halfway to 1.
    const double a = random.uniform(0.1, 0.9);
    const double b = random.uniform(0.0, 1.0);
    const double alpha = 0.5 * (1.0 + a);
    double beta = 1.0;
    Eigen::Matrix2d step;
    step << a, b, 0.0, a;
    Eigen::Matrix2d power = Eigen::Matrix2d::Identity();
    for (int k = 0; k < 400; ++k) {
      beta = std::max(beta, power.norm() / std::pow(alpha, k));
      power = (power * step).eval();
    }
    const double share = random.uniform(0.0, 0.99);
    const double zeta = share * (1.0 - alpha) / beta;
    const double eta = (0.99 - share) * (1.0 - alpha) / beta;
    const double r = random.uniform(0.1, 10.0);
    const double start = 0.99 * r / beta;
    const theorems::TotalStability constants{Interval(beta), Interval(alpha), Interval(zeta), Interval(eta),
                                             Interval(r)};
    const double angle = random.uniform(0.0, 6.3);
    Eigen::Vector2d z(start * std::cos(angle), start * std::sin(angle));
    for (int k = 0; k <= 60; ++k) {
      CHECK(z.norm() <= r);
      CHECK(z.norm() <= theorems::total_stability_bound(constants, Interval(start), k).upper());
      // The worst that f and g may do here: outwards.
      const Eigen::Vector2d outwards = step * z;
      const double push = zeta * z.norm() + eta * r;
      z = outwards + (outwards.norm() > 0.0 ? push / outwards.norm() : 0.0) * outwards;
    }
  }
}

TEST_CASE("the bound of theorem 2.6 exceeds r at the start, contrary to print") {
  const rigor::UpwardRounding upward;
  const theorems::TotalStability constants{Interval(1.0), Interval(0.0), Interval(0.0), Interval(0.875),
                                           Interval(1.0)};
  CHECK(certainly_less(Interval(1.0), theorems::total_stability_bound(constants, Interval(0.875), 0)));
  CHECK_THROWS_AS((void)theorems::total_stability_bound(constants, Interval(0.5), -1), std::invalid_argument);
  const theorems::TotalStability unstable{Interval(1.0), Interval(1.0), Interval(0.0), Interval(0.0),
                                          Interval(1.0)};
  CHECK(is_empty(theorems::total_stability_bound(unstable, Interval(0.5), 0)));
}

TEST_CASE("starts and noise at the certified bounds stay within r") {
  test::Random random(82);
  for (const test::TableRow& row : test::kTable32) {
    CAPTURE(row.figure);
    INFO("seed ", test::kSeed + 82);
    theorems::TrackerInput input = test::without_leak(row);
    test::TestDesign design = test::table_design(row);
    design.epsilon = 0.0;
    for (const auto& evaluate :
         {theorems::evaluate_total_stability, theorems::evaluate_theorem_2_7_corrected}) {
      const auto derivation = evaluate(input);
      CAPTURE(derivation.id);
      const double start = test::value_of(derivation, "initial_frequency_error_bound").lower();
      const double noise = test::value_of(derivation, "noise_bound").lower();
      const double r = test::value_of(derivation, "r").upper();
      CHECK(start > 1e-7);
      CHECK(noise > 1e-10);
      for (std::int64_t i = 0; i < test::effort(5); ++i) {
        for (const Eigen::Vector3d& error : test::simulated_errors(design, start, noise, 200, random)) {
          CHECK(error.norm() <= r);
        }
      }
      theorems::TrackerInput allowed = input;
      allowed.theorem_2_9.initial_error = Interval(0.99 * start);
      allowed.theorem_2_9.measurement_noise = Interval(0.99 * noise);
      CHECK(evaluate(allowed).verdict == Verdict::proved);
      allowed.theorem_2_9.measurement_noise = Interval(1.01 * noise);
      CHECK(evaluate(allowed).verdict == Verdict::refuted);
    }
    theorems::TrackerInput silent = input;
    silent.theorem_2_9.measurement_noise = silent.theorem_2_9.process_noise = Interval(0.0);
    const auto corollary = theorems::evaluate_total_stability_corollary(silent);
    CHECK(corollary.verdict == Verdict::proved);
    CHECK(
        test::value_of(corollary, "initial_frequency_error_bound").lower() >
        test::value_of(theorems::evaluate_total_stability(silent), "initial_frequency_error_bound").lower());
    CHECK(theorems::evaluate_total_stability_corollary(input).verdict == Verdict::refuted);
  }
}

TEST_CASE(
    "theorem 2.7 as printed is refuted for the designs of the thesis: three times the amplitude factor") {
  for (const test::TableRow& row : test::kTable32) {
    CAPTURE(row.figure);
    test::TestDesign design = test::table_design(row);
    const auto derivation = theorems::evaluate_theorem_2_7_printed(test::tracker_input(design));
    design.epsilon = 0.0;
    const Eigen::Matrix3d p = test::steady_state(design);
    CHECK(test::value_of(derivation, "amplitude_factor").lower() ==
          doctest::Approx(design.r / (p(0, 0) + design.q1 + design.r)).epsilon(1e-9));
    CHECK(derivation.verdict == Verdict::refuted);
  }
  test::TestDesign eager;
  eager.q1 = eager.q2 = 1.0;
  eager.r = 0.01;
  CHECK(theorems::evaluate_theorem_2_7_printed(test::tracker_input(eager)).verdict == Verdict::undecided);
}

TEST_CASE("a rate of 1 or more bounds nothing") {
  const rigor::UpwardRounding upward;
  const auto bound = [](double alpha, double zeta) {
    return theorems::total_stability_bound(
        {Interval(2.0), Interval(alpha), Interval(zeta), Interval(0.1), Interval(1.0)}, Interval(0.5), 3);
  };
  CHECK(rigor::is_finite(bound(0.5, 0.1)));
  CHECK_FALSE(rigor::is_finite(bound(0.5, 0.25)));
  CHECK_FALSE(rigor::is_finite(bound(1.5, 0.0)));
}
