#include "checker/document/evidence.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

using namespace veritrack::checker;

TEST_CASE("numbers and matrices of a certificate are read exactly") {
  const Tree tree = read_json(R"({"lo": "-0x1p-1", "hi": "0x1.8p+1", "rows":
      [["0x1p+0", "0x0p+0", "0x1p+1"], ["0x0p+0", "0x1p+0", "0x0p+0"], ["0x1p+1", "0x0p+0", "0x1p+2"]],
      "short": [["0x1p+0", "0x0p+0"]], "word": "nan"})");
  CHECK(certainly_equal(low_of(tree), Ball(-0.5)));
  CHECK(certainly_equal(high_of(tree), Ball(3.0)));
  const Matrix3 matrix = exact_matrix(tree.at("rows"));
  CHECK(certainly_equal(matrix[0][2], two));
  CHECK(certainly_equal(matrix[2][2], four));
  CHECK(symmetric(matrix));
  Matrix3 skewed = matrix;
  skewed[0][1] = one;
  CHECK(!symmetric(skewed));
  skewed[1][0] = Ball::within(two);
  CHECK(!symmetric(skewed));
  CHECK_THROWS_AS((void)exact_matrix(tree.at("short")), Malformed);
  CHECK_THROWS_AS((void)exact_number(tree.at("word")), std::invalid_argument);
}

TEST_CASE("evidence is found by its name") {
  const Tree derivation =
      read_json(R"({"evidence": [{"name": "first"}, {"name": "second", "numbers": {}}]})");
  REQUIRE(find_evidence(derivation, "second") != nullptr);
  CHECK(find_evidence(derivation, "second")->find("numbers") != nullptr);
  CHECK(find_evidence(derivation, "third") == nullptr);
  CHECK(find_evidence(read_json("{}"), "first") == nullptr);
}
