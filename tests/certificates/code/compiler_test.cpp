#include "certificates/code/compiler.hpp"

#include <doctest/doctest.h>

#include "certificates/design/input_error.hpp"

namespace veritrack::certificates::code {

TEST_CASE("flags that change results are refused, folders are those from the design") {
  CHECK_NOTHROW(require_flags({{"-DMOTOR=3", {}}, {"-std=gnu11", {}}}, "pll.toml"));
  CHECK_THROWS_AS(require_flags({{"-ffast-math", {3, 9}}}, "pll.toml"), InputError);
  CHECK(flag_arguments({{"-Iinc", {}}, {"-I/usr/inc", {}}, {"-fsingle-precision-constant", {}}}, "a") ==
        std::vector<std::string>{"-Ia/inc", "-I/usr/inc", "-Xclang", "-cl-single-precision-constant"});
  CHECK(is_cpp("a/b.cpp"));
  CHECK_FALSE(is_cpp("a/b.c"));
}

TEST_CASE("the first error of a compiler is ours, with its place") {
  try {
    refuse_compilation("note: x\na/b.c:3:7: error: expected ';'\nb.c:4:1: error: other\n", "b.c");
  } catch (const InputError& error) {
    CHECK(error.file() == "a/b.c");
    CHECK(error.line() == 3);
    CHECK(error.column() == 7);
    CHECK(error.message() == "error: expected ';'");
  }
  CHECK_THROWS_AS(refuse_compilation("segmentation fault", "b.c"), InputError);
}

TEST_CASE("a program that is not installed is an error of the design") {
  CHECK_THROWS_AS((void)run_limited("no-such-program", {}, "pll.toml", {1, 1}), InputError);
}

}  // namespace veritrack::certificates::code
