#include "analysis/quadrature/gaussian/lock_verification.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "tests/analysis/quadrature/gaussian/lock_sets.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;
using rigor::Verdict;

trackers::ToneModel<Interval> design() {
  const trackers::ToneModel<double>& d = test_sets::kDesigns[0];
  return {Interval(d.q1), Interval(d.q2), Interval(d.r), Interval(0.0)};
}

}  // namespace

TEST_CASE("a set at 26 dB is proved; at 12 dB it is not") {
  const LockVerification proved = verify_lock_set(design(), test_sets::lock_set(0, 26.0));
  CHECK(proved.verdict == Verdict::proved);
  CHECK(proved.cells > 1000);
  MESSAGE("cells " << proved.cells);
  CHECK(verify_lock_set(design(), test_sets::lock_set(0, 12.0), 2000).verdict == Verdict::undecided);
}

TEST_CASE("sets whose numbers mean nothing are undecided, with the reason") {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const auto reason = [](const LockSet& set) {
    const LockVerification found = verify_lock_set(design(), set, 10);
    CHECK(found.verdict == Verdict::undecided);
    return found.reason;
  };
  const LockSet good = test_sets::lock_set(0, 26.0);
  LockSet set = good;
  SUBCASE("a level that is not a number") {
    set.level = nothing;
  }
  SUBCASE("no noise") {
    set.noise_deviation = 0.0;
  }
  SUBCASE("a weight below zero") {
    set.weight = -1.0;
  }
  SUBCASE("a drift below zero") {
    set.drift = -1e-3;
  }
  SUBCASE("a decay that is none") {
    set.decay = 1.0;
  }
  SUBCASE("a decay that is not positive") {
    set.decay = 0.0;
  }
  CHECK(reason(set).find("ranges") != std::string::npos);
  set = good;
  set.metric.phase = 0.0;
  CHECK(reason(set).find("invertible") != std::string::npos);
  set = good;
  set.spread_below.p33 = 0.1;
  CHECK(reason(set).find("definite") != std::string::npos);
  set = good;
  set.frequency_walk = 0.1;
  CHECK(reason(set).find("walks") != std::string::npos);
  trackers::ToneModel<Interval> leaking = design();
  leaking.epsilon = Interval(0.01);
  CHECK(verify_lock_set(leaking, good).reason.find("epsilon") != std::string::npos);
}

}  // namespace veritrack::quadrature
