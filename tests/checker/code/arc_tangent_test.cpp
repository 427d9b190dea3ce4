// An arc tangent that the listing computes by itself: what is claimed of it, and forgeries of that.
#include "checker/code/arc_tangent.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "checker/code/code_certificate.hpp"
#include "tests/checker/code/code_design.hpp"

namespace veritrack::checker {
namespace {

using test::CodeDesign;
using test::kMinusPi;
using test::kMinusTurn;
using test::kPi;
using test::kTurn;
using test::replaced;

/// A first-order loop; r21 is within 0.0102 rad of the angle of a and b.
CodeDesign loop() {
  const std::string operations =
      "veritrack listing 1\n"
      "sample r0 f32 a\n"
      "sample r1 f32 b\n"
      "state r2 f32:0x1.99999ap-3 w\n"
      "state r3 f32:0x0p+0 theta\n"
      "r4 = fabs.f32 r1\n"
      "r5 = fadd.f32 r4 f32:0x1.79ca1p-67\n"
      "r6 = fcmp.olt.f32 r0 f32:0x0p+0\n"
      "r7 = fadd.f32 r5 r0\n"
      "r8 = fsub.f32 r5 r0\n"
      "r9 = fdiv.f32 r7 r8\n"
      "r10 = fsub.f32 r0 r5\n"
      "r11 = fdiv.f32 r10 r7\n"
      "r12 = select.f32 r6 f32:0x1.2d97c8p+1 f32:0x1.921fb6p-1\n"
      "r13 = select.f32 r6 r9 r11\n"
      "r14 = fmul.f32 r13 f32:0x1.9205bcp-3\n"
      "r15 = fmul.f32 r13 r14\n"
      "r16 = fadd.f32 r15 f32:-0x1.f6a162p-1\n"
      "r17 = fmul.f32 r13 r16\n"
      "r18 = fadd.f32 r12 r17\n"
      "r19 = fcmp.olt.f32 r1 f32:0x0p+0\n"
      "r20 = fneg.f32 r18\n"
      "r21 = select.f32 r19 r20 r18\n"
      "r22 = fsub.f32 r21 r3\n";
  const auto wrapped = [](const std::string& x, int first) {
    const auto r = [&](int i) { return "r" + std::to_string(first + i); };
    return r(0) + " = fcmp.ogt.f32 " + x + " " + kPi + "\n" + r(1) + " = fadd.f32 " + x + " " + kMinusTurn +
           "\n" + r(2) + " = select.f32 " + r(0) + " " + r(1) + " " + x + "\n" + r(3) + " = fcmp.olt.f32 " +
           r(2) + " " + kMinusPi + "\n" + r(4) + " = fadd.f32 " + r(2) + " " + kTurn + "\n" + r(5) +
           " = select.f32 " + r(3) + " " + r(4) + " " + r(2) + "\n";
  };
  return {operations + wrapped("r22", 23) +
              "r29 = fmul.f32 r28 f32:0x1p-3\n"
              "r30 = fadd.f32 r3 r29\n" +
              wrapped("r30", 31) +
              "next r2 r2\n"
              "next r3 r36\n"
              "frequency r2\n",
          {"a", "b"},
          {"w", "theta"},
          {"theta"},
          "e = atan2(b*cos(theta) - a*sin(theta), a*cos(theta) + b*sin(theta))\n"
          "limit = stays_within(e, -3.14, 3.14)\n"
          "turn = stays_within(e*0.125, -pi, pi)\n"
          "theta' = theta + e*0.125\n"
          "w' = w\n",
          "w"};
}

struct Claim {
  std::string name = "r21", error = "0.0103", largest = "3.1417";
};

Objections objections_to(const CodeDesign& design, const Claim& claim) {
  nlohmann::json json = design.json();
  json["code"]["arc_tangent"] = {
      {"register", claim.name}, {"error", claim.error}, {"largest", claim.largest}};
  Objections objections;
  (void)check_code(read_json(json.dump()), objections);
  return objections;
}

std::string first_of(const Objections& objections) {
  return objections.empty() ? "" : objections.front();
}

}  // namespace

TEST_CASE("what is claimed of an arc tangent is verified") {
  CHECK(first_of(objections_to(loop(), {})) == "");
  CHECK(first_of(objections_to(loop(), {.error = "0.05", .largest = "3.3"})) == "");
}

TEST_CASE("forged arc tangents are refused") {
  const std::string far = "the register is not as near the arc tangent as listed";
  const std::string other = "the arc tangent is no register that all else knows two samples by";
  CHECK(first_of(objections_to(loop(), {.error = "0.0101"})) == far);
  CHECK(first_of(objections_to(loop(), {.largest = "3.1415"})) == far);
  CHECK(first_of(objections_to(loop(), {.name = "r20"})) == other);
  CHECK(first_of(objections_to(loop(), {.name = "r22"})) == other);
  CHECK(first_of(objections_to(loop(), {.name = "r28"})) == other);
  CHECK(first_of(objections_to(loop(), {.name = "r99"})) == other);
  CHECK(first_of(objections_to(loop(), {.name = "21"})) == other);
  CHECK(first_of(objections_to(loop(), {.error = "0"})).find("between 0 and 1") != std::string::npos);
  CHECK(first_of(objections_to(loop(), {.error = "7", .largest = "3.2"})).find("between 0 and 1") !=
        std::string::npos);
  CHECK(first_of(objections_to(loop(), {.largest = "7"})).find("below 4") != std::string::npos);
  const auto changed = [&](const std::string& from, const std::string& to) {
    CodeDesign design = loop();
    design.listing = replaced(design.listing, from, to);
    return first_of(objections_to(design, {}));
  };
  CHECK(changed("f32:0x1.9205bcp-3", "f32:0x1.b205bcp-3") == far);
  CHECK(changed("r6 = fcmp.olt", "r6 = fcmp.ogt") == far);
  CHECK(changed("r20 = fneg.f32 r18", "r20 = fabs.f32 r18") == far);
  CHECK(changed("r21 = select.f32 r19 r20 r18", "r21 = select.f32 r19 r18 r20") == far);
  CHECK(changed("f32:0x1.79ca1p-67", "f32:0x1p-30") == far);  // beside small samples
  CHECK(changed("r17 = fmul.f32 r13 r16", "r17 = tanh.f32 r13") == far);
  CodeDesign of_doubles = loop();
  for (std::size_t at = 0; (at = of_doubles.listing.find("f32", at)) != std::string::npos;) {
    of_doubles.listing.replace(at, 3, "f64");
  }
  CHECK(first_of(objections_to(of_doubles, {})) == other);
  CHECK(changed("r29 = fmul.f32 r28 f32:0x1p-3", "r29 = fmul.f32 r28 r4") == other);
  CHECK(changed("next r2 r2", "next r2 r4") == other);
}

TEST_CASE("an arc tangent of its own is an angle and no number") {
  CodeDesign design = loop();
  design.listing = replaced(design.listing, "r29 = fmul.f32 r28 f32:0x1p-3", "r29 = fmul.f32 r21 f32:0x1p-3");
  design.step = replaced(design.step, "theta' = theta + e*0.125", "theta' = theta + atan2(b, a)*0.125");
  CHECK(first_of(objections_to(design, {})) != "");
  // Without the claim, what the listing computes is no angle that a rule knows.
  CHECK(loop().objection() != "");
}

}  // namespace veritrack::checker
