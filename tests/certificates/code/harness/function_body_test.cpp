#include "certificates/code/harness/function_body.hpp"

#include <doctest/doctest.h>

#include "tests/certificates/code/harness/declared.hpp"

namespace veritrack::certificates::code {

TEST_CASE("writes go to parameters, to variables outside, and through local pointers to them") {
  const WrittenCode code(
      "struct s { float x; struct { float deep; } in; };\nstatic struct s one;\nstatic int ticks;\n"
      "void f(struct s* p, float y) { y += 1; float own = y; own = 2; p->in.deep = own; }\n"
      "void g(float y) { struct s* q = &one; q->x += y; ++ticks; }\n"
      "float h(const struct s* p) { return p->x; }\n"
      "float k(float y) { static float kept; kept += y; return kept; }\n"
      "void m(struct s* p) { f(p, 1.0f); p->x = 3.0f; }\n");
  const Declarations declarations = code.declarations();
  CHECK(function_named(declarations, "f").writes == std::set<std::string>{"p"});
  CHECK(function_named(declarations, "f").written_members == std::set<std::string>{"deep"});
  CHECK(function_named(declarations, "g").writes == std::set<std::string>{"one", "ticks"});
  CHECK(function_named(declarations, "g").written_members.count("x") == 1);
  CHECK(function_named(declarations, "h").writes.empty());
  CHECK(function_named(declarations, "k").writes == std::set<std::string>{"kept"});
  CHECK(function_named(declarations, "m").writes == std::set<std::string>{"p"});
  CHECK(function_named(declarations, "m").calls == std::set<std::string>{"f"});
  CHECK(function_named(declarations, "m").assigned.at("x") == 3.0);
  CHECK(function_named(declarations, "m").written_members.empty());
}

TEST_CASE("a method that is not const and is called on a member writes it") {
  const WrittenCode code(
      "struct In { float v = 0; void add(float x) { v += x; } float get() const { return v; } };\n"
      "struct Out { In in; void feed(float x) { in.add(x); } float read() const { return in.get(); } };\n",
      "loop.cpp");
  const Declarations declarations = code.declarations();
  CHECK(function_named(declarations, "Out::feed").writes == std::set<std::string>{"this"});
  CHECK(function_named(declarations, "Out::read").writes.empty());
}

TEST_CASE("products say what is multiplied by what, a turn included") {
  const WrittenCode code(
      kLoop + std::string("float f, t;\nvoid turn(void) { t += 2.0f * 3.14159265f * f / 100.0f; }\n"));
  const Declarations declarations = code.declarations();
  const Function& run = function_named(declarations, "pll_run");
  CHECK(run.products.count({"speed", "dt"}) == 1);
  CHECK(run.products.count({"dt", "kp"}) == 1);
  CHECK(run.products.count({"phase", "dt"}) == 0);
  CHECK(function_named(declarations, "turn").products.count({"f", "2pi"}) == 1);
}

}  // namespace veritrack::certificates::code
