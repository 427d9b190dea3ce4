#include "reports/comparison/certificate_contents.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace {

using namespace veritrack::reports;  // NOLINT(google-build-using-namespace)

std::string with_claims(const std::string& claims) {
  return R"({"schema": "veritrack/certificate/2", "verdict": "proved", "design": {"tracker": "model"}, "claims": [)" +
         claims + "]}";
}

TEST_CASE("of a claim for each part of a band the worst counts") {
  const auto contents = contents_of(with_claims(
      R"({"id": "model/steady-state", "verdict": "proved", "required": false, "evidence": {}, "ripple": "1e-4"},
         {"id": "model/steady-state", "verdict": "proved", "required": false, "evidence": {}, "ripple": "3e-4"},
         {"id": "model/steady-state", "verdict": "proved", "required": false, "evidence": {}, "ripple": "2e-4"})"));
  CHECK(contents.claims.at("model/steady-state").bounds.at("ripple").value == 3e-4);
  const auto refuted = contents_of(with_claims(
      R"({"id": "a", "verdict": "proved", "required": false, "evidence": {}},
         {"id": "a", "verdict": "refuted", "required": true, "evidence": {}})"));
  CHECK(refuted.claims.at("a").verdict == "refuted");
  CHECK(refuted.claims.at("a").is_required);
}

TEST_CASE("what is not a number is worse than every number") {
  const auto contents = contents_of(with_claims(
      R"({"id": "ekf/guarantee", "verdict": "proved", "required": false, "evidence": {"b": {"hi": "0x1p+0"}}},
         {"id": "ekf/guarantee", "verdict": "proved", "required": false, "evidence": {"b": {"hi": "nan"}}})"));
  const double value = contents.claims.at("ekf/guarantee").bounds.at("b").value;
  CHECK(value != value);
}

TEST_CASE("every required claim of every fixture is a guarantee by its id") {
  std::size_t required = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(VERITRACK_SOURCE_DIR "/tests/certificates/accepted")) {
    std::ifstream stream(entry.path());
    const auto contents =
        contents_of({std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()});
    for (const auto& [id, said] : contents.claims) {
      INFO(entry.path().string(), ": ", id);
      CHECK((!said.is_required || Said{}.is_guaranteed(id)));
      required += said.is_required ? 1U : 0U;
    }
  }
  CHECK(required > 20);
}

TEST_CASE("a published result and a false lock are no guarantee") {
  CHECK_FALSE(Said{}.is_guaranteed("lemma-3.1/conditions"));
  CHECK_FALSE(Said{}.is_guaranteed("dft-block/false-lock-above"));
  CHECK(Said{}.is_guaranteed("dft-block/guarantee"));
}

}  // namespace
