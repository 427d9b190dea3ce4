// Certificates about formulas in a format: their sentences name it where rounding is in the bounds, and no
// other one.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "checker/verification.hpp"
#include "tests/checker/model/gain/gain_loops.hpp"
#include "tests/support/golden.hpp"

namespace veritrack::checker {
namespace {

using test::Json;

Json accepted() {
  return Json::parse(test::read_file(std::string(VERITRACK_SOURCE_DIR) +
                                     "/tests/certificates/accepted/model-arithmetic.json"));
}

/// The sentence of a claim where everything is verified; otherwise nothing.
std::string sentence(const Json& certificate, const std::string& words) {
  const Verification found = verify(read_json(certificate.dump()));
  if (!std::all_of(found.parts.begin(), found.parts.end(),
                   [](const auto& part) { return part.objections.empty(); })) {
    return "";
  }
  for (const auto& each : found.sentences) {
    if (each.text.find(words) != std::string::npos) {
      return each.text;
    }
  }
  return "";
}

constexpr const char* kNoise = "the tracker tolerates noise up to";
constexpr const char* kStable = "the steady state of the certificate is stable";

}  // namespace

TEST_CASE("a sentence names the format, what it assumes of the library and the wrap of angles") {
  const std::string said = sentence(accepted(), kNoise);
  CHECK(said.starts_with(
      "In single precision (IEEE 754 binary32) of the formulas as they are written, every number and every "
      "operation rounded to nearest, products and sums fused or not, subnormal results kept or flushed to 0, "
      "sinf and cosf within 1.5*2^-24 for arguments up to 8, other functions of the library within two units "
      "in the last place, angles wrapped to half a turn at every sample, and begun there, on a tone of "));
  CHECK(sentence(accepted(), kStable).starts_with("In exact arithmetic, on a tone"));
}

TEST_CASE("another format is another sentence") {
  Json certificate = accepted();
  certificate["design"]["model"]["arithmetic"] = "binary64";
  CHECK(sentence(certificate, kNoise)
            .starts_with("In double precision (IEEE 754 binary64) of the formulas as they are written, every "
                         "number and every operation rounded to nearest, products and sums fused or not, "
                         "subnormal results kept or flushed to 0, functions of the library within"));
}

TEST_CASE("without rooms a sentence is about exact arithmetic, whatever the design says") {
  Json certificate = accepted();
  certificate["gains"].erase("rounding");
  CHECK(sentence(certificate, kNoise).starts_with("In exact arithmetic, on a tone"));
}

}  // namespace veritrack::checker
