// The claims about starts that are followed into the certified set.
#include "checker/quadrature/capture.hpp"

#include <doctest/doctest.h>

#include <map>
#include <string>

using namespace veritrack::checker;

namespace {

/// Is the claim "ekf/capture-at-reduced-noise" with this statement verified, when the starts were followed
/// under noise up to 1/4 and slew up to 1/8?
bool is_verified(const std::string& statement, Verdict verdict = Verdict::proved) {
  const Tree claim = read_json(R"({"id": "ekf/capture-at-reduced-noise", "verdict": "proved", "evidence": {},
      "statement": ")" + statement +
                               R"("})");
  Captured captured;
  captured.noise = Ball(0.25);
  captured.slew = Ball(0.125);
  captured.verdict = verdict;
  Objections objections;
  check_capture_claim(claim, {{"capture/reduced-noise", captured}}, objections);
  return objections.empty();
}

std::string sentence(const std::string& noise, const std::string& slew) {
  return "From every assumed start, with noise of at most " + noise +
         " of the amplitude and slew of at most " + slew +
         " rad/sample per sample, the tracker enters the certified set, which it never leaves.";
}

}  // namespace

TEST_CASE("starts are captured under the noise and slew that they were followed under, and no more") {
  CHECK(is_verified(sentence("0.25", "0.125")));
  CHECK(is_verified(sentence("0.2", "0.0")));
  CHECK(!is_verified(sentence("0.26", "0.125")));
  CHECK(!is_verified(sentence("0.25", "0.126")));
  CHECK(!is_verified(sentence("0.25", "0.125"), Verdict::undecided));
}

TEST_CASE("another sentence about the capture is not verified") {
  CHECK(!is_verified("From every assumed start the tracker comes into the certified set."));
  CHECK(!is_verified(sentence("0.25", "0.125") + " So it is."));
  CHECK(!is_verified("Always: " + sentence("0.25", "0.125")));
}
