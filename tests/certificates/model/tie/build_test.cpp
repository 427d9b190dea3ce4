// Programs that are built, and what is said of those that are not.
#include "certificates/model/tie/build.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "tests/certificates/model/tie/tie_support.hpp"

namespace veritrack::certificates::tie {

namespace {

std::string refusal(const OneFile& file, const std::string& build, const std::string& emulator = "",
                    const std::map<std::string, std::string>& expressions = {}) {
  Sources sources = file.sources();
  sources.expressions = expressions;
  try {
    const BuiltProgram program(sources, build, emulator);
    (void)compared(file.listing(), program, some_steps(file.listing(), 10).steps);
  } catch (const BuildError& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  CAPTURE(text);
  CHECK(text.find(part) != std::string::npos);
  return text.find(part) != std::string::npos;
}

constexpr const char* kHidden = R"(static float* at(void) { static float w = 0.3f; return &w; }
void setup(void) { *at() = 0.25f; }
void step(float y) { *at() += 0.1f * y; }
float frequency(void) { return *at(); }
)";

}  // namespace

TEST_CASE("a command that does not build is refused with its first error, and without names of our folders") {
  const OneFile file(kLoop);
  CHECK(contains(refusal(file, "gcc -O2 -DORDER=nothing"), "undeclared (first use in this function)"));
  CHECK(refusal(file, "gcc -O2 -DORDER=nothing").find("veritrack-tie-") == std::string::npos);
  CHECK(contains(refusal(file, "no-such-compiler -O2"), "no-such-compiler cannot be run"));
  CHECK(contains(refusal(file, "  "), "--build is empty"));
  CHECK(contains(refusal(file, "gcc -O2 -lno-such-library"), "no-such-library"));
}

TEST_CASE("a program that ends early, or not in this machine, is refused") {
  const OneFile file(
      "#include <stdlib.h>\nstatic float w;\nvoid setup(void) { w = 0.3f; }\nvoid step(float y) {\n#ifdef "
      "END\n  "
      "END;\n#endif\n  w += 0.1f * y; }\nfloat frequency(void) { return w; }\n");
  CHECK(refusal(file, "gcc -O2") == "");
  CHECK(contains(refusal(file, "gcc -O2 -DEND=exit(0)"), "has answered 0 of 10 requests"));
  CHECK(contains(refusal(file, "gcc -O2 -DEND=abort()"), "was ended by signal 6"));
  CHECK(contains(refusal(file, "gcc -O2", "no-such-emulator -kernel"), "cannot be run by no-such-emulator"));
}

TEST_CASE("a state inside of a function needs an expression, and an expression a variable of its type") {
  const OneFile file(kHidden);
  REQUIRE(file.listing().states.size() == 1);
  const std::string name = file.listing().states[0].name;
  CHECK(contains(refusal(file, "gcc -O2"), "--state " + name + "=EXPRESSION"));
  CHECK(refusal(file, "gcc -O2", "", {{name, "*at()"}}) == "");
  CHECK(
      contains(refusal(file, "gcc -O2", "", {{name, "*(unsigned char*)at()"}}), "does not keep the number"));
}

TEST_CASE("an emulator is a program that runs another; files stand at {} of a command") {
  const OneFile file(kLoop);
  CHECK(refusal(file, "gcc -O2", "/usr/bin/env -u NOTHING") == "");
  CHECK(refusal(file, "gcc -O2 {} -lm") == "");
}

TEST_CASE("flags of the design name folders from its own") {
  code::CodeTable table;
  table.files = {{"src/a.c", {1, 1}}};
  table.flags = {{"-Iinclude", {1, 1}}, {"-I/usr/include", {1, 1}}, {"-DX=1", {1, 1}}};
  const trackers::code::Listing listing;
  const Sources sources = sources_of(table, listing, "/somewhere/design.toml");
  CHECK(sources.files == std::vector<std::filesystem::path>{"/somewhere/src/a.c"});
  CHECK(sources.flags == std::vector<std::string>{"-I/somewhere/include", "-I/usr/include", "-DX=1"});
}

TEST_CASE("states may be members of a class, flags and enumerations") {
  const OneFile file(R"(#include <cmath>
enum class Mode { low, high };
class Loop {
 public:
  void run(float y) {
    w_ += 0.1f * y * (is_fast_ ? 2.0f : 1.0f) * (mode_ == Mode::high ? 0.5f : 1.0f);
    is_fast_ = w_ > 0.5f;
    mode_ = w_ > 0.7f ? Mode::high : Mode::low;
  }
  float w() const { return w_; }
 private:
  float w_ = 0.3f;
  bool is_fast_ = false;
  Mode mode_ = Mode::low;
};
static Loop loop;
void setup() {}
void step(float y) { loop.run(y); }
float frequency() { return loop.w(); }
)",
                     "loop.cpp", {"-std=c++17"});
  CHECK(file.listing().states.size() == 3);
  const BuiltProgram program(file.sources(), "g++ -O2", "");
  const BuildResult result = compared(file.listing(), program, some_steps(file.listing()).steps);
  CHECK(result.is_equal());
  CHECK(result.compared == 1000);
}

}  // namespace veritrack::certificates::tie
