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

TEST_CASE("a range of covariances is compared at both ends, whatever is on the other side") {
  const auto range = [](const std::string& from, const std::string& to) {
    return R"(, "initial_covariance": {"from": )" + from + R"(, "to": )" + to + "}";
  };
  const auto objections = [](const std::string& more, const std::string& line) {
    // One more than these: the file has another SHA-256.
    std::string file = kFile;
    file.insert(file.find("[simulate]"), line + "\n");
    return compared(certificate("0.001", more), file).size() - 1;
  };
  const std::string multiples = range(number("0.5"), number("2"));
  CHECK(objections(multiples, "initial_covariance = { to = 2, from = 0.5 }") == 0);
  CHECK(objections(multiples, "initial_covariance = { from = 0.5, to = 2.0 }") == 1);
  CHECK(objections(multiples, "initial_covariance = { from = 0.5 }") == 1);
  CHECK(objections(multiples, "initial_covariance = { from = 0.5, to = 2, by = 1 }") == 1);
  CHECK(objections(multiples, "initial_covariance = { from = [[0.5]], to = 2 }") == 1);
  CHECK(objections(multiples, "initial_covariance = 'steady-state'") > 0);
  CHECK(objections(multiples, "") > 0);
  CHECK(objections("", "initial_covariance = { from = 0.5, to = 2 }") == 1);
  CHECK(objections(R"(, "initial_covariance": "steady-state")",
                   "initial_covariance = { from = 0.5, to = 2 }") == 1);
  const std::string matrices = range("[[" + number("1") + "]]", "[[" + number("2") + "]]");
  CHECK(objections(matrices, "initial_covariance = { from = [[1]], to = [[2]] }") == 0);
  CHECK(objections(matrices, "initial_covariance = { from = [[1]], to = [[3]] }") == 1);
}

TEST_CASE("a file that is no TOML is malformed") {
  CHECK_THROWS_AS(compared(certificate("0.001"), "name = "), Malformed);
}
