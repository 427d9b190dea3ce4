#include "certificates/code/harness/candidates.hpp"

#include <doctest/doctest.h>

#include "tests/certificates/code/harness/declared.hpp"

namespace veritrack::certificates::code {
namespace {

std::string why_refused(const StepCandidates& candidates, const std::string& name) {
  for (const RefusedFunction& each : candidates.refused) {
    if (each.function->full_name() == name) {
      return each.why;
    }
  }
  return "";
}

}  // namespace

TEST_CASE("the step changes what its parameter points to; others are refused with a reason") {
  const WrittenCode code(std::string(kLoop) +
                         "void three(pll_t* p, float a, float b, float c) { p->kp = a * b * c; }\n"
                         "void text(pll_t* p, const char* s, float y) { p->kp = y * *s; }\n");
  const Declarations declarations = code.declarations();
  const StepCandidates candidates = step_candidates(declarations, code.file());
  REQUIRE(candidates.taken.size() == 1);
  const StepCandidate& step = candidates.taken.front();
  CHECK(step.function->name == "pll_run");
  CHECK(step.samples() == 2);
  CHECK(step.object_type() == "pll_t");
  CHECK(why_refused(candidates, "wrap").find("keeps nothing") != std::string::npos);
  CHECK(why_refused(candidates, "pll_init").find("preparation") != std::string::npos);
  CHECK(why_refused(candidates, "three").find("takes 3 numbers") != std::string::npos);
  CHECK(why_refused(candidates, "text").find("parameter s is of type const char *") != std::string::npos);

  const std::vector<const Function*> inits = init_candidates(declarations, code.file(), step);
  REQUIRE(inits.size() == 1);
  CHECK(inits.front()->name == "pll_init");
}

TEST_CASE("a function that others call is less likely; a time, an angle and outputs are no samples") {
  const WrittenCode code(
      "static float w;\nstatic void track(float y) { w += y; }\n"
      "void process(float phase, float dt, float* out) { track(phase * dt); *out = w; }\n");
  const Declarations declarations = code.declarations();
  const StepCandidates candidates = step_candidates(declarations, code.file());
  REQUIRE(candidates.taken.size() == 2);
  CHECK(candidates.taken[0].function->name == "process");
  CHECK(candidates.taken[0].roles == std::vector<Role>{Role::angle, Role::period, Role::output});
  CHECK(candidates.taken[0].samples() == 2);
  CHECK(candidates.taken[1].samples() == 1);
}

TEST_CASE("the only variable of a type is the object; a function of it that writes nothing is read") {
  const WrittenCode code(std::string(kLoop) +
                         "pll_t pll;\nfloat get_speed(const pll_t* p) { return p->speed; }\n"
                         "void setup(void) { pll_init(&pll, 1, 2); }\n");
  const Declarations declarations = code.declarations();
  const StepCandidates candidates = step_candidates(declarations, code.file());
  REQUIRE(candidates.taken.size() == 1);
  REQUIRE(object_in_file(declarations, "pll_t") != nullptr);
  CHECK(object_in_file(declarations, "pll_t")->name == "pll");
  CHECK(reads_a_number(function_named(declarations, "get_speed"), candidates.taken[0], declarations));
  CHECK_FALSE(reads_a_number(function_named(declarations, "wrap"), candidates.taken[0], declarations));
  // It needs no guesses.
  CHECK(init_candidates(declarations, code.file(), candidates.taken[0]).front()->name == "setup");
  const WrittenCode twice(std::string(kLoop) + "pll_t a, b;\n");
  CHECK(object_in_file(twice.declarations(), "pll_t") == nullptr);
}

}  // namespace veritrack::certificates::code
