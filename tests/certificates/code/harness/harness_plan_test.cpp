#include "certificates/code/harness/harness_plan.hpp"

#include <doctest/doctest.h>

#include "certificates/design/input_error.hpp"
#include "tests/certificates/code/harness/declared.hpp"

namespace veritrack::certificates::code {
namespace {

HarnessPlan planned(const std::string& text, const std::string& function = "", const char* name = "loop.c") {
  const WrittenCode code(text, name);
  // Its functions are those of declarations that end here: only names are looked at.
  static Declarations declarations;
  declarations = code.declarations();
  return harness_plan(declarations, code.file(), text, function);
}

std::string message_for(const std::string& text, const std::string& function, int line) {
  try {
    (void)planned(text, function);
  } catch (const InputError& error) {
    CHECK(error.line() == line);
    return error.message();
  }
  return "";
}

}  // namespace

TEST_CASE("the likeliest is chosen, or the one that is named") {
  const std::string text =
      "static float w;\nvoid run(float y) { w += y; }\nvoid other(float y) { w -= y; }\n";
  CHECK(planned(text).step.function->name == "run");
  CHECK(planned(text).other_steps.size() == 1);
  CHECK(planned(text, "other").step.function->name == "other");
  CHECK(planned(text).frequencies.front().expression == "w");
}

TEST_CASE("where nothing is a step the message says what was seen, and why it is none") {
  const std::string text = "float wrap(float x) { return x; }\nint f(int n) { return n; }\n";
  const std::string message = message_for(text, "", 1);
  CHECK(message.find("wrap (line 1): it keeps nothing") != std::string::npos);
  CHECK(message.find("f (line 2): its parameter n is of type int") != std::string::npos);
  CHECK(message_for("int x;\n", "", 1).find("defines no function") != std::string::npos);
  CHECK(message_for(text, "f", 2).find("f is no step") != std::string::npos);
  const std::string loop = "static float w;\nvoid run(float y) { w += y; }\n";
  CHECK(message_for(loop, "walk", 1).find("no function walk; allowed: run (line 2)") != std::string::npos);
}

TEST_CASE("names of the harness that the file has are renamed, in expressions, too") {
  const HarnessPlan plan = planned(
      "struct s { float frequency; };\nvoid setup(struct s* p) { p->frequency = 1; }\n"
      "float frequency(const struct s* tracker) { return tracker->frequency; }\n"
      "void step(struct s* p, float y) { p->frequency += y; }\n");
  CHECK(plan.renamed == std::vector<std::string>{"setup", "step", "frequency"});
  CHECK(plan.frequencies.front().expression == "own_frequency(&tracker)");
  REQUIRE(plan.frequencies.size() == 2);
  CHECK(plan.frequencies[1].expression == "tracker.own_frequency");
}

TEST_CASE("what is not found is a name that does not compile") {
  const HarnessPlan plan = planned("static float a;\nvoid run(float y) { a += y; }\n");
  CHECK(plan.frequencies.front().expression == "PUT_FREQUENCY_HERE");
  CHECK(plan.frequencies.front().why_unit.find("rad/sample, of a") != std::string::npos);
}

TEST_CASE("a header is included that declares all, otherwise the file itself") {
  const test::ScratchFolder folder;
  std::ofstream(folder / "pll.h") << "typedef struct { float w; } pll_t;\nvoid run(pll_t* p, float y);\n";
  const std::string text = "#include \"pll.h\"\nvoid run(pll_t* p, float y) { p->w += y; }\n";
  const std::string file = (folder / "pll.c").string();
  std::ofstream(file) << text;
  const Declarations declarations = declarations_in(own_declarations(file, {}));
  const HarnessPlan plan = harness_plan(declarations, file, text, "");
  CHECK(headers_that_declare(plan, declarations, file) ==
        std::vector<std::string>{(folder / "pll.h").string()});

  const WrittenCode alone(kLoop);
  const Declarations own = alone.declarations();
  CHECK(headers_that_declare(harness_plan(own, alone.file(), kLoop, ""), own, alone.file()).empty());
}

}  // namespace veritrack::certificates::code
