// Formulas of listings, against what one would write by hand.
#include "certificates/code/recursion.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "certificates/code/listing_text.hpp"

namespace veritrack::certificates::code {
namespace {

/// A listing with the sample y and the states theta and w, from the lines of its operations.
std::string listing_of(const std::string& lines) {
  return "veritrack listing 1\nfile 0 pll.c\nsample r0 f32 y\nstate r1 f32:0x0p+0 theta\nstate r2 f32:0x1p-2 "
         "w\n" +
         lines;
}

Recursion made(const std::string& lines) {
  return recursion_of(parse_listing(listing_of(lines)));
}

/// The next value of w for a loop whose angle is wrapped.
std::string next_w(const std::string& lines, const std::string& register_of_w) {
  const Recursion recursion = made(lines + "next r1 r1\nnext r2 " + register_of_w + "\nfrequency r2\n");
  const std::string begin = "w' = ";
  const std::size_t place = recursion.step.find(begin);
  return recursion.step.substr(place + begin.size(), recursion.step.find('\n', place) - place - begin.size());
}

std::string refusal(const std::string& lines) {
  try {
    (void)made(lines);
  } catch (const NoRecursion& error) {
    return error.what();
  }
  return "";
}

const std::string kWrapped =
    "r3 = fadd.f32 r1 r2 @0:4:7\n"
    "r4 = fcmp.ogt.f32 r3 f32:0x1.921fb6p+1\n"
    "r5 = fadd.f32 r3 f32:-0x1.921fb6p+2\n"
    "r6 = select.f32 r4 r5 r3\n"
    "r7 = fcmp.olt.f32 r6 f32:-0x1.921fb6p+1\n"
    "r8 = fadd.f32 r6 f32:0x1.921fb6p+2\n"
    "r9 = select.f32 r7 r8 r6\n";

}  // namespace

TEST_CASE(
    "a wrapped angle is the angle itself, with a limit to its step; constants are those of the format") {
  const Recursion recursion = made(kWrapped +
                                   "r10 = sin.f32 r9\n"
                                   "r11 = fmul.f32 r0 r10\n"
                                   "r12 = fmul.f32 r11 f32:0x1.99999ap-4\n"
                                   "r13 = fadd.f32 r2 r12\n"
                                   "next r1 r9\nnext r2 r13\nfrequency r2\n");
  CHECK(recursion.samples == std::vector<std::string>{"y"});
  CHECK(recursion.states == std::vector<std::string>{"theta", "w"});
  CHECK(recursion.angles == std::vector<std::string>{"theta"});
  CHECK(recursion.start == std::vector<std::string>{"0", "0.25"});
  CHECK(recursion.frequency == "w");
  CHECK(recursion.step ==
        "turn1 = stays_within(w, -pi, pi)\n"
        "r1 = theta + w\n"
        "theta' = r1\n"
        "w' = w + y*sin(r1)*0.100000001490116119384765625\n");
}

TEST_CASE("a wrap of one side has steps of one way") {
  const std::string down =
      "r3 = fadd.f32 r1 r2\nr4 = fcmp.ogt.f32 r3 f32:0x1.921fb6p+1\nr5 = fadd.f32 r3 f32:-0x1.921fb6p+2\n"
      "r6 = select.f32 r4 r5 r3\n";
  const std::string up =
      "r3 = fsub.f32 r1 r2\nr4 = fcmp.olt.f32 r3 f32:0x0p+0\nr5 = fadd.f32 r3 f32:0x1.921fb6p+2\n"
      "r6 = select.f32 r4 r5 r3\n";
  const std::string next = "next r1 r6\nnext r2 r2\nfrequency r2\n";
  CHECK(made(down + next).step.substr(0, 36) == "turn1 = stays_within(w, 0.001, pi)\nt");
  CHECK(made(up + next).step.substr(0, 40) == "turn1 = stays_within(-w, -pi, -0.001)\nth");
  const std::string never = down.substr(0, down.find("r6")) + "r6 = select.f32 r4 r3 r5\n";
  CHECK(refusal(never + next).find("the wraps do not keep theta in a range") == 0);
}

TEST_CASE("a rounded count of turns that is taken away is a wrap") {
  const std::string turn = "f32:0x1.921fb6p+2";
  const auto step_of = [&](const std::string& rounding) {
    return made("r3 = fadd.f32 r1 r2\nr4 = fdiv.f32 r3 " + turn + "\nr5 = " + rounding +
                ".f32 r4\nr6 = fmul.f32 r5 " + turn +
                "\nr7 = fsub.f32 r3 r6\nnext r1 r7\nnext r2 r2\nfrequency r2\n");
  };
  const std::string expected = "turn1 = stays_within(w, -pi, pi)\ntheta' = theta + w\n";
  for (const char* rounding : {"rint", "round", "floor", "ceil", "ftrunc"}) {
    CAPTURE(rounding);
    CHECK(step_of(rounding).step.substr(0, expected.size()) == expected);
  }
  CHECK(step_of("rint").ranges.at(1).high == doctest::Approx(3.1416).epsilon(1e-4));
  CHECK(step_of("floor").ranges.at(1).low == doctest::Approx(0.0).epsilon(1e-4));
  const Recursion left =
      made("r3 = fadd.f32 r1 r2\nr4 = fmod.f32 r3 " + turn + "\nnext r1 r4\nnext r2 r2\nfrequency r2\n");
  CHECK(left.step.substr(0, expected.size()) == expected);
  CHECK(left.ranges.at(1).low == doctest::Approx(-6.2832).epsilon(1e-4));
}

TEST_CASE("choices are what they are of real numbers") {
  const auto choice = [](const std::string& comparison, const std::string& yes, const std::string& no) {
    return next_w("r3 = fadd.f32 r2 r0\nr4 = fneg.f32 r3\nr5 = fcmp." + comparison + "\nr6 = select.f32 r5 " +
                      yes + " " + no + "\n",
                  "r6");
  };
  CHECK(choice("olt.f32 r3 r0", "r3", "r0") == "min(r1, y)");
  CHECK(choice("ogt.f32 r3 r0", "r3", "r0") == "max(y, r1)");
  CHECK(choice("uge.f32 r3 r0", "r0", "r3") == "min(r1, y)");
  CHECK(choice("olt.f32 r3 f32:0x0p+0", "r4", "r3") == "abs(r1)");
  CHECK(choice("ogt.f32 r3 f32:0x1p+0", "f32:0x1p+0", "r3") == "min(w + y, 1)");
  CHECK(choice("olt.f32 r3 f32:0x1p+0", "f32:0x1p+0", "r3") == "max(w + y, 1)");
  CHECK(choice("ogt.f32 r3 f32:0x1p+0", "f32:0x1p-1", "r3") == "if(1 < r1, 0.5, r1)");
  // A value that is no number is not certified.
  CHECK(choice("uno.f32 r3 r3", "r0", "r3") == "w + y");
  CHECK(choice("ord.f32 r3 r3", "r0", "r3") == "y");
}

TEST_CASE("limits on both sides are a clamp, however they are written") {
  const std::string sum = "r3 = fadd.f32 r2 r0\n";
  CHECK(next_w(sum + "r4 = fmin.f32 r3 f32:0x1p+0\nr5 = fmax.f32 f32:0x1p-2 r4\n", "r5") ==
        "clamp(w + y, 0.25, 1)");
  CHECK(next_w(sum + "r4 = fcmp.olt.f32 r3 f32:0x1p-2\nr5 = select.f32 r4 f32:0x1p-2 r3\n"
                     "r6 = fcmp.ogt.f32 r3 f32:0x1p+0\nr7 = select.f32 r6 f32:0x1p+0 r5\n",
               "r7") == "clamp(w + y, 0.25, 1)");
  // Limits that are not in order are no clamp.
  CHECK(next_w(sum + "r4 = fmin.f32 r3 f32:0x1p-2\nr5 = fmax.f32 f32:0x1p+0 r4\n", "r5") ==
        "max(1, min(w + y, 0.25))");
}

TEST_CASE(
    "a difference with an arc tangent, wrapped, is the arc tangent of the turned sample, away from half a "
    "turn") {
  const std::string text =
      "veritrack listing 1\nsample r0 f32 a\nsample r1 f32 b\nstate r2 f32:0x0p+0 p\nstate r3 f32:0x0p+0 v\n"
      "r4 = atan2.f32 r1 r0\nr5 = fsub.f32 r4 r2\n"
      "r6 = fcmp.ogt.f32 r5 f32:0x1.921fb6p+1\nr7 = fadd.f32 r5 f32:-0x1.921fb6p+2\nr8 = select.f32 r6 r7 "
      "r5\n"
      "r9 = fcmp.olt.f32 r8 f32:-0x1.921fb6p+1\nr10 = fadd.f32 r8 f32:0x1.921fb6p+2\nr11 = select.f32 r9 r10 "
      "r8\n"
      "r12 = fadd.f32 r2 r11\n"
      "r13 = fcmp.ogt.f32 r12 f32:0x1.921fb6p+1\nr14 = fadd.f32 r12 f32:-0x1.921fb6p+2\nr15 = select.f32 r13 "
      "r14 r12\n"
      "r16 = fcmp.olt.f32 r15 f32:-0x1.921fb6p+1\nr17 = fadd.f32 r15 f32:0x1.921fb6p+2\nr18 = select.f32 r16 "
      "r17 r15\n"
      "r19 = fadd.f32 r3 r11\n"
      "next r2 r18\nnext r3 r19\nfrequency r3\n";
  const Recursion recursion = recursion_of(parse_listing(text));
  CHECK(recursion.step ==
        "r1 = atan2(b*cos(p) - a*sin(p), a*cos(p) + b*sin(p))\n"
        "turn1 = stays_within(r1, -3.14, 3.14)\n"
        "p' = p + r1\n"
        "v' = v + r1\n");
  CHECK(recursion.ranges_keep_obligations);
  CHECK(recursion.ranges.size() == 1);
  CHECK(recursion.ranges.begin()->second.high < 3.1417);
}

TEST_CASE("a step that is chosen is added to its angle; an angle that is set is refused") {
  const auto lines = [](const std::string& branch) {
    std::string text =
        "r3 = fadd.f32 r1 r2\nr4 = fcmp.oge.f32 r0 f32:0x1p-1\nr5 = fadd.f32 r3 r0\n"
        "r6 = select.f32 r4 " +
        branch + " r5\n" +
        "r7 = fcmp.ogt.f32 r6 f32:0x1.921fb6p+1\n"
        "r8 = fadd.f32 r6 f32:-0x1.921fb6p+2\n"
        "r9 = select.f32 r7 r8 r6\n"
        "r10 = fcmp.olt.f32 r9 f32:-0x1.921fb6p+1\n"
        "r11 = fadd.f32 r9 f32:0x1.921fb6p+2\n"
        "r12 = select.f32 r10 r11 r9\n"
        "next r1 r12\nnext r2 r2\nfrequency r2\n";
    return text;
  };
  CHECK(made(lines("r3")).step ==
        "turn1 = stays_within(if(y < 0.5, w + y, w), -pi, pi)\n"
        "theta' = theta + if(y < 0.5, w + y, w)\n"
        "w' = w\n");
  CHECK(refusal(lines("f32:0x0p+0")).find("is not itself and a step") != std::string::npos);
  CHECK(refusal(lines("r2")).find("is not itself and a step") != std::string::npos);
}

TEST_CASE("the angle of a point less an angle and a step is wrapped, where a line limits the step") {
  const Recursion recursion = recursion_of(parse_listing(
      "veritrack listing 1\nsample r0 f32 a\nsample r1 f32 b\nstate r2 f32:0x0p+0 p\nstate r3 f32:0x0p+0 v\n"
      "r4 = atan2.f32 r1 r0\nr5 = fadd.f32 r2 r3\nr6 = fsub.f32 r4 r5\n"
      "r7 = fmul.f32 r6 f32:0x1.45f306p-3\nr8 = rint.f32 r7\nr9 = fmul.f32 r8 f32:0x1.921fb6p+2\n"
      "r10 = fsub.f32 r6 r9\n"
      "r11 = fmul.f32 r5 f32:0x1.45f306p-3\nr12 = rint.f32 r11\nr13 = fmul.f32 r12 f32:0x1.921fb6p+2\n"
      "r14 = fsub.f32 r5 r13\n"
      "r15 = fmul.f32 r10 f32:0x1p-3\n"
      "next r2 r14\nnext r3 r15\nfrequency r3\n"));
  CHECK(recursion.step.find("stays_within(-v, -pi, pi)") != std::string::npos);
  CHECK(recursion.step.find("atan2(b*cos(") != std::string::npos);
  CHECK(recursion.step.find("stays_within(v, -pi, pi)") != std::string::npos);
}

TEST_CASE("the angle of samples that are turned back is kept away from half a turn") {
  const auto step = [](const std::string& turn) {
    return recursion_of(parse_listing("veritrack listing 1\nsample r0 f32 a\nsample r1 f32 b\n"
                                      "state r2 f32:0x0p+0 p\nr3 = cos.f32 r2\nr4 = sin.f32 " +
                                      turn +
                                      "\n"
                                      "r5 = fmul.f32 r1 r3\nr6 = fmul.f32 r0 r4\nr7 = fsub.f32 r5 r6\n"
                                      "r8 = fmul.f32 r0 r3\nr9 = fmul.f32 r1 r4\nr10 = fadd.f32 r8 r9\n"
                                      "r11 = atan2.f32 r7 r10\nnext r2 r11\nfrequency r2\n"))
        .step;
  };
  CHECK(step("r2").find("stays_within(r3, -3.14, 3.14)") != std::string::npos);
  CHECK(step("r0").find("stays_within") == std::string::npos);  // by two angles: it is no turn
}

TEST_CASE("what is not understood is refused, and what is said names it") {
  // One-sided: a difference may be more than half a turn.
  CHECK(refusal("r3 = fsub.f32 r1 r2\n"
                "r4 = fcmp.ogt.f32 r3 f32:0x1.921fb6p+1\nr5 = fadd.f32 r3 f32:-0x1.921fb6p+2\nr6 = "
                "select.f32 r4 r5 r3\n"
                "r7 = fadd.f32 r2 r6\nnext r1 r1\nnext r2 r7\nfrequency r2\n")
            .find("difference of angles") != std::string::npos);
  CHECK(
      refusal(
          "r3 = sin.f32 r1\nr4 = fadd.f32 r1 r2\nr5 = fadd.f32 r2 r3\nnext r1 r4\nnext r2 r5\nfrequency r2\n")
          .find("theta grows for ever") != std::string::npos);
  CHECK(refusal("r3 = floor.f32 r2\nnext r1 r1\nnext r2 r3\nfrequency r2\n").find("floor has no rule") !=
        std::string::npos);
  CHECK(refusal("r3 = fcmp.oeq.f32 r2 r0\nr4 = select.f32 r3 r2 r0\nnext r1 r1\nnext r2 r4\nfrequency r2\n")
            .find("equal") != std::string::npos);
  CHECK(refusal("r3 = fcmp.ogt.f32 r2 r0\nr4 = fcmp.ogt.f32 r1 r0\nr5 = and.i1 r3 r4\nnext r1 r1\nnext r2 "
                "r2\nfrequency r2\n"
                "must-be-zero r5 @0:3:1 a loop has ended\n")
            .find("nothing shows that a loop has ended") != std::string::npos);
  // An angle that is set to 0 at a turn loses what it is beyond.
  CHECK(refusal(
            "r3 = fadd.f32 r1 r2\nr4 = fcmp.ogt.f32 r3 f32:0x1.921fb6p+2\nr5 = select.f32 r4 f32:0x0p+0 r3\n"
            "r6 = sin.f32 r1\nr7 = fadd.f32 r2 r6\nnext r1 r5\nnext r2 r7\nfrequency r2\n") == "");
}

TEST_CASE("an obligation is a limit of the step") {
  const Recursion recursion = made(
      "r3 = fcmp.ogt.f32 r2 f32:0x1p+0\nr4 = fadd.f32 r2 r0\nnext r1 r1\nnext r2 r4\nfrequency r2\n"
      "must-be-zero r3 @0:3:1 a loop has ended\n");
  CHECK(recursion.step.find("must1 = stays_within(w - 1, -1e30, 0)") != std::string::npos);
  CHECK_FALSE(recursion.ranges_keep_obligations);
}

}  // namespace veritrack::certificates::code
