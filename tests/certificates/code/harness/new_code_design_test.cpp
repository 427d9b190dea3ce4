#include <doctest/doctest.h>

#include "certificates/code/harness/new_code.hpp"

namespace veritrack::certificates::code {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a band is around the frequency after setup, in the unit of the program") {
  NewCode code;
  code.source = "pll.c";
  code.step = "run (pll.c:3)";
  code.files = {"pll-harness.c"};
  code.harness = "pll-harness.c";
  CHECK(contains(new_code_design(code, 0.3), "frequency = [0.294, 0.306] # lowest and highest, rad/sample"));
  CHECK(contains(new_code_design(code, 0.0), "frequency = [0.2, 0.3]"));
  code.samples = 2;
  CHECK(contains(new_code_design(code, 0.0), "frequency = [0.01, 0.5]"));
  CHECK(contains(new_code_design(code, 0.0), "# source = "));
  code.sample_rate = 10000;
  code.guessed = "kp, ki";
  const std::string text = new_code_design(code, 0.0);
  CHECK(contains(text, "sample_rate = 10000 # Hz, as the file says\n"));
  CHECK(contains(text, "frequency = { hz = [15.92, 795.8] }"));
  CHECK(contains(text, "source = \"kp, ki: guesses of veritrack new, in pll-harness.c\""));
  CHECK(contains(text, "files = ['pll-harness.c']\n"));
}

}  // namespace veritrack::certificates::code
