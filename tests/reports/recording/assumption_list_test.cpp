#include "reports/recording/assumption_list.hpp"

#include <doctest/doctest.h>

#include <algorithm>

namespace veritrack::reports {
namespace {

using Outcome = TestedAssumption::Outcome;

/// In lock, judged, nothing exceeded.
TrackReport clean(bool gaussian) {
  TrackReport report;
  report.assume.frequency = {0.1, 1.0};
  report.assume.slew = 1e-6;
  report.assume.start = {"phase off by at most 0.1 rad"};
  if (gaussian) {
    report.assume.noise_deviation = 0.1;
    report.assume.samples = 1000.0;
  } else {
    report.assume.noise = 0.3;
  }
  report.result.channels = 2;
  report.result.window = 64;
  report.result.samples = 900;
  report.result.first_lock = 10;
  report.result.assumptions.judged = 640;
  return report;
}

Outcome outcome_of(const TrackReport& report, const std::string& name, const std::string& assumed) {
  const std::vector<TestedAssumption> rows = tested_assumptions(report);
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const TestedAssumption& each) {
    return each.name == name && each.assumed.find(assumed) != std::string::npos;
  });
  INFO(name, ": ", assumed);
  REQUIRE(row != rows.end());
  return row->outcome;
}

TEST_CASE("only what was tested is said to be kept, and the rest is named") {
  const TrackReport report = clean(false);
  CHECK(keeps_to_tested(report));
  CHECK(assumptions_sentence(report) ==
        "Tested and kept, as far as estimates tell: signal, amplitude, frequency, slew, noise, samples. Not "
        "testable "
        "here: noise, outside of the samples judged, start.");
  CHECK(outcome_of(report, "start", "phase off") == Outcome::not_testable);
  CHECK(assumptions_section(report).find(
            "640 of 900 samples lie in such stretches, and only these were tested") != std::string::npos);
}

TEST_CASE("nothing judged is nothing tested") {
  TrackReport report = clean(false);
  report.result.assumptions.judged = 0;
  CHECK_FALSE(keeps_to_tested(report));
  for (const TestedAssumption& each : tested_assumptions(report)) {
    CHECK((each.outcome == Outcome::not_testable || each.name == "samples"));
  }
  CHECK(assumptions_sentence(report).find("was not tested") != std::string::npos);
}

TEST_CASE("what is exceeded is not kept, with its samples") {
  TrackReport report = clean(false);
  report.result.assumptions.slew_exceeded.add(100, 200);
  CHECK(outcome_of(report, "slew", "at most") == Outcome::not_kept);
  CHECK(outcome_of(report, "frequency", "from") == Outcome::kept);
  CHECK(assumptions_sentence(report) ==
        "The recording does not keep to the certificate's assumptions: slew.");
  CHECK(assumptions_section(report).find("| **not kept** | samples 100 to 200 |") != std::string::npos);
}

TEST_CASE("a finding: within a bound it is noise, and Gaussian noise it is not") {
  Finding offset;
  offset.name = "DC offset";
  offset.is_signal = true;
  offset.where.add(0, 899);
  TrackReport bounded = clean(false);
  bounded.result.recording.push_back(offset);
  CHECK(keeps_to_tested(bounded));
  bounded.result.assumptions.noise_exceeded.add(5, 5);
  CHECK(outcome_of(bounded, "signal", "a tone alone") == Outcome::not_kept);
  TrackReport gaussian = clean(true);
  CHECK(keeps_to_tested(gaussian));
  gaussian.result.recording.push_back(offset);
  CHECK_FALSE(keeps_to_tested(gaussian));
  CHECK(outcome_of(gaussian, "signal", "Gaussian noise") == Outcome::not_kept);
}

TEST_CASE("a sweep that was seen outside of lock, and missing samples") {
  TrackReport report = clean(false);
  Finding sweep;
  sweep.name = "fast sweep";
  sweep.is_slew = true;
  sweep.where.add(300, 400);
  report.result.recording.push_back(sweep);
  CHECK(outcome_of(report, "slew", "at most") == Outcome::not_kept);
  report.result.assumptions.judged = 0;
  CHECK(outcome_of(report, "slew", "at most") == Outcome::not_kept);
  report = clean(false);
  Finding gaps;
  gaps.name = "gaps";
  gaps.is_missing = true;
  gaps.where.add(7, 9);
  report.result.recording.push_back(gaps);
  CHECK(outcome_of(report, "samples", "every sample arrives") == Outcome::not_kept);
}

TEST_CASE("after a Hilbert filter a Gaussian certificate does not apply, and one for a bound may") {
  TrackReport gaussian = clean(true);
  CHECK_FALSE(hilbert_excludes_certificate(gaussian));
  CHECK(outcome_of(gaussian, "independent noise", "from sample to sample") == Outcome::not_testable);
  gaussian.result.quadrature_is_derived = true;
  CHECK(hilbert_excludes_certificate(gaussian));
  CHECK_FALSE(keeps_to_tested(gaussian));
  CHECK(outcome_of(gaussian, "independent noise", "from sample to sample") == Outcome::not_kept);
  CHECK(outcome_of(gaussian, "independent noise", "from channel to channel") == Outcome::not_kept);
  CHECK(headline(gaussian).starts_with(
      "The Gaussian certificate does not apply: after the Hilbert filter, noise is"));
  TrackReport bounded = clean(false);
  bounded.result.quadrature_is_derived = true;
  CHECK_FALSE(hilbert_excludes_certificate(bounded));
  CHECK(keeps_to_tested(bounded));
}

TEST_CASE("more samples than were assumed, a random walk, an amplitude that drifts in its range") {
  TrackReport report = clean(true);
  report.result.samples = 1001;
  CHECK(outcome_of(report, "samples", "at most 1000") == Outcome::not_kept);
  report.assume.slew.reset();
  CHECK(outcome_of(report, "steps of the frequency", "random walk") == Outcome::not_testable);
  Finding drift;
  drift.name = "amplitude drift";
  drift.where.add(0, 10);
  report.result.recording.push_back(drift);
  report.assume.amplitude = {0.5, 2.0};
  CHECK(outcome_of(report, "amplitude", "0.5 to 2") == Outcome::not_kept);
  report.assume.amplitude_varies = true;
  CHECK(outcome_of(report, "amplitude", "0.5 to 2") == Outcome::kept);
}

}  // namespace
}  // namespace veritrack::reports
