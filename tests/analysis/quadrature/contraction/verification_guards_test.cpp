// Certified sets that break one hypothesis and no other: each guard of verify_certified_set alone stands
// between them and PROVED.
#include <doctest/doctest.h>

#include <cstddef>
#include <string>

#include "analysis/quadrature/contraction/proposal.hpp"
#include "analysis/quadrature/contraction/verification.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;
using rigor::Verdict;
using Design = trackers::ToneModel<Interval>;

Design la_scala() {
  return {Interval(0.0023), Interval(0.0023), Interval(0.05), Interval(0.0)};
}

/// Of the design of La Scala's Figure 3.5 without its leak.
CertifiedSet verified_set() {
  CertifiedSet set;
  set.metric << 0x1.dd7f420252bdap+0, 0.0, 0.0, 0.0, 0x1.94a22f42e4696p+2, -0x1.02075762a01aap+2, 0.0, 0.0,
      0x1.5c78cd65fb9f1p+4;
  set.covariance_lower << 0x1.2e4c5a0945dbfp-7, 0.0, 0.0, 0.0, 0x1.832337e95f5c9p-6, 0x1.cf96fd9ebfcdbp-8,
      0.0, 0x1.cf96fd9ebfcdbp-8, 0x1.d54edb3a42124p-8;
  set.covariance_upper << 0x1.49e1fbad57c06p-7, 0.0, 0.0, 0.0, 0x1.b0b68f440f5c1p-6, 0x1.099c6fba71f43p-7,
      0.0, 0x1.099c6fba71f43p-7, 0x1.080dcafbd5d4ap-7;
  set.radius = 0x1.efdab44e59523p-4;
  set.noise = 0x1.0624dd2f1a9fcp-10;
  set.slew = 0.0;
  set.rate = 0x1.fb4e515d8926ep-1;
  set.noise_gain = 0x1.fb2a00562bb92p+3;
  set.slew_gain = 0.0;
  return set;
}

bool is_proved(const CertifiedSet& set, const Design& design = la_scala()) {
  return verify_certified_set(design, set).verdict == Verdict::proved;
}

/// Is it refused, and for a reason with these words in it?
bool is_refused(const CertifiedSet& set, const char* words) {
  const Verification found = verify_certified_set(la_scala(), set);
  return found.verdict != Verdict::proved && found.reason.find(words) != std::string::npos;
}

bool is_proved_with(double CertifiedSet::*member, double value) {
  CertifiedSet set = verified_set();
  set.*member = value;
  return is_proved(set);
}

TEST_CASE("the set is proved as it stands") {
  CHECK(is_proved(verified_set()));
}

TEST_CASE("numbers of a set have their sign, though the inequality knows only their squares") {
  const CertifiedSet set = verified_set();
  CHECK_FALSE(is_proved_with(&CertifiedSet::radius, -set.radius));
  CHECK_FALSE(is_proved_with(&CertifiedSet::noise, -set.noise));
  CHECK_FALSE(is_proved_with(&CertifiedSet::rate, -set.rate));
  CHECK_FALSE(is_proved_with(&CertifiedSet::noise_gain, -set.noise_gain));
  CHECK_FALSE(is_proved_with(&CertifiedSet::slew_gain, -1.0));
  CertifiedSet slewing = set;
  slewing.slew_gain = 1024.0;
  slewing.slew = 0x1p-30;
  CHECK(is_proved(slewing));
  slewing.slew = -0x1p-30;
  CHECK_FALSE(is_proved(slewing));
}

TEST_CASE("a set whose errors do not shrink is not proved, with noise and without") {
  CertifiedSet set = verified_set();
  set.noise = 0.0;
  set.rate = 1.0;
  set.radius = 0x1p-4;  // of which the square is exact
  CHECK_FALSE(is_proved(set));
}

TEST_CASE("noise and slew that push the errors out of the set are not tolerated") {
  CHECK_FALSE(is_proved_with(&CertifiedSet::noise, 0x1p-8));
  CertifiedSet set = verified_set();
  set.noise = 0.0;
  set.slew_gain = 1024.0;
  set.slew = 0x1p-12;
  CHECK_FALSE(is_proved(set));
}

TEST_CASE("a set is refused for the first of its faults") {
  CertifiedSet set = verified_set();
  set.radius *= -1.0;
  CHECK(is_refused(set, "outside their ranges"));
  set = verified_set();
  set.rate = 1.0;
  CHECK(is_refused(set, "outside their ranges"));
  set = verified_set();
  set.covariance_lower(0, 0) *= -1.0;
  CHECK(is_refused(set, "positive definite and in order"));
  set = verified_set();
  set.covariance_lower(1, 2) = set.covariance_lower(2, 1) = 0x1.c8p-6;
  set.covariance_upper(2, 2) = 1.0;
  set.covariance_upper(1, 1) = 1.0;
  CHECK(is_refused(set, "positive definite and in order"));
}

TEST_CASE("covariance bounds below zero, or not kept on one side") {
  CertifiedSet set = verified_set();
  set.noise = 0.0;
  set.radius = 0x1p-20;
  REQUIRE(is_proved(set));
  SUBCASE("below zero in the amplitude") {
    set.covariance_lower(0, 0) = -0x1p-10;
  }
  SUBCASE("below zero in phase and frequency") {
    set.covariance_lower(1, 2) = set.covariance_lower(2, 1) = 0x1.c8p-7;
  }
  SUBCASE("a lower bound that is not kept") {
    set.covariance_lower = 0.999 * set.covariance_upper;
  }
  SUBCASE("an upper bound that is not kept") {
    set.covariance_upper = 1.001 * set.covariance_lower;
  }
  CHECK_FALSE(is_proved(set));
}

TEST_CASE("covariance bounds below zero, where process noise hides them from the gains") {
  ProposalRequest request;
  request.design = {0.1, 0.001, 0.01, 0.0};
  request.objective = Objective::start_error;
  request.evaluations = 40;
  const auto shapes = propose_shapes(request);
  REQUIRE(!shapes.empty());
  auto set = propose_set(request, shapes.front(), 0.2);
  REQUIRE(set.has_value());
  const Design design{Interval(0.1), Interval(0.001), Interval(0.01), Interval(0.0)};
  REQUIRE(is_proved(*set, design));
  SUBCASE("in the amplitude") {
    set->covariance_lower(0, 0) = -1e-3;
  }
  SUBCASE("in the phase") {
    set->covariance_lower(1, 1) = -1e-3;
    set->covariance_lower(1, 2) = set->covariance_lower(2, 1) = 0.0;
  }
  CHECK_FALSE(is_proved(*set, design));
}

TEST_CASE("an entry that the form does not have is refused, however small") {
  for (const auto& [i, j] : {std::pair{0, 1}, {0, 2}, {1, 0}, {2, 0}, {2, 1}}) {
    CAPTURE(i);
    CAPTURE(j);
    CertifiedSet set = verified_set();
    set.metric(i, j) = 0x1p-60;
    CHECK_FALSE(is_proved(set));
    for (rigor::Matrix<3> CertifiedSet::*bound :
         {&CertifiedSet::covariance_lower, &CertifiedSet::covariance_upper}) {
      set = verified_set();
      (set.*bound)(i, j) += 0x1p-50;
      CHECK_FALSE(is_proved(set));
    }
  }
  for (const int i : {0, 1, 2}) {
    CAPTURE(i);
    CertifiedSet set = verified_set();
    set.metric.row(i) *= -1.0;  // |T e| is the same
    CHECK_FALSE(is_proved(set));
  }
}

TEST_CASE("designs that the theorem is not about") {
  Design design = la_scala();
  SUBCASE("a leak") {
    design.epsilon = Interval(0x1p-60);
  }
  SUBCASE("a leak that may be none") {
    design.epsilon = Interval::from_bounds(0.0, 0x1p-60);
  }
  SUBCASE("process noise of the amplitude that may be negative") {
    design.q1 = Interval::from_bounds(-0x1p-60, 0.0023);
  }
  SUBCASE("process noise of the frequency that may be zero") {
    design.q2 = Interval::from_bounds(0.0, 0.0023);
  }
  CHECK_FALSE(is_proved(verified_set(), design));
}

}  // namespace
}  // namespace veritrack::quadrature
