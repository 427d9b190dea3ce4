#include "certificates/tuning/design_text.hpp"

#include <doctest/doctest.h>

namespace veritrack::certificates {
namespace {

constexpr const char* kText =
    "name = \"Ünusual\"\n"
    "[design]  # chosen\n"
    "q = 0.005                     # first\n"
    "r = 0.01\n"
    "process_noise = \"identity\" # of the paper\n"
    "\n"
    "[assume]\n"
    "q = 1\n";

TEST_CASE("values are replaced where they stand, and words around them stay") {
  const auto text = with_design_values(kText, {{"r", "2e-3"}, {"process_noise", "{ q1 = 1, q2 = 2 }"}});
  REQUIRE(text);
  CHECK(*text ==
        "name = \"Ünusual\"\n[design]  # chosen\nq = 0.005                     # first\nr = 2e-3\n"
        "process_noise = { q1 = 1, q2 = 2 } # of the paper\n\n[assume]\nq = 1\n");
}

TEST_CASE("a key that goes takes its line along, and one that is new comes below the others") {
  const auto text =
      with_design_values(kText, {{"q", std::nullopt}, {"epsilon", "0"}, {"lambda", std::nullopt}});
  REQUIRE(text);
  CHECK(*text ==
        "name = \"Ünusual\"\n[design]  # chosen\nr = 0.01\nprocess_noise = \"identity\" # of the paper\n"
        "epsilon = 0\n\n[assume]\nq = 1\n");
}

TEST_CASE("characters of several bytes before a value, a byte order mark, and no line feed at the end") {
  const auto text =
      with_design_values("\xEF\xBB\xBFname = \"a\"\n[design]\nq1 = 1 # π\nq2 = 2", {{"q2", "3"}, {"r", "4"}});
  REQUIRE(text);
  CHECK(*text == "\xEF\xBB\xBFname = \"a\"\n[design]\nq1 = 1 # π\nq2 = 3\nr = 4\n");
}

TEST_CASE("inline tables are not written into, where lines are not there to be replaced") {
  CHECK_FALSE(with_design_values("design = { q1 = 1, q2 = 2 }\n", {{"q1", "3"}}));
  CHECK_FALSE(with_design_values("name = \"a\"\n", {{"q1", "3"}}));
  CHECK_FALSE(with_design_values("design.q1 = 1\n", {{"q1", "3"}}));
}

TEST_CASE("parameters are replaced in one line or in a table of their own") {
  const std::string head = "\xEF\xBB\xBFname = 'π'\n[design]\nkp = 1\n";
  const auto inline_table = with_parameter_values(
      head + "[model]\nparameters = { kp = 2, dt = '1/8', ki = 3e-4 } # π\nangles = []\n",
      {{"ki", "5"}, {"kp", "0.25"}, {"dt", "0.1"}});
  REQUIRE(inline_table);
  CHECK(*inline_table == head + "[model]\nparameters = { kp = 0.25, dt = 0.1, ki = 5 } # π\nangles = []\n");
  const auto table =
      with_parameter_values(head + "[model.parameters]\nki = 3 # slow\nkp = 2\n", {{"ki", "5"}});
  REQUIRE(table);
  CHECK(*table == head + "[model.parameters]\nki = 5 # slow\nkp = 2\n");
  CHECK_FALSE(with_parameter_values(head, {{"kp", "1"}}));
  CHECK_FALSE(with_parameter_values(head + "[model]\nparameters = { kp = 2 }\n", {{"kq", "1"}}));
}

}  // namespace
}  // namespace veritrack::certificates
