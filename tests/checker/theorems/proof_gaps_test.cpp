// What the proof of Theorem 2.9 takes for granted, decided for designs of which it is known.
#include "checker/theorems/proof_gaps.hpp"

#include <doctest/doctest.h>

using namespace veritrack::checker;

namespace {

/// The verdict on P(k+1|k) <= s I by the thesis's constants.
Verdict is_bounded_by_s(double process_noise, double measurement_noise, double sigma) {
  Design design;
  design.q1 = design.q2 = Ball(process_noise);
  design.r = Ball(measurement_noise);
  design.epsilon = design.state_bound = zero;
  design.sigma = Ball(sigma);
  design.gamma_fraction = half;
  design.c1 = design.c2 = one;
  return proof_gaps(design).at("theorem-2.9/s/printed").verdict;
}

}  // namespace

TEST_CASE(
    "s is a bound of the covariance where one of the filter's is below it, and none below the process "
    "noise") {
  // s is 1/q1 and more.
  CHECK(is_bounded_by_s(0.0023, 0.05, 0.1) == Verdict::proved);
  CHECK(is_bounded_by_s(100.0, 1.0, 0.1) == Verdict::refuted);
  // Above the process noise, and below the measurement noise, which the covariance comes near.
  CHECK(is_bounded_by_s(1.0, 1000.0, 0.1) == Verdict::undecided);
  // No error is admitted: eps_r is negative.
  CHECK(is_bounded_by_s(0.0023, 0.05, 0.75) == Verdict::undecided);
}
