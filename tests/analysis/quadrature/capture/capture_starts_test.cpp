#include "analysis/quadrature/capture/capture_starts.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/analysis/quadrature/capture/capture_support.hpp"

namespace {

using namespace veritrack;
using quadrature::CertifiedSet;
using quadrature::StartCapture;
using rigor::Interval;
using rigor::Verdict;
using sets::ContractionQuestion;

constexpr double kNoise = 0.001;

/// The design q1 = q2 = 0.0013, r = 0.01, started far off.
sets::ContractionQuestion far_starts() {
  sets::ContractionQuestion question;
  question.design = {Interval(0.0013), Interval(0.0013), Interval(0.01), Interval(0.0)};
  question.noise = Interval(kNoise);
  question.initial_amplitude_error = Interval(0.1);
  question.initial_phase_error = Interval(0.6);
  question.initial_frequency_error = Interval(0.5);
  return question;
}

/// The set that was certified for it, found once.
const CertifiedSet& certified_set() {
  static const CertifiedSet set = [] {
    const auto certificate = quadrature::certify_contraction(far_starts());
    REQUIRE(certificate.set.has_value());
    REQUIRE(certificate.set->verdict == Verdict::proved);
    return certificate.set->set;
  }();
  return set;
}

double value(const StartCapture& capture, const char* name) {
  const theorems::Quantity& quantity = theorems::find_quantity(capture.derivation, name);
  CHECK_MESSAGE(!quantity.not_applicable.has_value(), name);
  return quantity.value.upper();
}

TEST_CASE("starts beyond the certified set are captured, and the tracker keeps to the bounds") {
  const rigor::UpwardRounding upward;
  const StartCapture capture = quadrature::capture_starts(far_starts(), certified_set(), "capture", 500);
  REQUIRE(capture.derivation.verdict == Verdict::proved);
  CHECK(value(capture, "cells") == value(capture, "cells_captured"));
  CHECK(value(capture, "settling_samples") >= value(capture, "capture_samples"));
  const std::vector<double>& tube = capture.frequency_errors;
  REQUIRE(!tube.empty());
  CHECK(value(capture, "frequency_error_bound") == *std::max_element(tube.begin(), tube.end()));
  CHECK(tube.front() >= 0.5);

  // The plain tracker, from the corners and from random starts, under noise of the largest size.
  const rigor::NearestRounding nearest;
  quadrature::CaptureProblem problem;
  problem.design = far_starts().design;
  problem.initial_covariance = rigor::to_interval(test::steady_covariance(0.0013, 0.01));
  test::Random random(71);
  for (std::int64_t run = 0; run < test::effort(200); ++run) {
    CAPTURE(run);
    test::TrackedRun tracker(problem, 0.7, test::member(rigor::symmetric(0.1), random),
                             test::member(rigor::symmetric(0.6), random),
                             test::member(rigor::symmetric(0.5), random));
    for (std::size_t k = 0; k < 2 * tube.size(); ++k) {
      CHECK(std::fabs(tracker.error()[2]) <= tube[std::min(k, tube.size() - 1)] * (1.0 + 1e-9));
      const double direction = random.uniform(-3.2, 3.2);
      tracker.step(kNoise * std::cos(direction), kNoise * std::sin(direction));
    }
  }
}

TEST_CASE("the result does not depend on being asked again") {
  const StartCapture one = quadrature::capture_starts(far_starts(), certified_set(), "capture", 500);
  const StartCapture two = quadrature::capture_starts(far_starts(), certified_set(), "capture", 500);
  CHECK(one.frequency_errors == two.frequency_errors);
  CHECK(one.region.cells.size() == two.region.cells.size());
}

TEST_CASE("starts that are too far are not captured, and the first cells that failed are named") {
  sets::ContractionQuestion question = far_starts();
  question.initial_amplitude_error = Interval(1.5);  // an estimate of amplitude zero has no phase
  const StartCapture capture = quadrature::capture_starts(question, certified_set(), "capture", 60);
  CHECK(capture.derivation.verdict == Verdict::undecided);
  CHECK(capture.derivation.conditions[1].reason.find(" cells of assumed starts could not be followed") !=
        std::string::npos);
  CHECK(capture.derivation.notes.size() == 3);
  CHECK(capture.frequency_errors.empty());
  for (const char* name : {"frequency_error_bound", "settling_samples", "capture_samples"}) {
    CHECK(theorems::find_quantity(capture.derivation, name).not_applicable.has_value());
  }
}

TEST_CASE("a start that locks a turn off is a witness") {
  sets::ContractionQuestion question = far_starts();
  question.noise = Interval(0.0);
  question.initial_amplitude_error = Interval(0.0);
  question.initial_phase_error = Interval(0.001);
  question.initial_frequency_error = Interval(6.2833);
  const StartCapture capture = quadrature::capture_starts(question, certified_set(), "capture", 0);
  CHECK(capture.derivation.verdict == Verdict::refuted);
  const double off = theorems::find_quantity(capture.derivation, "wrong_lock_frequency_error").value.lower();
  CHECK(off > 5.0);
  CHECK(off < 6.2832);
  CHECK(capture.derivation.conditions[1].reason.starts_with("witness: a start with frequency error in "));
}

TEST_CASE("a set for less noise than is assumed, or a leak, proves nothing") {
  sets::ContractionQuestion noisy = far_starts();
  noisy.noise = Interval(1.01 * certified_set().noise);
  sets::ContractionQuestion leaking = far_starts();
  leaking.design.epsilon = Interval(0.01);
  sets::ContractionQuestion unknown = far_starts();
  unknown.initial_phase_error = Interval::empty();
  for (const sets::ContractionQuestion& question : {noisy, leaking, unknown}) {
    const StartCapture capture = quadrature::capture_starts(question, certified_set(), "capture", 500);
    CHECK(capture.derivation.verdict == Verdict::undecided);
    CHECK(capture.region.cells.empty());
    CHECK(capture.frequency_errors.empty());
  }
}

}  // namespace
