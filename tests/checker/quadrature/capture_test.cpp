// The claims about starts that are followed into the certified set.
#include "checker/quadrature/capture.hpp"

#include <doctest/doctest.h>

#include <map>
#include <string>

using namespace veritrack::checker;

namespace {

/// The claim "ekf/capture-at-reduced-noise", when the starts were followed under so much noise and slew.
Claim claim_under(double noise, double slew, Verdict verdict, Objections& objections) {
  const Tree claim =
      read_json(R"({"id": "ekf/capture-at-reduced-noise", "verdict": "proved", "evidence": {}})");
  Captured captured;
  captured.noise = Ball(noise);
  captured.slew = Ball(slew);
  captured.verdict = verdict;
  captured.covariance = "and with P(0|0) = M";
  return check_capture_claim(claim, {{"capture/reduced-noise", captured}}, objections);
}

}  // namespace

TEST_CASE("starts are captured under the noise and slew that they were followed under, and no more") {
  Objections objections;
  const Claim found = claim_under(0.2505, 0.125, Verdict::proved, objections);
  CHECK(objections.empty());
  CHECK(found.statement.find(
            "from every assumed start and with P(0|0) = M, with noise of at most 0.25 of the "
            "amplitude and slew of at most 0.125 rad/sample per sample, the tracker enters the "
            "certified set, which it never leaves.") != std::string::npos);
  claim_under(0.25, 0.125, Verdict::undecided, objections);
  CHECK_FALSE(objections.empty());
}

TEST_CASE("without the derivation nothing is captured") {
  Objections objections;
  for (const char* id : {"ekf/capture", "ekf/capture-noise-free", "ekf/capture-at-reduced-noise"}) {
    objections.clear();
    const Tree claim =
        read_json(std::string(R"({"id": ")") + id + R"(", "verdict": "proved", "evidence": {}})");
    check_capture_claim(claim, {}, objections);
    CHECK_FALSE(objections.empty());
  }
}
