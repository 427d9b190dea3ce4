#include "certificates/code/harness/members.hpp"

#include <doctest/doctest.h>

#include "tests/certificates/code/harness/declared.hpp"

namespace veritrack::certificates::code {

TEST_CASE("members are found through structures and pointers, with the constants that the file gives") {
  const WrittenCode code(
      "typedef struct { float kp, dt; } conf_t;\nstatic const conf_t conf = {2.0f, 0.001f};\nstatic double "
      "g;\n"
      "typedef struct { const conf_t* conf; struct { float w; } state; float level; int n; } loop_t;\n"
      "void init(loop_t* l) { l->level = 0.5f; }\n");
  const Declarations declarations = code.declarations();
  const std::vector<Member> members = members_of(declarations, "loop", "loop_t", code.file());
  REQUIRE(members.size() == 7);
  CHECK(members[0].expression == "loop.conf->kp");
  CHECK(members[1].expression == "loop.conf->dt");
  CHECK(members[1].value == doctest::Approx(0.001));
  CHECK(members[1].depth == 2);
  CHECK(members[2].expression == "loop.state.w");
  CHECK_FALSE(members[2].value);
  CHECK(members[3].expression == "loop.level");
  CHECK(members[3].value == 0.5);
  CHECK(members[4].expression == "conf.kp");
  CHECK(members[6].expression == "g");
}

}  // namespace veritrack::certificates::code
