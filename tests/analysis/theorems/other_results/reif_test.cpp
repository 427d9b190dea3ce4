#include "analysis/theorems/other_results/reif.hpp"

#include <doctest/doctest.h>

#include "tests/analysis/theorems/simulated_errors.hpp"
#include "tests/analysis/theorems/tracker_inputs.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using rigor::Verdict;

}  // namespace

TEST_CASE("the published constants, by the formulas of the paper in double") {
  for (const test::TableRow& row : test::kTable32) {
    CAPTURE(row.figure);
    const auto derivation = theorems::evaluate_reif(test::without_leak(row));
    const auto value = [&](const std::string& name) { return test::value_of(derivation, name).lower(); };
    const double a = value("a_bar");
    const double p = value("p_hi");
    const double q = row.q;
    CHECK(value("p_lo") == doctest::Approx(q));
    const double closed_loop = a + a * p / row.r;
    const double alpha = 1.0 - 1.0 / (1.0 + q / (p * closed_loop * closed_loop));
    CHECK(value("alpha") == doctest::Approx(alpha).epsilon(1e-6));
    const double kappa_phi = 0.5 * 1.618034;
    const double kappa = kappa_phi / q * (2.0 * closed_loop + kappa_phi * value("epsilon_prime"));
    CHECK(value("kappa") == doctest::Approx(kappa).epsilon(1e-5));
    CHECK(value("epsilon_published") ==
          doctest::Approx(std::min(value("epsilon_prime"), alpha / (2.0 * p * kappa))).epsilon(1e-5));
    CHECK(value("initial_frequency_error_bound") ==
          doctest::Approx(value("epsilon_published") * std::sqrt(q / p)).epsilon(1e-6));
  }
}

TEST_CASE("two-step: starts and noise at the certified bounds stay in the ball and settle at the rate") {
  test::Random random(71);
  for (const test::TableRow& row : test::kTable32) {
    theorems::TrackerInput input = test::without_leak(row);
    const auto derivation = theorems::evaluate_reif_two_step(input);
    CAPTURE(row.figure);
    INFO("seed ", test::kSeed + 71);
    const double start = test::value_of(derivation, "initial_frequency_error_bound").lower();
    const double noise = test::value_of(derivation, "noise_bound").lower();
    CHECK(start > 1e-5);
    CHECK(noise > 1e-7);
    const double ball = test::value_of(derivation, "epsilon_ball").upper();
    const double rate = test::value_of(derivation, "rate").upper();
    const double beta = test::value_of(derivation, "beta").upper();
    test::TestDesign design = test::table_design(row);
    design.epsilon = 0.0;
    for (std::int64_t i = 0; i < test::effort(10); ++i) {
      for (const Eigen::Vector3d& error : test::simulated_errors(design, start, noise, 200, random)) {
        CHECK(error.norm() <= ball);
      }
      const auto quiet = test::simulated_errors(design, start, 0.0, 200, random);
      for (std::size_t k = 0; k < quiet.size(); ++k) {
        CHECK(quiet.at(k).norm() <= beta * std::pow(rate, static_cast<double>(k)) * start * (1.0 + 1e-9));
      }
    }
    input.theorem_2_9.initial_error = Interval(0.99 * start);
    input.theorem_2_9.measurement_noise = Interval(0.99 * noise);
    CHECK(theorems::evaluate_reif_two_step(input).verdict == Verdict::proved);
    input.theorem_2_9.initial_error = Interval(1.01 * start);
    CHECK(theorems::evaluate_reif_two_step(input).verdict == Verdict::refuted);
  }
}

TEST_CASE("a leak, no process noise, or nothing assumed proves nothing") {
  theorems::TrackerInput input = test::tracker_input(test::table_design(test::kTable32[0]));
  CHECK(test::find_condition(theorems::evaluate_reif_two_step(input), "start-covariance").verdict ==
        Verdict::undecided);
  input.theorem_2_9.q1 = Interval(0.0);
  input.theorem_2_9.q1_equals_q2 = false;
  for (const auto& derivation : {theorems::evaluate_reif(input), theorems::evaluate_reif_two_step(input)}) {
    CHECK(derivation.verdict == Verdict::refuted);
    CHECK(is_empty(test::value_of(derivation, "initial_frequency_error_bound")));
  }
  theorems::TrackerInput silent = test::without_leak(test::kTable32[0]);
  silent.theorem_2_9.measurement_noise.reset();
  silent.theorem_2_9.initial_error.reset();
  for (const auto& derivation : {theorems::evaluate_reif(silent), theorems::evaluate_reif_two_step(silent)}) {
    CHECK(derivation.verdict == Verdict::undecided);
  }
}
