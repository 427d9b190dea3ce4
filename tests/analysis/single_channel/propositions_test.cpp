#include "analysis/single_channel/propositions.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>

#include "analysis/rigor/rounding.hpp"
#include "analysis/single_channel/frozen_observer.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::single_channel {
namespace {

using rigor::Interval;
using rigor::Verdict;
using test::Random;

Verdict verdict_of(const std::vector<theorems::Statement>& statements, const std::string& id) {
  const auto found = std::find_if(statements.begin(), statements.end(),
                                  [&](const theorems::Statement& one) { return one.id == id; });
  REQUIRE(found != statements.end());
  CHECK(!found->witness.empty());
  return found->verdict;
}

TEST_CASE("the printed denominator and response are refuted, the corrected ones and the numerators proved") {
  const rigor::UpwardRounding upward;
  const auto statements = proposition_1_formulas();
  CHECK(verdict_of(statements, "proposition-1/denominator-printed") == Verdict::refuted);
  CHECK(verdict_of(statements, "proposition-1/denominator-corrected") == Verdict::proved);
  CHECK(verdict_of(statements, "proposition-1/numerator-1") == Verdict::proved);
  CHECK(verdict_of(statements, "proposition-1/numerator-2") == Verdict::proved);
  CHECK(verdict_of(statements, "proposition-1/response-printed") == Verdict::refuted);
  CHECK(verdict_of(statements, "proposition-1/response-corrected") == Verdict::proved);
}

TEST_CASE("the corrected response is that of the simulated filter (3)") {
  Random random(81);
  for (int run = 0; run < 50; ++run) {
    const double k1 = random.uniform(0.2, 1.0);
    const double k2 = random.uniform(-0.3, 0.3);
    const double x3 = random.uniform(0.4, 2.7);
    const double theta = random.uniform(0.1, 3.0);
    const Eigen::Rotation2Dd turn(x3);
    Eigen::Vector2cd state = Eigen::Vector2cd::Zero();
    std::complex<double> gain;
    for (int k = 0; k < 4000; ++k) {
      const std::complex<double> y = std::polar(1.0, theta * k);
      const Eigen::Vector2cd predicted = turn.toRotationMatrix() * state;
      const std::complex<double> innovation = y - predicted(0);
      state = predicted + Eigen::Vector2cd(k1 * innovation, k2 * innovation);
      gain = innovation / y;
    }
    const rigor::UpwardRounding upward;
    const Interval response = response_magnitude({Interval(k1), Interval(k2), Interval(x3)}, Interval(theta));
    const theorems::Derivation derivation = transfer_function({k1, k2, x3});
    if (derivation.verdict == Verdict::proved) {
      REQUIRE(rigor::is_finite(response));
      CHECK(rigor::midpoint(response) == doctest::Approx(std::abs(gain)).epsilon(1e-8));
      CHECK(find_quantity(derivation, "pole_radius").value.upper() < 1.0);
    } else {
      CHECK(!(std::abs(gain) < 1.0));
    }
  }
}

TEST_CASE("the Jury conditions say what the eigenvalues say") {
  Random random(82);
  for (int run = 0; run < 2000; ++run) {
    const double k1 = random.uniform(-0.5, 2.5);
    const double k2 = random.uniform(-2.0, 2.0);
    const double x3 = random.uniform(0.0, 3.1);
    Eigen::Matrix2d a = Eigen::Rotation2Dd(x3).toRotationMatrix();
    a = (Eigen::Matrix2d::Identity() - Eigen::Vector2d(k1, k2) * Eigen::RowVector2d(1.0, 0.0)) * a;
    const double radius = oracle::spectral_radius(a);
    if (std::fabs(radius - 1.0) < 1e-9) {
      continue;
    }
    const rigor::UpwardRounding upward;
    const theorems::Derivation derivation = transfer_function({k1, k2, x3});
    CHECK(derivation.verdict == (radius < 1.0 ? Verdict::proved : Verdict::refuted));
    CHECK(rigor::midpoint(find_quantity(derivation, "pole_radius").value) ==
          doctest::Approx(radius).epsilon(1e-6));
  }
}

TEST_CASE("the mean gain of a settled tracker stabilizes the frozen filter") {
  const FrozenGain<double> gain = mean_gain({0.005, 0.005, 0.01, 0.0}, 0.9);
  CHECK(gain.k1 > 0.3);
  CHECK(gain.k1 < 1.0);
  const rigor::UpwardRounding upward;
  CHECK(transfer_function(gain).verdict == Verdict::proved);
}

TEST_CASE("proposition 1 is decided in both directions where a steady state is verified, else undecided") {
  const rigor::UpwardRounding upward;
  SteadyStateBias exact;
  exact.verdict = Verdict::proved;
  exact.reason = "given";
  exact.frequency = Interval(0.9);
  exact.mean_bias = exact.min_error = exact.max_error = Interval(0.0);
  SteadyStateBias biased = exact;
  biased.mean_bias = Interval::from_bounds(-0.2, -0.1);
  const Interval leak(0.05);
  const auto both = proposition_1_conclusion(biased, exact, leak, "1.5");
  CHECK(verdict_of(both, "proposition-1/if") == Verdict::proved);
  CHECK(verdict_of(both, "proposition-1/only-if") == Verdict::proved);
  CHECK(proposition_1_conclusion(exact, exact, Interval(0.0), "1.5").size() == 1);
  biased.mean_bias = Interval::from_bounds(-0.2, 0.1);
  CHECK(verdict_of(proposition_1_conclusion(biased, exact, leak, "1.5"), "proposition-1/only-if") ==
        Verdict::undecided);
  SteadyStateBias unknown;
  unknown.reason = "not verified";
  const auto neither = proposition_1_conclusion(unknown, unknown, leak, "1.5");
  CHECK(verdict_of(neither, "proposition-1/if") == Verdict::undecided);
  CHECK(verdict_of(neither, "proposition-1/only-if") == Verdict::undecided);
}

TEST_CASE("proposition 2 needs P(0) scaled too") {
  const rigor::UpwardRounding upward;
  const auto statements = proposition_2();
  CHECK(verdict_of(statements, "proposition-2/scaled-start") == Verdict::proved);
  CHECK(verdict_of(statements, "proposition-2/same-start") == Verdict::refuted);
}

}  // namespace
}  // namespace veritrack::single_channel
