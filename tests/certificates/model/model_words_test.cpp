#include "certificates/model/model_words.hpp"

#include <doctest/doctest.h>

#include <string>

#include "tests/certificates/model/model_certificates.hpp"

namespace veritrack::certificates {
namespace {

/// How the sentences on the loop begin, with this signal.
std::string tone_with(const std::string& signal) {
  std::string text = test::kLoopText;
  text.replace(text.find("noise = 0.02"), 0, signal + "\n");
  return ModelWords(model_tables(test::loop_design(text))).constant_tone();
}

}  // namespace

TEST_CASE("the tone alone is a tone, written out or not, as the checker has it; other signals are not") {
  const std::string tone = tone_with("");
  CHECK(tone.find("on a tone of amplitude 1 with") != std::string::npos);
  CHECK(tone_with("signal = 'A*cos(phi)'") == tone);
  CHECK(tone_with("signal = 'A*cos(phi) + 0.01*A*cos(2*phi)'").find("on the signal of the design file") !=
        std::string::npos);
}

}  // namespace veritrack::certificates
