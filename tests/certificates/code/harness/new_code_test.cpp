#include "certificates/code/harness/new_code.hpp"

#include <doctest/doctest.h>

#include "certificates/design/input_error.hpp"
#include "tests/certificates/code/harness/declared.hpp"

namespace veritrack::certificates::code {

TEST_CASE("a harness lies beside the design, and names the file from there") {
  const WrittenCode code(kLoop);
  const std::filesystem::path folder = std::filesystem::path(code.file()).parent_path();
  const NewCode made = new_code({code.file(), "", {}, folder / "designs" / "my loop.toml"});
  CHECK(made.harness == folder / "designs" / "my-loop-harness.c");
  CHECK(made.files == std::vector<std::string>{"my-loop-harness.c"});
  CHECK(made.harness_text.find("#include \"../loop.c\"") != std::string::npos);
  CHECK(made.step == "pll_run (loop.c:4)");
  CHECK(made.samples == 2);
  CHECK(made.sample_rate == 10000.0);
  CHECK(made.is_guessed_rate);
  CHECK(made.guessed == "kp, dt");
}

TEST_CASE("a file with setup, step and frequency is its own harness") {
  const WrittenCode code(
      "static float w;\nvoid setup(void) { w = 0.3f; }\nvoid step(float y) { w += y; }\n"
      "float frequency(void) { return w; }\n");
  const std::filesystem::path design = std::filesystem::path(code.file()).replace_extension(".toml");
  const NewCode made = new_code({code.file(), "", {}, design});
  CHECK(made.harness_text.empty());
  CHECK(made.files == std::vector<std::string>{"loop.c"});
  CHECK(made.samples == 1);
  CHECK(made.sample_rate == 0.0);
  CHECK_FALSE(new_code({code.file(), "step", {}, design}).harness_text.empty());
}

TEST_CASE("a later standard of C++ is found, and flags are checked") {
  const WrittenCode code(
      "namespace a::b { static float w; void run(float y) { if (float z = y; z > 0) w += z; } }\n"
      "inline constexpr float k = 1;\n[[maybe_unused]] static auto [p, q] = (float[2]){1, 2};\n"
      "#if __cplusplus < 201703L\n#error old\n#endif\n",
      "loop.cpp");
  const std::filesystem::path design = std::filesystem::path(code.file()).replace_extension(".toml");
  CHECK(new_code({code.file(), "", {}, design}).flags == std::vector<std::string>{"-std=c++17"});
  CHECK_THROWS_AS((void)new_code({code.file(), "", {"-std=c++14"}, design}), InputError);
  CHECK_THROWS_AS((void)new_code({code.file(), "", {"-ffast-math"}, design}), InputError);
  CHECK_THROWS_AS((void)new_code({"no-such-file.c", "", {}, design}), InputError);
}

}  // namespace veritrack::certificates::code
