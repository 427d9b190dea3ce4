// The claims about starts that are followed into the certified set.
#include "checker/quadrature/capture.hpp"

#include <doctest/doctest.h>

#include <map>
#include <string>

using namespace veritrack::checker;

namespace {

/// A tone of amplitude 2 with a noise of 0.5 and a slew of 0.25, and starts up to 0.5 rad/sample off.
Tree design() {
  const auto number = [](const char* text, const char* value) {
    return std::string(R"({"text": ")") + text + R"(", "lo": ")" + value + R"(", "hi": ")" + value + R"("})";
  };
  const std::string half = number("0.5", "0x1p-1");
  const std::string quarter = number("0.25", "0x1p-2");
  return read_json(R"({"assume": {"amplitude": )" + number("2", "0x1p+1") + R"(, "frequency": [)" + quarter +
                   ", " + number("3", "0x1.8p+1") + R"(], "noise": )" + half + R"(, "slew": )" + quarter +
                   R"(, "initial_frequency_error": )" + half + R"(, "initial_phase_error": )" + quarter +
                   R"(, "initial_amplitude_error": )" + quarter + R"(}, "require": {}})");
}

/// The claim, when that is what was found.
Claim checked(const std::string& id, const std::map<std::string, Captured>& captured,
              Objections& objections) {
  const Tree claim = read_json(R"({"id": ")" + id + R"(", "verdict": "proved", "evidence": {}})");
  const Tree tables = design();
  const Guarantee guarantee(tables, {false, true, kDoublePrecision}, objections);
  return check_capture_claim(claim, captured, guarantee, objections);
}

/// The claim "ekf/capture-at-reduced-noise", when the starts were followed under so much noise and slew.
Claim claim_under(double noise, double slew, Verdict verdict, Objections& objections) {
  Captured captured;
  captured.noise = Ball(noise);
  captured.slew = Ball(slew);
  captured.verdict = verdict;
  captured.covariance = "and with P(0|0) = M";
  return checked("ekf/capture-at-reduced-noise", {{"capture/reduced-noise", captured}}, objections);
}

}  // namespace

TEST_CASE("starts are captured under the noise and slew that they were followed under, and no more") {
  Objections objections;
  const Claim found = claim_under(0.2505, 0.125, Verdict::proved, objections);
  CHECK(objections.empty());
  CHECK(
      found.statement ==
      std::string(kDoublePrecision) +
          ", for a tone of constant amplitude 2 whose frequency is at most pi rad/sample and changes by at "
          "most 0.125 rad/sample per sample, with measurement noise of at most 0.25 of the amplitude (the "
          "length of the error in both channels), started within 0.5 rad/sample of the true frequency, 0.25 "
          "rad of the phase and 0.25 of the amplitude and with P(0|0) = M, the tracker enters the certified "
          "set, which it never leaves.");
  claim_under(0.25, 0.125, Verdict::undecided, objections);
  CHECK_FALSE(objections.empty());
}

TEST_CASE("the sentence names the noise and slew under which starts are captured") {
  Captured captured;
  captured.verdict = Verdict::proved;
  Objections objections;
  const std::string assumed = checked("ekf/capture", {{"capture", captured}}, objections).statement;
  CHECK(assumed.find(
            " and changes by at most 0.25 rad/sample per sample, with measurement noise of at most 0.5 "
            "(the length of the error in both channels; 0.353 in each is enough), started") !=
        std::string::npos);
  const std::string none =
      checked("ekf/capture-noise-free", {{"capture/noise-free", captured}}, objections).statement;
  CHECK(none.find(" and is constant, without measurement noise, started") != std::string::npos);
  CHECK(objections.empty());
}

TEST_CASE("without the derivation nothing is captured") {
  Objections objections;
  for (const char* id : {"ekf/capture", "ekf/capture-noise-free", "ekf/capture-at-reduced-noise"}) {
    objections.clear();
    checked(id, {}, objections);
    CHECK_FALSE(objections.empty());
  }
}
