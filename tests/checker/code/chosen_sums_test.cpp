// Angles to which a choice adds: which formulas are those of the listing, and which are not.
#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/checker/code/code_design.hpp"

namespace veritrack::checker {
namespace {

using test::CodeDesign;
using test::replaced;

/// if (!(y < 0.5)) theta += w + 0.125*y; else theta += w, wrapped.
CodeDesign chosen() {
  return {
      "veritrack listing 1\nsample r0 f32 y\nstate r1 f32:0x0p+0 theta\nstate r2 f32:0x1p-2 w\n"
      "r3 = fcmp.olt.f32 r0 f32:0x1p-1\n"
      "r4 = fadd.f32 r1 r2\n"
      "r5 = fmul.f32 r0 f32:0x1p-3\n"
      "r6 = fadd.f32 r4 r5\n"
      "r7 = select.f32 r3 r4 r6\n"
      "r8 = fcmp.ogt.f32 r7 " +
          test::kPi +
          "\n"
          "r9 = fadd.f32 r7 " +
          test::kMinusTurn +
          "\n"
          "r10 = select.f32 r8 r9 r7\n"
          "r11 = fcmp.olt.f32 r10 " +
          test::kMinusPi +
          "\n"
          "r12 = fadd.f32 r10 " +
          test::kTurn +
          "\n"
          "r13 = select.f32 r11 r12 r10\n"
          "r14 = sin.f32 r1\n"
          "next r1 r13\nnext r2 r14\nfrequency r2\n",
      {"y"},
      {"theta", "w"},
      {"theta"},
      "turn1 = stays_within(if(y < 0.5, w, w + y*0.125), -pi, pi)\n"
      "theta' = theta + if(y < 0.5, w, w + y*0.125)\n"
      "w' = sin(theta)\n",
      "w"};
}

}  // namespace

TEST_CASE("a step that is chosen is added to an angle, in any order and whichever way it is asked") {
  CHECK(chosen().objection() == "");
  const std::string step = "if(y < 0.5, w, w + y*0.125)";
  const auto with = [&](const std::string& limit, const std::string& next) {
    CodeDesign design = chosen();
    design.step = "turn1 = stays_within(" + limit + ", -pi, pi)\ntheta' = " + next + "\nw' = sin(theta)\n";
    return design.objection();
  };
  CHECK(with(step, "w + if(y < 0.5, 0, y*0.125) + theta") == "");
  CHECK(with(step, "theta - if(y < 0.5, -w, -w - y*0.125)") == "");
  CHECK(with("if(0.5 > y, 0, y*0.125) + w", "theta + " + step) == "");
  CHECK(with("if(y >= 0.5, w + y*0.125, w)", "theta + if(0.5 <= y, w + y*0.125, w)") == "");
  // The condition and its opposite.
  CodeDesign opposite = chosen();
  opposite.listing = replaced(opposite.listing, "fcmp.olt.f32 r0 f32:0x1p-1", "fcmp.oge.f32 r0 f32:0x1p-1");
  CHECK(opposite.objection() != "");
  opposite.listing = replaced(opposite.listing, "select.f32 r3 r4 r6", "select.f32 r3 r6 r4");
  CHECK(opposite.objection() == "");
}

TEST_CASE("another step, another condition or another limit is refused") {
  const std::vector<std::pair<std::string, std::string>> forgeries{
      {"theta + if(y < 0.5, w, w + y*0.125)", "theta + if(y < 0.5, w + y*0.125, w)"},
      {"theta + if(y < 0.5, w, w + y*0.125)", "theta + if(y > 0.5, w, w + y*0.125)"},
      {"theta + if(y < 0.5, w, w + y*0.125)", "theta + if(y <= 0.5, w, w + y*0.125)"},
      {"theta + if(y < 0.5, w, w + y*0.125)", "theta + if(w < 0.5, w, w + y*0.125)"},
      {"theta + if(y < 0.5, w, w + y*0.125)", "theta + if(y < 0.25, w, w + y*0.125)"},
      {"theta + if(y < 0.5, w, w + y*0.125)", "theta - if(y < 0.5, w, w + y*0.125)"},
      {"theta + if(y < 0.5, w, w + y*0.125)", "theta + if(y < 0.5, 0, w + y*0.125)"},
      {"theta + if(y < 0.5, w, w + y*0.125)", "theta + w + y*0.125"},
      {"stays_within(if(y < 0.5, w, w + y*0.125)", "stays_within(if(y < 0.5, w + y*0.125, w)"},
      {"stays_within(if(y < 0.5, w, w + y*0.125)", "stays_within(if(y < 0.5, 0, w + y*0.125)"},
      {"stays_within(if(y < 0.5, w, w + y*0.125)", "stays_within(w + y*0.125"},
      {"y*0.125), -pi, pi)", "y*0.125), -3.2, pi)"},
  };
  for (const auto& [from, to] : forgeries) {
    CAPTURE(to);
    CodeDesign design = chosen();
    design.step = replaced(design.step, from, to);
    CHECK(design.objection() != "");
  }
  // A branch that is no sum of the angle keeps it in no range that is known.
  CodeDesign reset = chosen();
  reset.listing = replaced(reset.listing, "select.f32 r3 r4 r6", "select.f32 r3 f32:0x0p+0 r6");
  CHECK(reset.objection() != "");
  CodeDesign twice = chosen();
  twice.listing = replaced(twice.listing, "r6 = fadd.f32 r4 r5", "r6 = fadd.f32 r4 r4");
  twice.step =
      "turn1 = stays_within(if(y < 0.5, w, w + w + theta), -pi, pi)\n"
      "theta' = theta + if(y < 0.5, w, w + w + theta)\nw' = sin(theta)\n";
  CHECK(twice.objection() != "");
}

}  // namespace veritrack::checker
