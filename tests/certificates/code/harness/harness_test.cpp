#include "certificates/code/harness/harness.hpp"

#include <doctest/doctest.h>

#include "certificates/code/harness/harness_plan.hpp"
#include "tests/certificates/code/harness/declared.hpp"

namespace veritrack::certificates::code {
namespace {

std::string harness_of(const std::string& text, const char* name = "loop.c") {
  const WrittenCode code(text, name);
  const Declarations declarations = code.declarations();
  HarnessPlan plan = harness_plan(declarations, code.file(), text, "");
  plan.includes = {name};
  plan.source = name;
  plan.is_cpp = std::string(name).ends_with(".cpp");
  plan.sample_rate = plan.time ? 10000.0 : 0.0;
  return harness_text(plan, declarations);
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a harness calls the functions of the file, and says what is a guess and from which line") {
  const std::string text = harness_of(kLoop);
  CHECK(has(text, "#include \"loop.c\"\n\nstatic pll_t tracker;\n\nvoid setup(void) {\n"));
  CHECK(
      has(text, "// Guessed: pll_init (loop.c:3) prepares the loop, from its name; no other is possible.\n"));
  CHECK(has(text, "// Guessed: kp = 1600.0f, dt = 1.0f / 10000.0f. The file has no values"));
  CHECK(has(text, "  pll_init(&tracker, 1600.0f, 1.0f / 10000.0f);\n}\n"));
  CHECK(has(text, "void step(float a, float b) {\n  // Guessed: pll_run (loop.c:4) takes a sample"));
  CHECK(has(text, "  pll_run(&tracker, a, b);\n}\n"));
  CHECK(has(text, "  return tracker.speed * tracker.dt;  // rad/sample\n}\n"));
}

TEST_CASE("angles are those of two samples, outputs have variables, and a time is that of the design") {
  const std::string text = harness_of(
      "#include <math.h>\nvoid run(double phase, double dt, double* theta, double* speed) {\n"
      "  const double e = remainder(phase - *theta, 6.283185307179586);\n"
      "  *theta += (*speed + e) * dt;\n  *speed += e * dt;\n}\n");
  CHECK(has(text, "static double out_theta;\nstatic double out_speed;\n"));
  CHECK(has(text, "void step(double in_phase, double quadrature) {\n"));
  CHECK(has(text, "  run(atan2(quadrature, in_phase), 1.0 / 10000.0, &out_theta, &out_speed);\n"));
  CHECK(has(text, "  return out_speed / 10000.0;  // rad/sample\n"));
}

TEST_CASE("a class is made with guesses for its constructor; what the step returns is kept") {
  const std::string text = harness_of(
      "class Loop {\n public:\n  explicit Loop(float kp) : kp_(kp) {}\n  void reset() { a_ = 0; }\n"
      "  float update(float y) { a_ += kp_ * y; return a_; }\n private:\n  float kp_, a_ = 0;\n};\n",
      "loop.cpp");
  CHECK(has(text, "static Loop tracker(0.16f);\nstatic float result_of_step;\n"));
  CHECK(has(text, "void setup() {\n"));
  CHECK(has(text, "  tracker.reset();\n"));
  CHECK(has(text, "  result_of_step = tracker.update(y);\n"));
  CHECK(has(text, "  return result_of_step;  // rad/sample\n"));
}

TEST_CASE("other functions are named with their lines, and names of the file that collide are changed") {
  const std::string text =
      harness_of("static float w;\nvoid step(float y) { w += y; }\nvoid other(float y) { w -= y; }\n");
  CHECK(has(text, "#define step own_step\n#include \"loop.c\"\n#undef step\n"));
  CHECK(has(text, "others: other (loop.c:3); --function NAME chooses."));
  CHECK(has(text, "  own_step(y);\n"));
  CHECK(at_line({"/some/folder/loop.c", 7, 1}) == "loop.c:7");
}

}  // namespace veritrack::certificates::code
