#include "certificates/code/harness/syntax_tree.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

#include "certificates/design/input_error.hpp"
#include "tests/certificates/code/harness/declared.hpp"

namespace veritrack::certificates::code {

TEST_CASE("declarations of the system's headers are left out, and each place has its file and line") {
  const std::string dump =
      R"({"id": "0x1", "kind": "TranslationUnitDecl", "range": {"begin": {}, "end": {}}, "inner": [
        {"kind": "TypedefDecl", "loc": {}, "range": {}, "name": "built_in"},
        {"kind": "FunctionDecl", "loc": {"offset": 1, "file": "/usr/include/math.h", "line": 3, "col": 2},
         "range": {"begin": {"offset": 1, "col": 2}}, "name": "sin"},
        {"kind": "VarDecl", "loc": {"offset": 7, "file": "pll.h", "line": 5, "col": 9, "includedFrom": {"file": "pll.c"}},
         "range": {}, "name": "w"},
        {"kind": "VarDecl", "loc": {"offset": 9, "col": 12}, "range": {}, "name": "v"}]})";
  const std::vector<nlohmann::json> kept = own_declarations_in(dump, "pll.c");
  REQUIRE(kept.size() == 2);
  CHECK(kept[0].at("name") == "w");
  CHECK(kept[1].at("name") == "v");
  CHECK(kept[1].at("loc").at("file") == "pll.h");
  CHECK(kept[1].at("loc").at("line") == 5);
}

TEST_CASE("what is no tree, and what does not compile, are errors") {
  CHECK_THROWS_AS((void)own_declarations_in("{\"inner\": [", "pll.c"), std::invalid_argument);
  const WrittenCode code("int x;\nfloat f(float x) { return x }\n");
  try {
    (void)own_declarations(code.file(), {});
    FAIL("compiled");
  } catch (const InputError& error) {
    CHECK(error.file() == code.file());
    CHECK(error.line() == 2);
    CHECK(error.column() == 28);
  }
}

TEST_CASE("of a file that includes a header of the system its own functions are kept") {
  const WrittenCode code("#include <math.h>\nfloat f(float x) { return sinf(x); }\n");
  const std::vector<nlohmann::json> kept = own_declarations(code.file(), {});
  REQUIRE(kept.size() == 1);
  CHECK(kept[0].at("name") == "f");
  CHECK(kept[0].at("loc").at("line") == 2);
}

}  // namespace veritrack::certificates::code
