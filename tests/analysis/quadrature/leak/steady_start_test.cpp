#include "analysis/quadrature/leak/steady_start.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "analysis/quadrature/leak/steady_certificate.hpp"
#include "analysis/rigor/decimal.hpp"
#include "tests/analysis/quadrature/polar_simulation.hpp"
#include "tests/support/random.hpp"

using namespace veritrack;
using namespace veritrack::quadrature;
using rigor::Interval;
using rigor::Verdict;

TEST_CASE(
    "starts that are followed into the set keep to the bounds: the textbook filter from their corners") {
  const rigor::UpwardRounding upward;
  LeakQuestion question;
  question.tracker.design = {rigor::parse_decimal("0.0023"), rigor::parse_decimal("0.0023"),
                             rigor::parse_decimal("0.05"), rigor::parse_decimal("0.01")};
  question.tracker.noise = rigor::parse_decimal("0.001");
  question.tracker.initial_amplitude_error = question.tracker.initial_phase_error =
      question.tracker.initial_frequency_error = rigor::parse_decimal("0.005");
  question.tracker.with_samples = false;
  question.band = Interval::from_bounds(2.9, 3.0);
  const LeakCertificate certificate = certify_with_leak(question);
  REQUIRE(certificate.derivation.verdict == Verdict::proved);
  const auto upper = [&](const char* name) {
    return theorems::find_quantity(certificate.derivation, name).value.upper();
  };
  REQUIRE(upper("capture_samples") >= 1.0);  // the truth is outside the set, as the bias is larger
  const double bound = upper("frequency_error_bound");
  const double ultimate = upper("ultimate_frequency_error");
  const double settled = upper("settling_samples");
  const sets::LockBranch branch = sets::verify_lock_branch(question.tracker.design, question.band);

  const rigor::NearestRounding nearest;
  test::Random random(61);
  const auto runs = test::effort(40);
  for (int run = 0; run < runs; ++run) {
    test::Simulation simulation(question.tracker.design, test::Polar::Zero(), random.uniform(2.9, 3.0));
    test::Polar start = test::steady_state(simulation, branch.cells, question.tracker.design);
    for (int i = 0; i < 3; ++i) {
      start[i] = ((run >> i) % 2 == 0 ? -0.005 : 0.005) * (run < 8 ? 1.0 : random.uniform());
    }
    simulation = test::Simulation(question.tracker.design, start, simulation.frequency);
    for (int k = 1; k <= 120; ++k) {
      const double angle = random.uniform(0.0, 6.28);
      simulation.step(0.001 * Eigen::Vector2d(std::cos(angle), std::sin(angle)), 0.0);
      const double error = std::fabs(simulation.state()[2]);
      CAPTURE(run);
      CAPTURE(k);
      CHECK(error <= bound * (1.0 + 1e-9));
      if (k >= settled) {
        CHECK(error <= ultimate * (1.0 + 1e-9));
      }
    }
  }
}

TEST_CASE("starts that do not come into the set settle at no sample") {
  const rigor::UpwardRounding upward;
  LeakQuestion question;
  question.tracker.design = {rigor::parse_decimal("0.0023"), rigor::parse_decimal("0.0023"),
                             rigor::parse_decimal("0.05"), rigor::parse_decimal("0.01")};
  question.tracker.initial_frequency_error = Interval(2.5);
  question.tracker.with_samples = false;
  question.band = Interval::from_bounds(2.95, 3.0);
  const LeakCertificate certificate = certify_with_leak(question);
  const auto applies = [&](const char* name) {
    return theorems::find_quantity(certificate.derivation, name).applies();
  };
  REQUIRE(applies("ultimate_frequency_error"));
  CHECK_FALSE(applies("frequency_error_bound"));
  CHECK_FALSE(applies("settling_samples"));
  CHECK_FALSE(applies("settled_frequency_error"));
}

TEST_CASE("a covariance has a level only when it is between both bounds of that level") {
  const rigor::UpwardRounding upward;
  SteadySet set;
  set.below = rigor::Matrix<3>::Identity();
  set.above = 2.0 * rigor::Matrix<3>::Identity();
  const auto level_of = [&](double first, double last) {
    rigor::Matrix<3> deviation = rigor::Matrix<3>::Zero();
    deviation(0, 0) = first;
    deviation(2, 2) = last;
    return covariance_level(rigor::to_interval(deviation), set);
  };
  REQUIRE(level_of(0.5, -0.25).has_value());
  CHECK(*level_of(0.5, -0.25) >= 0.25);
  CHECK(*level_of(0.5, -0.25) <= 0.3);
  CHECK(*level_of(1.8, 0.0) >= 0.9);
  CHECK(*level_of(0.0, -0.9) >= 0.9);
  CHECK_FALSE(level_of(0.0, -1.1).has_value());
  CHECK_FALSE(level_of(2.1, 0.0).has_value());
}

TEST_CASE("no frequencies, no starts") {
  CHECK_THROWS_AS(static_cast<void>(joined({})), std::invalid_argument);
}
