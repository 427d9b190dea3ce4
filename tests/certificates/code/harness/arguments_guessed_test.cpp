#include "certificates/code/harness/arguments_guessed.hpp"

#include <doctest/doctest.h>

#include "certificates/code/harness/harness_plan.hpp"
#include "tests/certificates/code/harness/declared.hpp"

namespace veritrack::certificates::code {

TEST_CASE("arguments are the object, a variable of the file, a guess, or a name that does not compile") {
  const std::string text = std::string(kLoop) +
                           "typedef struct { float limit; } conf_t;\nstatic const conf_t conf = {1.0f};\n"
                           "void other(const conf_t* c, pll_t* p, float kp, float gamma, double dt) { p->kp "
                           "= kp * gamma * dt * c->limit; }\n";
  const WrittenCode code(text);
  const Declarations declarations = code.declarations();
  HarnessPlan plan = harness_plan(declarations, code.file(), text, "pll_run");
  plan.sample_rate = 1000.0;
  const GuessedArguments guessed = guessed_arguments(function_named(declarations, "other").parameters, plan,
                                                     declarations, guess_context(plan, declarations));
  CHECK(guessed.values ==
        std::vector<std::string>{"&conf", "&tracker", "160.0f", "PUT_gamma_HERE", "1.0 / 1000.0"});
  CHECK(guessed.numbers == std::vector<std::string>{"kp", "gamma", "dt"});
  CHECK(guessed.advice.find("put yours") != std::string::npos);
  CHECK(guessed_numbers(plan, declarations) == std::vector<std::string>{"kp", "dt"});
}

TEST_CASE("members that nothing sets are guessed, those that something sets are left alone") {
  const std::string text =
      "struct pll { float w, ki, gamma; };\nvoid run(struct pll* p, float y) { p->w += p->ki * y; }\n";
  const WrittenCode code(text);
  const Declarations declarations = code.declarations();
  const HarnessPlan plan = harness_plan(declarations, code.file(), text, "");
  const std::string statements = members_left_open(plan, declarations, guess_context(plan, declarations));
  CHECK(statements.find("tracker.ki = 0.0002f;  // guessed: nothing in the file sets ki (loop.c:1)") !=
        std::string::npos);
  CHECK(statements.find("tracker.gamma = 0;  // put yours") != std::string::npos);
  CHECK(statements.find("tracker.w") == std::string::npos);
}

}  // namespace veritrack::certificates::code
