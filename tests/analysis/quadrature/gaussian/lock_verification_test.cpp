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
  set = good;
  set.lowest_frequency = 0.1;
  CHECK(reason(set).find("frequencies") != std::string::npos);
  set = good;
  set.bias[1] = std::nan("");
  CHECK(reason(set).find("errors about which") != std::string::npos);
  for (const double epsilon : {-0.01, 1.0}) {
    trackers::ToneModel<Interval> leaking = design();
    leaking.epsilon = Interval(epsilon);
    CHECK(verify_lock_set(leaking, good).reason.find("epsilon") != std::string::npos);
  }
}

TEST_CASE("with a leak a set is proved for its frequencies, about the errors there") {
  const trackers::ToneModel<double>& d = test_sets::kLeakingDesign;
  const trackers::ToneModel<Interval> leaking{Interval(d.q1), Interval(d.q2), Interval(d.r),
                                              Interval(d.epsilon)};
  const LockSet good = test_sets::leaking_set();
  CHECK(verify_lock_set(leaking, good).verdict == Verdict::proved);
  SUBCASE("frequencies at which the tracker settles elsewhere") {
    LockSet wide = good;
    wide.highest_frequency = 30.0;
    CHECK(verify_lock_set(leaking, wide, 2000).verdict == Verdict::undecided);
  }
  SUBCASE("errors at which it does not settle") {
    LockSet aside = good;
    aside.bias[2] = 0.3;
    CHECK(verify_lock_set(leaking, aside, 2000).verdict == Verdict::undecided);
  }
  SUBCASE("only where the frequency error is negative: there is no mirror image") {
    // At these frequencies the tracker settles at the mirror image of the errors.
    LockSet mirrored = good;
    mirrored.lowest_frequency = -good.highest_frequency;
    mirrored.highest_frequency = -good.lowest_frequency;
    CHECK(verify_lock_set(leaking, mirrored, 2000).verdict == Verdict::undecided);
    mirrored.bias = {good.bias[0], -good.bias[1], -good.bias[2]};
    CHECK(verify_lock_set(leaking, mirrored).verdict == Verdict::proved);
  }
}

}  // namespace veritrack::quadrature
