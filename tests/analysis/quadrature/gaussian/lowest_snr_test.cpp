#include "analysis/quadrature/gaussian/lowest_snr.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/gaussian/lock_question.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;
using rigor::Verdict;

constexpr std::int64_t kFewCells = 30'000;

/// A hundred samples: a small set.
LockQuestion short_question(double decibels) {
  LockQuestion result = test_sets::question(decibels);
  result.samples = Interval(100.0);
  result.probability = 0.1;
  result.starts.covariance.multiples = Interval::from_bounds(0.95, 1.05);
  result.starts.covariance.is_given = true;
  return result;
}

}  // namespace

TEST_CASE("the lowest ratio is far below an easy one, proved, and hardly depends on where the search begins" *
          doctest::test_suite("nightly")) {
  const LockQuestion easy = short_question(26.0);
  LockCertificate at_its_noise;
  {
    const rigor::UpwardRounding upward;
    at_its_noise.proposal = propose_lock_set(proposal_request(easy));
  }
  const LowestSnr found = certify_lowest_snr(easy, at_its_noise.proposal, kFewCells);
  REQUIRE(found.set.has_value());
  CHECK(found.derivation.id == "lowest-snr");
  CHECK(found.derivation.verdict == Verdict::proved);
  const double lowest = theorems::find_quantity(found.derivation, "lowest_snr").value.upper();
  MESSAGE("lowest " << lowest << " dB, " << found.cells << " cells");
  CHECK(lowest < 20.0);
  CHECK(lowest > 8.0);
  // The set is for what is said, and no other noise than the set's is in it.
  const double deviation = found.set->noise_deviation;
  CHECK(lowest >= -10.0 * std::log10(2.0 * deviation * deviation));
  CHECK(lowest == doctest::Approx(-10.0 * std::log10(2.0 * deviation * deviation)));
  CHECK(theorems::find_quantity(found.derivation, "probability_of_losing_lock").value.upper() < 0.1);
  // From far too much noise upwards.
  const LowestSnr from_below = certify_lowest_snr(short_question(8.0), std::nullopt, kFewCells);
  REQUIRE(from_below.set.has_value());
  CHECK(std::fabs(theorems::find_quantity(from_below.derivation, "lowest_snr").value.upper() - lowest) < 0.6);
}

TEST_CASE("where nothing can be certified there is no ratio") {
  LockQuestion leaking = short_question(20.0);
  leaking.design.epsilon = Interval(0.01);
  CHECK_THROWS_AS((void)certify_lowest_snr(leaking, std::nullopt), std::invalid_argument);
  LockQuestion undriven = short_question(20.0);
  undriven.design.q1 = Interval(0.0);
  const LowestSnr found = certify_lowest_snr(undriven, std::nullopt);
  CHECK_FALSE(found.set.has_value());
  CHECK(found.derivation.verdict == Verdict::undecided);
  CHECK(theorems::applicable_quantity(found.derivation, "lowest_snr") == nullptr);
}

TEST_CASE("decibels of a deviation") {
  const rigor::UpwardRounding upward;
  const Interval tenth = decibels_of(Interval(0.1));
  CHECK(tenth.lower() <= 16.98970004336019);
  CHECK(tenth.upper() >= 16.98970004336018);
  CHECK(tenth.upper() - tenth.lower() < 1e-12);
}

}  // namespace veritrack::quadrature
