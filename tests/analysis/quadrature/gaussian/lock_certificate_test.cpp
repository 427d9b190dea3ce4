#include "analysis/quadrature/gaussian/lock_certificate.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/quadrature/gaussian/lock_rounding.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/gaussian/lock_question.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;
using rigor::Verdict;

using test_sets::question;

Verdict verdict_of(const LockCertificate& certificate, const std::string& id) {
  for (const theorems::Condition& condition : certificate.derivation.conditions) {
    if (condition.id == id) {
      return condition.verdict;
    }
  }
  return Verdict::refuted;
}

}  // namespace

TEST_CASE("a design with little noise has its probability, and it is the one that was asked for") {
  const LockCertificate found = certify_lock(question(26.0));
  REQUIRE_FALSE(found.sets.empty());
  CHECK(found.derivation.verdict == Verdict::proved);
  const double p = theorems::find_quantity(found.derivation, "probability_of_losing_lock").value.upper();
  CHECK(p < 1e-2);
  CHECK(p > 0.2e-2);
  CHECK(found.cells > 0);
  // The covariance may be another one by much.
  CHECK(found.covariance_multiples.lower() < 0.9);
  CHECK(found.covariance_multiples.upper() > 1.1);
  // By the formula, with the level that is said.
  const double level = theorems::find_quantity(found.derivation, "start_level").value.upper();
  CHECK(p == doctest::Approx(std::exp(-found.sets.front().level) *
                             (std::exp(level) + found.sets.front().drift / (1.0 - found.sets.front().decay) +
                              1000.0 * found.sets.front().drift)));
  const double reach = theorems::find_quantity(found.derivation, "lock_frequency_error").value.upper();
  CHECK(reach ==
        doctest::Approx(std::sqrt(2.0 * found.sets.front().level) / found.sets.front().metric.frequency));
}

TEST_CASE("what is not certified says why, and claims nothing") {
  LockQuestion noisy = question(3.0);
  LockCertificate found = certify_lock(noisy);
  CHECK(found.sets.empty());
  CHECK(verdict_of(found, "drift") == Verdict::undecided);
  CHECK(theorems::applicable_quantity(found.derivation, "probability_of_losing_lock") == nullptr);
  LockQuestion walking = question(26.0);
  walking.design.epsilon = Interval(0.01);
  walking.frequency_walk = Interval(1e-6);
  found = certify_lock(walking);
  CHECK(found.sets.empty());
  CHECK(verdict_of(found, "constant-frequency") == Verdict::undecided);
  LockQuestion far = question(26.0);
  far.starts.phase_error = Interval(3.0);
  found = certify_lock(far);
  CHECK(found.sets.empty());
  CHECK(verdict_of(found, "start-in-set") == Verdict::undecided);
  CHECK(theorems::applicable_quantity(found.derivation, "probability_of_losing_lock") == nullptr);
}

TEST_CASE("with a leak a band of constant frequencies has its probability, and the bias is in the bound") {
  LockQuestion leaking = question(30.0);
  leaking.design.epsilon = Interval(0.01);
  leaking.frequencies = Interval::from_bounds(0.9, 1.1);
  leaking.starts.covariance.multiples = Interval(1.0);
  const LockCertificate found = certify_lock(leaking);
  REQUIRE_FALSE(found.sets.empty());
  CHECK(found.derivation.verdict == Verdict::proved);
  CHECK(verdict_of(found, "constant-frequency") == Verdict::proved);
  CHECK(theorems::find_quantity(found.derivation, "probability_of_losing_lock").value.upper() < 1e-2);
  const LockSet& set = found.sets.front();
  CHECK(set.bias[2] < -0.02);
  CHECK(theorems::find_quantity(found.derivation, "lock_frequency_error").value.upper() >=
        -set.bias[2] + 0.999 * std::sqrt(2.0 * set.level) / set.metric.frequency);
}

TEST_CASE("questions without a meaning have no answer") {
  const auto refuses = [](void (*spoil)(LockQuestion&)) {
    LockQuestion spoilt = question(26.0);
    spoil(spoilt);
    const LockCertificate found = certify_lock(spoilt);
    CHECK(found.sets.empty());
    CHECK_FALSE(found.derivation.verdict == Verdict::proved);
  };
  refuses([](LockQuestion& q) { q.noise_deviation = Interval(0.0); });
  refuses([](LockQuestion& q) { q.noise_deviation = Interval(); });
  refuses([](LockQuestion& q) { q.samples = Interval(0.0); });
  refuses([](LockQuestion& q) { q.samples = Interval(); });
  refuses([](LockQuestion& q) { q.frequency_walk = Interval(-1.0); });
  refuses([](LockQuestion& q) { q.probability = 0.0; });
  refuses([](LockQuestion& q) { q.design.q2 = Interval::from_bounds(0.0, 1.0); });
}

TEST_CASE("rounding has room in ordinary units, and none beyond them") {
  const rigor::UpwardRounding upward;
  const LockSet set = test_sets::lock_set(0, 20.0);
  const trackers::ToneModel<double>& d = test_sets::kDesigns[0];
  const trackers::ToneModel<Interval> design{Interval(d.q1), Interval(d.q2), Interval(d.r), Interval(0.0)};
  const LockRounding found = lock_rounding(design, {}, set, Interval(1e6));
  MESSAGE("error " << found.error << ", covariance " << found.covariance);
  CHECK(found.has_room);
  CHECK(found.error < 0.1 * kRoundingRoom);
  CHECK_FALSE(lock_rounding(design, {Interval(0x1p61), 3.2}, set, Interval(1e6)).has_room);
  CHECK_FALSE(lock_rounding(design, {Interval(1.0), 1e12}, set, Interval(1e6)).has_room);
  CHECK_FALSE(lock_rounding(design, {}, set, Interval()).has_room);
  LockSet walking = set;
  walking.frequency_walk = 1e-3;
  CHECK_FALSE(lock_rounding(design, {}, walking, Interval(1e30)).has_room);
  // 4 N + 2 tails of exp(-450).
  CHECK(probability_beyond(Interval(1e6)).upper() == doctest::Approx(4.000002e6 * std::exp(-450.0)));
}

}  // namespace veritrack::quadrature
