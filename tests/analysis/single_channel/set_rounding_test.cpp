#include "analysis/single_channel/set_rounding.hpp"

#include <doctest/doctest.h>

namespace veritrack::single_channel {
namespace {

using rigor::Interval;

struct RoundedSet {
  PhaseQuestion question;
  PhaseSet set;

  RoundedSet() {
    question.tracker.design = {Interval(0.005), Interval(0.005), Interval(0.01), Interval(0.0)};
    question.band = Interval::from_bounds(0.4, 2.7);
    set.claim.assumption = {0.026, 0.0228, 0.114, 0.025};
    set.noise = Interval(1e-3);
    set.start = DiagonalStart{"0.003", "0.003", "0.95", "1.05"};
    set.claim.assumption.rounding = allowed_rounding(question, set.claim, set.noise);
  }
};

TEST_CASE("sixteen times the bound is allowed, at the amplitude of the question") {
  const rigor::UpwardRounding upward;
  RoundedSet one;
  const StepRounding bound =
      window_rounding(one.question.tracker.design, {Interval(1.0), one.question.band, one.set.noise},
                      one.set.claim.assumption);
  CHECK(one.set.claim.assumption.rounding.error >= 16.0 * bound.error);
  CHECK(one.set.claim.assumption.rounding.covariance >= 16.0 * bound.covariance);
  CHECK(one.set.claim.assumption.rounding.error <= 16.001 * bound.error);
  CHECK(one.set.claim.assumption.rounding.covariance <= 16.001 * bound.covariance);
  one.question.tracker.amplitude = Interval(0x1p-61);
  CHECK_FALSE(allowed_rounding(one.question, one.set.claim, one.set.noise).is_bounded());
}

TEST_CASE("starts whose first step rounds more than the set allows for are not covered") {
  const rigor::UpwardRounding upward;
  const RoundedSet good;
  CHECK(covers_start(good.question, good.set));
  RoundedSet larger;
  larger.set.start = DiagonalStart{"30000", "0.003", "0.95", "1.05"};
  CHECK_FALSE(covers_start(larger.question, larger.set));
  RoundedSet of_error;
  of_error.set.claim.assumption.rounding.error *= 0.99;
  CHECK_FALSE(covers_start(of_error.question, of_error.set));
  RoundedSet of_covariance;
  of_covariance.set.claim.assumption.rounding.covariance *= 0.99;
  CHECK_FALSE(covers_start(of_covariance.question, of_covariance.set));
  RoundedSet unbounded;
  unbounded.set.claim.assumption.rounding = kUnboundedRounding;
  unbounded.question.tracker.amplitude = Interval(0x1p61);
  CHECK_FALSE(covers_start(unbounded.question, unbounded.set));
}

}  // namespace
}  // namespace veritrack::single_channel
