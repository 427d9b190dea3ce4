#include "certificates/code/harness/declarations.hpp"

#include <doctest/doctest.h>

#include "tests/certificates/code/harness/declared.hpp"

namespace veritrack::certificates::code {

TEST_CASE("structures are found under all their names") {
  const WrittenCode code(
      "typedef struct { float a; } one_t;\ntypedef struct two { float b; } two_t;\ntypedef two_t* two_p;\n"
      "static struct { float c; } three;\n");
  const Declarations declarations = code.declarations();
  REQUIRE(declarations.record_of("one_t *") != nullptr);
  CHECK(declarations.record_of("one_t *")->members.front().name == "a");
  REQUIRE(declarations.record_of("two_t *") != nullptr);
  CHECK(declarations.record_of("two_t *") == declarations.record_of("const struct two *"));
  REQUIRE(declarations.variables.size() == 1);
  REQUIRE(declarations.record_of(declarations.variables[0].type) != nullptr);
  CHECK(declarations.record_of(declarations.variables[0].type)->members.front().name == "c");
  CHECK(declarations.record_of("float") == nullptr);
}

TEST_CASE("functions have their place, parameters and result") {
  const Declarations declarations = WrittenCode(kLoop).declarations();
  const Function& run = function_named(declarations, "pll_run");
  CHECK(run.place.line == 4);
  CHECK(run.place.column == 6);
  CHECK(run.result == "void");
  REQUIRE(run.parameters.size() == 3);
  CHECK(run.parameters[0].type == "pll_t *");
  CHECK(run.parameters[2].name == "b");
  CHECK(function_named(declarations, "wrap").is_static);
}

TEST_CASE("classes have methods with their namespaces, those of instances with their arguments") {
  const WrittenCode code(
      "namespace ns { class A { public: explicit A(float k); void f(float x); float w = 3; }; }\n"
      "ns::A::A(float k) : w(k) {}\nvoid ns::A::f(float x) { w += x; }\n"
      "template <typename R, int n> struct B { R w{}; void feed(R x) { w += x; } };\nstatic B<float, 2> b;\n",
      "loop.cpp");
  const Declarations declarations = code.declarations();
  CHECK(function_named(declarations, "ns::A::f").place.line == 3);
  CHECK(function_named(declarations, "ns::A::A").is_constructor);
  // Nothing uses it, so that clang has its body in the template only.
  const Function& feed = function_named(declarations, "B<float, 2>::feed");
  CHECK(feed.parameters[0].type == "float");
  CHECK(feed.writes == std::set<std::string>{"this"});
  CHECK_FALSE(feed.is_template);
}

}  // namespace veritrack::certificates::code
