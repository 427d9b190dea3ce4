#include "checker/document/design_file.hpp"

#include <doctest/doctest.h>

#include <string>

#include "checker/document/sha256.hpp"

using namespace veritrack::checker;

namespace {

const std::string kFile = R"(name = "a design"
tracker = "a-kind"
[design]
q = 0.001   # µ
rates = [1, 2.50]
[assume]
frequency = 0.5
[simulate]
samples = 10
)";

std::string number(const std::string& text) {
  return R"({"text": ")" + text + R"(", "lo": "0x1p+0", "hi": "0x1p+0"})";
}

std::string certificate(const std::string& q, const std::string& more = "") {
  return R"({"design_sha256": ")" + sha256(kFile) +
         R"(", "design": {"name": "a design", "tracker": "a-kind",)" + R"( "source": "", "design": {"q": )" +
         number(q) + R"(, "rates": [)" + number("1") + "," + number("2.50") + R"(], "epsilon": )" +
         number("0") + "}, \"assume\": {\"frequency\": [" + number("0.5") + "," + number("0.5") + "]" + more +
         "}}}";
}

Objections compared(const std::string& text, const std::string& file = kFile) {
  Objections objections;
  compare_with_design_file(read_json(text), file, objections);
  return objections;
}

}  // namespace

TEST_CASE(
    "every decimal is compared as it is written, defaults are known, and the simulation is left aside") {
  CHECK(compared(certificate("0.001")).empty());
  CHECK(compared(certificate("0.0010")).size() == 1);
  CHECK(compared(certificate("1e-3")).size() == 1);
}

TEST_CASE("what is on one side only is told") {
  CHECK(compared(certificate("0.001", R"(, "noise": )" + number("1"))).size() == 1);
  CHECK(compared(certificate("0.001", R"(, "slew": )" + number("0"))).empty());
  CHECK(compared(certificate("0.001", R"(, "slew": )" + number("1"))).size() == 1);
  const Objections more = compared(certificate("0.001"), kFile + "[require]\nbelow = 1\n");
  CHECK(more.size() == 2);  // another SHA-256, and a table that the certificate has not
}

TEST_CASE("a file that is no TOML is malformed") {
  CHECK_THROWS_AS(compared(certificate("0.001"), "name = "), Malformed);
}
