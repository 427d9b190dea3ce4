#include "certificates/code/harness/constants.hpp"

#include <doctest/doctest.h>

#include "tests/certificates/code/harness/declared.hpp"

namespace veritrack::certificates::code {

TEST_CASE("constants of literals have their value, all else has none") {
  const WrittenCode code(
      "float a = 1.0f / 12500.0f;\nfloat b = -(2 * 3.5f);\nfloat c = 7 / 2;\nextern float d;\n"
      "struct { float x, y; } s = {2.5f, 1 + 1};\n");
  const Declarations declarations = code.declarations();
  REQUIRE(declarations.variables.size() == 5);
  CHECK(declarations.variables[0].value == doctest::Approx(8e-5));
  CHECK(declarations.variables[1].value == -7.0);
  CHECK(declarations.variables[2].value == 3.0);
  CHECK_FALSE(declarations.variables[3].value);
  REQUIRE(declarations.variables[4].values.size() == 2);
  CHECK(declarations.variables[4].values[0] == 2.5);
  CHECK(declarations.variables[4].values[1] == 2.0);
  CHECK_FALSE(constant_value({{"kind", "DeclRefExpr"}}));
}

}  // namespace veritrack::certificates::code
