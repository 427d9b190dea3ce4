// Sets around the steady state that break one hypothesis and no other: each guard of verify_steady_set alone
// stands between them and PROVED.
#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "analysis/quadrature/leak/steady_verification.hpp"

namespace {

using namespace veritrack;
using namespace veritrack::quadrature;
using rigor::Interval;
using rigor::Verdict;
using LeakingDesign = trackers::ToneModel<Interval>;

LeakingDesign leaking_design() {
  return {Interval(0.0013), Interval(0.0013), Interval(0.01), Interval(0.01)};
}

const sets::LockBranch& narrow_branch() {
  static const sets::LockBranch branch =
      sets::verify_lock_branch(leaking_design(), Interval::from_bounds(0.02, 0.0201), {.largest = 0.1});
  REQUIRE(branch.verdict == Verdict::proved);
  return branch;
}

SteadySet verified_steady_set() {
  SteadySet set;
  set.metric << 0x1.26f60fcf42f99p+3, -0x1.4474904eb833fp-4, 0x1.314e15e4258c8p-2, 0.0, 0x1.72f8404d79878p+2,
      -0x1.35c7f87585c5fp+1, 0.0, 0.0, 0x1.fe07e5b01d99p+2;
  set.below << 0x1.9e5f9a46e91c6p-11, 0x1.5934cff3bf5cp-16, 0x1.43903c3d3673dp-15, 0x1.5934cff3bf5cp-16,
      0x1.ae4bd437c40e4p-10, 0x1.b7eed69dfaae3p-11, 0x1.43903c3d3673dp-15, 0x1.b7eed69dfaae3p-11,
      0x1.568f2161610c5p-11;
  set.above << 0x1.22704c0998bcbp-10, -0x1.14551f14672a8p-17, 0x1.385cb246b75d6p-15, -0x1.14551f14672a8p-17,
      0x1.832e438f0261cp-10, 0x1.f8e67a0592e88p-11, 0x1.385cb246b75d6p-15, 0x1.f8e67a0592e88p-11,
      0x1.d6dbdf05b0d92p-11;
  set.levels = {1.0, 0x1.d244f73243c0ap-1};
  set.noise = 0x1.0624dd2f1a9fcp-10;
  set.slew = 0.0;
  return set;
}

bool is_proved(const SteadySet& set, const LeakingDesign& design = leaking_design()) {
  return verify_steady_set(design, narrow_branch().cells, set).verdict == Verdict::proved;
}

/// Is it refused, and for a reason with these words in it?
bool is_refused(const SteadySet& set, const char* words, const LeakingDesign& design = leaking_design()) {
  const SteadyVerification found = verify_steady_set(design, narrow_branch().cells, set);
  return found.verdict != Verdict::proved && found.reason.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("the set around the steady state is proved as it stands, and for a little slew") {
  CHECK(is_proved(verified_steady_set()));
  SteadySet set = verified_steady_set();
  set.slew = 0x1p-20;
  CHECK(is_proved(set));
  set.slew = 0x1p-4;
  CHECK_FALSE(is_proved(set));
}

TEST_CASE("numbers and entries that a set around the steady state may not have") {
  SteadySet set = verified_steady_set();
  SUBCASE("negative noise") {
    set.noise = -0x1p-20;
  }
  SUBCASE("negative slew") {
    set.slew = -0x1p-4;
  }
  SUBCASE("a first row of T with another sign") {
    set.metric.row(0) *= -1.0;
  }
  SUBCASE("a second row of T with another sign") {
    set.metric.row(1) *= -1.0;
  }
  SUBCASE("a third row of T with another sign") {
    set.metric.row(2) *= -1.0;
  }
  SUBCASE("levels that begin below 1") {
    set.levels[0] = 0.99;
  }
  SUBCASE("a bound below that is none") {
    set.below(0, 0) = -0x1p-30;
  }
  SUBCASE("a bound above that is none") {
    set.above(0, 0) = -0x1p-30;
  }
  SUBCASE("a bound below that is not kept") {
    set.below(2, 2) *= 0.85;
  }
  SUBCASE("a bound above that is not kept") {
    set.above(2, 2) *= 0.85;
  }
  CHECK_FALSE(is_proved(set));
}

TEST_CASE("an entry below the diagonal of T, or off the symmetry of a bound, is refused, however small") {
  for (const auto& [i, j] : {std::pair{1, 0}, {2, 0}, {2, 1}}) {
    CAPTURE(i);
    CAPTURE(j);
    SteadySet set = verified_steady_set();
    set.metric(i, j) = 0x1p-60;
    CHECK_FALSE(is_proved(set));
    for (rigor::Matrix<3> SteadySet::*bound : {&SteadySet::below, &SteadySet::above}) {
      set = verified_steady_set();
      (set.*bound)(i, j) *= 1.0 + 0x1p-50;
      CHECK_FALSE(is_proved(set));
    }
  }
}

TEST_CASE("a set around the steady state is refused for the first of its faults") {
  SteadySet set = verified_steady_set();
  const char* words = "covariance bounds are not certainly positive definite";
  SUBCASE("below") {
    set.below(0, 0) *= -1.0;
  }
  SUBCASE("above") {
    set.above(0, 0) *= -1.0;
  }
  SUBCASE("so far below that covariances of the set are not definite") {
    set.below(0, 0) *= 8.0;
    words = "lower covariance bound is not certainly positive definite";
  }
  CHECK(is_refused(set, words));
}

TEST_CASE("designs that may be none") {
  LeakingDesign design = leaking_design();
  SUBCASE("measurement noise that may be none") {
    design.r = Interval::from_bounds(0.0, design.r.upper());
  }
  SUBCASE("a leak that may be less than none") {
    design.epsilon = Interval::from_bounds(-0x1p-60, design.epsilon.upper());
  }
  SUBCASE("a leak of 1") {
    design.epsilon = Interval::from_bounds(design.epsilon.lower(), 1.0);
  }
  SUBCASE("process noise of the amplitude") {
    design.q1 = Interval::from_bounds(-0x1p-60, design.q1.upper());
  }
  SUBCASE("process noise of the frequency") {
    design.q2 = Interval::from_bounds(-0x1p-60, design.q2.upper());
  }
  CHECK(is_refused(verified_steady_set(), "the design is not one", design));
}
