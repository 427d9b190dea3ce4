#include "analysis/quadrature/gaussian/lock_answer.hpp"

#include <doctest/doctest.h>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/gaussian/lock_question.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

/// Thirty samples from starts that are far out: the level of the starts decides, and is less in a set for
/// more noise.
LockQuestion start_limited(double decibels) {
  const rigor::UpwardRounding upward;
  LockQuestion question = test_sets::question(decibels);
  const trackers::ToneModel<double> d{0.002, 0.0007, 0.03, 0.0};
  const BlockCovariance<double> p = *steady_covariance(d);
  Eigen::Matrix3d centre;
  centre << p.p11, 0.0, 0.0, 0.0, p.p22, p.p23, 0.0, p.p23, p.p33;
  question.design = {Interval(d.q1), Interval(d.q2), Interval(d.r), Interval(0.0)};
  question.samples = Interval(30.0);
  question.probability = 0.05;
  question.starts = {Interval(0.15),
                     Interval(0.3),
                     Interval(0.06),
                     {rigor::to_interval(centre), Interval::from_bounds(0.999, 1.001), false}};
  return question;
}

double probability_of(const LockCertificate& certificate) {
  const theorems::Quantity* found =
      theorems::applicable_quantity(certificate.derivation, "probability_of_losing_lock");
  return found == nullptr ? 1.0 : found->value.upper();
}

}  // namespace

TEST_CASE("where the set for the assumed noise does what is required, it is the answer") {
  const LockQuestion question = test_sets::question(26.0);
  const LockAnswer answer = answer_lock(question, false);
  CHECK_FALSE(answer.mean_square.has_value());
  REQUIRE_FALSE(answer.lock.sets.empty());
  CHECK(answer.lock.sets.front().noise_deviation == question.noise_deviation.upper());
  CHECK(probability_of(answer.lock) < question.probability);
}

TEST_CASE("a question without an answer has none with more noise either") {
  LockQuestion question = test_sets::question(3.0);
  CHECK(answer_lock(question, false).lock.sets.empty());
  question.noise_deviation = Interval();
  CHECK(answer_lock(question, true).lock.sets.empty());
}

TEST_CASE("what is proved at a lower ratio is proved at a higher one" * doctest::test_suite("nightly")) {
  for (const double decibels : {12.25, 13.0}) {
    const LockQuestion question = start_limited(decibels);
    const LockAnswer answer = answer_lock(question, false);
    CAPTURE(decibels);
    REQUIRE_FALSE(answer.lock.sets.empty());
    CHECK(probability_of(answer.lock) < question.probability);
    CHECK(answer.lock.sets.front().noise_deviation >= question.noise_deviation.upper());
  }
  // The set for the assumed noise does not do it.
  CHECK(probability_of(certify_lock(start_limited(13.0))) > 0.05);
}

}  // namespace veritrack::quadrature
