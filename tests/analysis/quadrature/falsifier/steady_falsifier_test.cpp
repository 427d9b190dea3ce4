#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "analysis/quadrature/falsifier/sampled_limit.hpp"
#include "analysis/quadrature/falsifier/steady_sampled_quantities.hpp"
#include "analysis/quadrature/leak/steady_certificate.hpp"
#include "tests/support/random.hpp"

using namespace veritrack;
using namespace veritrack::quadrature;
using rigor::Interval;
using rigor::Verdict;

namespace {

struct Certified {
  trackers::ToneModel<Interval> design;
  sets::LockBranch branch;
  SteadySet set;
};

/// A PROVED set for a random leaky design and a narrow band; nothing when none was found.
std::optional<Certified> some_set(test::Random& random) {
  const rigor::UpwardRounding upward;
  const double q = std::exp(random.uniform(std::log(8e-4), std::log(8e-3)));
  const double r = std::exp(random.uniform(std::log(0.008), std::log(0.05)));
  const double low = random.uniform(0.1, 2.0);
  LeakQuestion question;
  question.tracker.design = {Interval(q), Interval(q * random.uniform(0.5, 2.0)), Interval(r),
                             Interval(random.uniform(0.002, 0.03))};
  question.tracker.noise = Interval(random.uniform(0.0, 0.001));
  question.tracker.search_evaluations = 20;
  question.tracker.with_samples = false;
  question.band = Interval::from_bounds(low, low + 0.05);
  auto certificate = certify_with_leak(question);
  if (!certificate.set || certificate.set->verdict != Verdict::proved) {
    return std::nullopt;
  }
  return Certified{question.tracker.design,
                   sets::verify_lock_branch(question.tracker.design, question.band, {.largest = 0.1}),
                   certificate.set->set};
}

/// One of them, found once.
const Certified& an_example() {
  static test::Random random(52);
  static const std::optional<Certified> found = some_set(random);
  REQUIRE(found.has_value());
  return *found;
}

}  // namespace

TEST_CASE("with a leak: the falsifier does not break a PROVED set, and comes near its bounds" *
          doctest::test_suite("nightly")) {
  test::Random random(51);
  const auto count = test::effort(5);
  int proved = 0;
  FalsifierOptions effort;
  effort.search_evaluations = 10;
  for (int i = 0; i < count; ++i) {
    CAPTURE(i);
    const auto certified = some_set(random);
    if (!certified) {
      continue;
    }
    ++proved;
    const std::vector<SetClaim> claims = claims_of(certified->design, certified->branch, certified->set);
    REQUIRE(claims.size() == 3);
    for (const SetClaim& claim : claims) {
      const Falsification found = try_to_break(claim, effort);
      CHECK_MESSAGE(!found.alarm, (found.alarm ? found.alarm->statement : ""));
      CHECK(found.from_rim.tightness() <= 1.0 + 1e-9);
      CHECK(found.from_zero.tightness() <= 1.0 + 1e-9);
      CHECK(found.from_rim.tightness() > 0.3);
    }
    CHECK(sampled_radius_limit(claims.front()) >= 1.0);
  }
  CHECK(2 * proved >= count);
}

TEST_CASE("with a leak: the falsifier breaks sets that promise too much") {
  const Certified& certified = an_example();
  SteadySet set = certified.set;
  SUBCASE("faster levels") {
    set.levels = {1.0, 0.2, 0.1};
  }
  SUBCASE("more noise") {
    set.noise = 0.2;
  }
  SUBCASE("narrower covariance bounds") {
    set.above *= 0.05;
    set.below *= 0.05;
  }
  SUBCASE("a larger set") {
    set.metric *= 0.1;
  }
  CHECK(try_to_break(claims_of(certified.design, certified.branch, set).front()).alarm.has_value());
}

TEST_CASE("with a leak: what is no set is refused") {
  const Certified& certified = an_example();
  SteadySet set = certified.set;
  SUBCASE("no levels") {
    set.levels.clear();
  }
  SUBCASE("bounds that are not in order") {
    set.above = -set.above;
  }
  SUBCASE("a singular metric") {
    set.metric.setZero();
  }
  CHECK_THROWS_AS(static_cast<void>(claims_of(certified.design, certified.branch, set)),
                  std::invalid_argument);
}
