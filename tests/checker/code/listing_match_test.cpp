// Which recursions are those of a listing, and forgeries that are not.
#include "checker/code/listing_match.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

#include "checker/code/wraps.hpp"
#include "tests/checker/code/code_design.hpp"

namespace veritrack::checker {
namespace {

using test::CodeDesign;
using test::function;
using test::replaced;

TEST_CASE("recursions of listings are verified") {
  CHECK(test::loop().objection() == "");
  CHECK(test::detector().objection() == "");
}

TEST_CASE("other texts of the same recursion are verified") {
  CodeDesign loop = test::loop();
  loop.step =
      "theta' = theta + (w - 0.0500000007450580596923828125*y*sin(theta))\n"
      "turn1 = stays_within(-y*0.0500000007450580596923828125*sin(theta) + w, -3.14, 3.14)\n"
      "w' = min(max(w - y*sin(theta)*0.0500000007450580596923828125, 0.0625), 1)\n";
  CHECK(loop.objection() == "");
  loop.step = replaced(loop.step, "w' = min(max(w - y*sin(theta)*0.0500000007450580596923828125, 0.0625), 1)",
                       "v = w - y*sin(theta)*0.0500000007450580596923828125\n"
                       "w' = if(v >= 1, 1, if(v <= 0.0625, 0.0625, v))");
  CHECK(loop.objection() == "");
  CodeDesign detector = test::detector();
  detector.step = replaced(detector.step, "atan2(b*cos(theta) - a*sin(theta), a*cos(theta) + b*sin(theta))",
                           "wrap(atan2(b, a) - theta)");
  CHECK(detector.objection() == "");
}

/// What is changed, and where: the step, the listing, or the design.
struct Forgery {
  const char* what;
  std::function<void(CodeDesign&)> change;
};
std::function<void(CodeDesign&)> in_listing(const std::string& from, const std::string& to) {
  return [=](CodeDesign& design) { design.listing = replaced(design.listing, from, to); };
}
std::function<void(CodeDesign&)> in_step(const std::string& from, const std::string& to) {
  return [=](CodeDesign& design) { design.step = replaced(design.step, from, to); };
}

void check_refused(const CodeDesign& honest, const std::vector<Forgery>& forgeries) {
  for (const Forgery& forgery : forgeries) {
    CAPTURE(forgery.what);
    CodeDesign design = honest;
    forgery.change(design);
    CHECK(design.objection() != "");
  }
}

TEST_CASE("forgeries of a loop are refused") {
  check_refused(
      test::loop(),
      {{"the last bit of a constant", in_listing("-0x1.99999ap-5", "-0x1.999998p-5")},
       {"the last digit of a constant", in_step("2382812", "2382813")},
       {"a rounded decimal", in_step("0.0500000007450580596923828125", "0.05")},
       {"the sign of a constant", in_step("(-0.05", "(0.05")},
       {"another operator", in_listing("r4 = fmul.f32", "r4 = fadd.f32")},
       {"another function", in_listing("sin.f32", "cos.f32")},
       {"a limit of the clamp", in_step("0.0625, 1)", "0.0625, 1.5)")},
       {"limits in the wrong order", in_step("0.0625, 1)", "1, 0.0625)")},
       {"no lower limit", in_step("clamp(w + e, 0.0625, 1)", "min(w + e, 1)")},
       {"max for min", in_step("clamp(w + e, 0.0625, 1)", "max(max(w + e, 0.0625), 1)")},
       {"no limit of the step of the angle", in_step("turn1 = stays_within(w + e, -pi, pi)\n", "")},
       {"a wider limit of the step", in_step("-pi, pi", "-4, 4")},
       {"a limit of something else", in_step("stays_within(w + e,", "stays_within(w - e,")},
       {"a limit with its ends swapped", in_step("-pi, pi", "pi, -pi")},
       {"a wrap that is off",
        in_listing("r12 = fadd.f32 r10 " + test::kTurn, "r12 = fadd.f32 r10 f32:0x1.922p+2")},
       {"a wrap by half a turn",
        in_listing("r12 = fadd.f32 r10 " + test::kTurn, "r12 = fadd.f32 r10 " + test::kPi)},
       {"a wrap of one side", in_listing("next r1 r13", "next r1 r10")},
       {"a wrap in the wrong direction",
        in_listing("r12 = fadd.f32 r10 " + test::kTurn, "r12 = fadd.f32 r10 " + test::kMinusTurn)},
       {"an angle that is not wrapped", in_listing("next r1 r13", "next r1 r7")},
       {"an angle reset to zero", in_listing("select.f32 r8 r9 r7", "select.f32 r8 f32:0x0p+0 r7")},
       {"an angle that is not declared", [](CodeDesign& design) { design.angles.clear(); }},
       {"a frequency declared as an angle",
        [](CodeDesign& design) {
          design.angles = {"theta", "w"};
        }},
       {"an angle that is no state",
        [](CodeDesign& design) {
          design.angles = {"theta", "y"};
        }},
       {"states in another order",
        [](CodeDesign& design) {
          design.states = {"w", "theta"};
        }},
       {"states with other names",
        [](CodeDesign& design) {
          design.states = {"theta", "v"};
          design.step =
              "e = y*sin(theta)*(-0.0500000007450580596923828125)\nturn1 = stays_within(v + e, -pi, pi)\n"
              "theta' = theta + v + e\nv' = clamp(v + e, 0.0625, 1)\n";
          design.frequency = "v";
        }},
       {"a state more",
        [](CodeDesign& design) {
          design.states.emplace_back("more");
          design.step += "more' = more\n";
        }},
       {"another sample",
        [](CodeDesign& design) {
          design.samples = {"z"};
          design.step = replaced(design.step, "y*", "z*");
        }},
       {"another frequency", [](CodeDesign& design) { design.frequency = "w + 0.001"; }},
       {"an angle as the frequency", [](CodeDesign& design) { design.frequency = "theta"; }},
       {"the angle as a number", in_listing("r6 = fadd.f32 r2 r5", "r6 = fadd.f32 r2 r1")},
       {"an obligation that nothing shows", in_listing("must-be-zero r19", "must-be-zero r8")},
       {"an obligation that is false", in_listing("must-be-zero r19", "must-be-zero i1:1")}});
}

TEST_CASE("a wrap of one side keeps an angle whose steps are limited to one way") {
  CHECK(test::loop().may_be_rounded());
  CodeDesign loop = test::loop();
  loop.listing = replaced(loop.listing, "next r1 r13", "next r1 r10");
  const auto with = [&](const std::string& limits) {
    CodeDesign design = loop;
    design.step = replaced(design.step, "-pi, pi", limits);
    return design;
  };
  CHECK(with("0.001, pi").objection() == "");
  CHECK(with("0.001, pi").may_be_rounded());
  // Steps that are smaller than what an angle is off may drift.
  CHECK(with("0.000001, pi").objection() == "");
  CHECK_FALSE(with("0.000001, pi").may_be_rounded());
  CHECK(with("-0.001, pi").objection() != "");
  CHECK(with("0.001, 4").objection() != "");
  CHECK(with("-pi, -0.001").objection() != "");
}

/// The loop whose angle is wrapped by a rounded count of turns.
CodeDesign counted_loop(const std::string& quotient, const std::string& rounding, const std::string& rest) {
  CodeDesign loop = test::loop();
  const std::size_t from = loop.listing.find("r8 = fcmp");
  const std::size_t to = loop.listing.find("r14 = fcmp");
  const std::size_t end = loop.listing.find("r18 = fcmp");
  const std::size_t next = loop.listing.find("next r1");
  std::string listing = loop.listing.substr(0, from) + "r8 = " + quotient + "\nr9 = " + rounding +
                        ".f32 r8\nr10 = fmul.f32 r9 " + test::kTurn + "\nr11 = " + rest + "\n";
  std::string others = loop.listing.substr(to, end - to) + loop.listing.substr(next);
  for (const auto& [old, fresh] :
       {std::pair("r14", "r12"), std::pair("r15", "r13"), std::pair("r16", "r14"), std::pair("r17", "r15")}) {
    for (std::size_t at = others.find(old); at != std::string::npos; at = others.find(old)) {
      others.replace(at, 3, std::string("#") + (fresh + 1));
    }
  }
  for (std::size_t at = others.find('#'); at != std::string::npos; at = others.find('#')) {
    others[at] = 'r';
  }
  listing += others;
  listing = replaced(listing, "next r1 r13", "next r1 r11");
  loop.listing = listing.substr(0, listing.find("must-be-zero"));
  return loop;
}

TEST_CASE("an angle is wrapped by taking a rounded count of turns away") {
  const std::string divided = "fdiv.f32 r7 " + test::kTurn;
  const std::string multiplied = "fmul.f32 r7 f32:0x1.45f306p-3";  // 1/(2 pi)
  const std::string rest = "fsub.f32 r7 r10";
  for (const char* rounding : {"rint", "round", "floor", "ceil", "ftrunc"}) {
    CAPTURE(rounding);
    CHECK(counted_loop(divided, rounding, rest).objection() == "");
    CHECK(counted_loop(multiplied, rounding, rest).may_be_rounded());
  }
  CHECK(counted_loop("fdiv.f32 r7 " + test::kPi, "rint", rest).objection() != "");
  CHECK(counted_loop("fmul.f32 r7 f32:0x1.45f3p-2", "rint", rest).objection() != "");
  CHECK(counted_loop("fdiv.f32 r6 " + test::kTurn, "rint", rest).objection() != "");
  CHECK(
      counted_loop(test::kTurn.substr(0, 0) + "fdiv.f32 " + test::kTurn + " r7", "rint", rest).objection() !=
      "");
  CHECK(counted_loop(divided, "rint", "fadd.f32 r7 r10").objection() != "");
  CHECK(counted_loop(divided, "rint", "fsub.f32 r6 r10").objection() != "");
  CHECK(counted_loop(divided, "sqrt", rest).objection() != "");
  CHECK(counted_loop(divided, "rint", "fmod.f32 r7 " + test::kTurn).objection() == "");
  CHECK(counted_loop(divided, "rint", "fmod.f32 r7 " + test::kPi).objection() != "");
}

TEST_CASE("a turn that is rounded on its way is none: what it is off would not be counted") {
  const auto last_is_wrapped = [](const std::string& lines, const char* last) {
    const CodeListing listing = read_listing("veritrack listing 1\nsample r0 f32 y\nstate r1 f32:0x0p+0 w\n" +
                                             lines + "next r1 r1\nfrequency r1\n");
    int place = -1;
    for (std::size_t i = 0; i < listing.operations.size(); ++i) {
      place = listing.operations[i].is(last) ? static_cast<int>(i) : place;
    }
    REQUIRE(place >= 0);
    return Wraps(listing).is_wrapped(place);
  };
  const std::string above = "r2 = fcmp.ogt.f32 r0 " + test::kPi + "\n";
  CHECK(last_is_wrapped(above + "r3 = fadd.f32 r0 " + test::kMinusTurn + "\nr4 = select.f32 r2 r3 r0\n",
                        "select"));
  CHECK_FALSE(last_is_wrapped(above + "r3 = fptrunc.f32 f64:-0x1.921fb54442d18p+2\nr4 = fadd.f32 r0 r3\n"
                                      "r5 = select.f32 r2 r4 r0\n",
                              "select"));
  const std::string product =
      "r2 = fdiv.f32 r0 " + test::kTurn + "\nr3 = rint.f32 r2\nr4 = fmul.f32 r3 " + test::kTurn + "\n";
  CHECK(last_is_wrapped(product + "r5 = fsub.f32 r0 r4\n", "fsub"));
  CHECK_FALSE(
      last_is_wrapped(product + "r5 = fpext.f64 r4\nr6 = fpext.f64 r0\nr7 = fsub.f64 r6 r5\n", "fsub"));
}

TEST_CASE("forgeries of a difference of angles are refused") {
  check_refused(
      test::detector(),
      {{"its operands swapped", in_listing("fsub.f32 r4 r2", "fsub.f32 r2 r4")},
       {"the arc tangent's operands swapped", in_listing("atan2.f32 r1 r0", "atan2.f32 r0 r1")},
       {"the channels swapped", in_step("b*cos(theta) - a*sin(theta)", "a*cos(theta) - b*sin(theta)")},
       {"the other direction", in_step("b*cos(theta) - a*sin", "b*cos(theta) + a*sin")},
       {"a wrap of one side, as a number",
        in_listing("r11 = select.f32 r9 r10 r8", "r11 = select.f32 r9 r8 r8")},
       {"a wrap at another place, as a number",
        in_listing("r9 = fcmp.olt.f32 r8 " + test::kMinusPi, "r9 = fcmp.olt.f32 r8 f32:-0x1.8p+1")},
       {"no wrap of a number",
        in_step("atan2(b*cos(theta) - a*sin(theta), a*cos(theta) + b*sin(theta))", "atan2(b, a) - theta")},
       {"samples swapped",
        [](CodeDesign& design) {
          design.samples = {"b", "a"};
        }},
       {"the subtraction turned round", in_listing("fsub.f32 r3 r21", "fsub.f32 r21 r3")},
       {"the branch for what is no number", in_listing("fcmp.uno.f32", "fcmp.ord.f32")}});
}

/// Two channels: the angle of the samples, turned back by that of the loop.
CodeDesign turned_back() {
  return {
      "veritrack listing 1\nsample r0 f32 a\nsample r1 f32 b\nstate r2 f32:0x0p+0 w\n"
      "r3 = cos.f32 r2\nr4 = sin.f32 r2\n"
      "r5 = fmul.f32 r1 r3\nr6 = fmul.f32 r0 r4\nr7 = fsub.f32 r5 r6\n"
      "r8 = fmul.f32 r0 r3\nr9 = fmul.f32 r1 r4\nr10 = fadd.f32 r8 r9\n"
      "r11 = atan2.f32 r7 r10\nnext r2 r11\nfrequency r2\n",
      {"a", "b"},
      {"w"},
      {},
      "e = atan2(b*cos(w) - a*sin(w), a*cos(w) + b*sin(w))\n"
      "turn1 = stays_within(e, -3.14, 3.14)\n"
      "w' = e\n",
      "w"};
}

TEST_CASE("the angle of samples that are turned back is known where a limit keeps it from half a turn") {
  const auto is_known = [](const std::string& from, const std::string& to) {
    CodeDesign design = turned_back();
    design.step = replaced(design.step, from, to);
    Objections objections;
    const auto code = check_code(read_json(design.json().dump()), objections);
    REQUIRE(objections.empty());
    REQUIRE(code.angles);
    return code.angles->arcs.contains(static_cast<int>(code.listing.operations.size()) - 1);
  };
  CHECK(is_known("3.14, 3.14", "3.14, 3.14"));
  CHECK(is_known("-3.14, 3.14", "-1, 3.14"));
  CHECK_FALSE(is_known("-3.14, 3.14", "-3.14, 3.141"));
  CHECK_FALSE(is_known("-3.14, 3.14", "-3.15, 3.14"));
  CHECK_FALSE(is_known("stays_within(e, ", "stays_within(w, "));
  CHECK_FALSE(is_known("turn1 = stays_within(e, -3.14, 3.14)\n", ""));
}

struct Function {
  const char* operations;
  const char* result;
  const char* formula;
};

TEST_CASE("choices that are the same functions") {
  for (const Function& each : std::vector<Function>{
           {"r2 = fmin.f64 r0 r1\n", "r2", "min(x, y)"},
           {"r2 = fcmp.olt.f64 r0 r1\nr3 = select.f64 r2 r0 r1\n", "r3", "min(y, x)"},
           {"r2 = fcmp.uge.f64 r0 r1\nr3 = select.f64 r2 r0 r1\n", "r3", "max(x, y)"},
           {"r2 = fcmp.olt.f64 r0 f64:0x0p+0\nr3 = fneg.f64 r0\nr4 = select.f64 r2 r3 r0\n", "r4", "abs(y)"},
           {"r2 = fcmp.ole.f64 r0 f64:0x0p+0\nr3 = fneg.f64 r0\nr4 = select.f64 r2 r3 r0\n", "r4", "abs(y)"},
           {"r2 = fabs.f64 r0\n", "r2", "abs(y)"},
           {"r2 = fcmp.ole.f64 r0 r1\nr3 = select.f64 r2 f64:0x1p+0 f64:0x1p+1\n", "r3", "if(y <= x, 1, 2)"},
           {"r2 = fcmp.ole.f64 r0 r1\nr3 = select.f64 r2 f64:0x1p+0 f64:0x1p+1\n", "r3", "if(x < y, 2, 1)"},
           {"r2 = fcmp.olt.f64 r0 r1\nr3 = fcmp.ogt.f64 r0 f64:0x1p+0\nr4 = and.i1 r2 r3\n"
            "r5 = select.f64 r4 r0 f64:0x0p+0\n",
            "r5", "if(1 < y, if(y < x, y, 0), 0)"},
           {"r2 = fcmp.olt.f64 r0 r1\nr3 = xor.i1 r2 i1:1\nr4 = select.f64 r3 r0 f64:0x0p+0\n", "r4",
            "if(y < x, 0, y)"},
           {"r2 = fma.f64 r0 r1 f64:-0x1p+0\n", "r2", "y*x + (-1)"},
           {"r2 = fmul.f64 r0 r0\nr3 = fmul.f64 r0 r2\nr4 = fdiv.f64 r3 r1\n", "r4", "y^3/x"},
           {"r2 = fptrunc.f32 r0\nr3 = fpext.f64 r2\nr4 = exp.f64 r3\nr5 = hypot.f64 r4 r1\n", "r5",
            "hypot(exp(y), x)"},
           {"r2 = fdiv.f64 r0 r1\nr3 = fcmp.uno.f64 r2 r2\nr4 = select.f64 r3 r1 r2\n", "r4", "y/x"}}) {
    CAPTURE(each.operations);
    CAPTURE(each.formula);
    CHECK(function(each.operations, each.result, each.formula).objection() == "");
  }
}

TEST_CASE("choices that are other functions") {
  for (const Function& each : std::vector<Function>{
           {"r2 = fmin.f64 r0 r1\n", "r2", "max(x, y)"},
           {"r2 = fcmp.olt.f64 r0 r1\nr3 = select.f64 r2 r1 r0\n", "r3", "min(y, x)"},
           // Strict or not, at a jump.
           {"r2 = fcmp.ole.f64 r0 r1\nr3 = select.f64 r2 f64:0x1p+0 f64:0x1p+1\n", "r3", "if(y < x, 1, 2)"},
           {"r2 = fcmp.olt.f64 r0 r1\nr3 = select.f64 r2 f64:0x1p+0 f64:0x1p+1\n", "r3", "if(y <= x, 1, 2)"},
           {"r2 = fcmp.olt.f64 r0 r1\nr3 = select.f64 r2 f64:0x1p+0 f64:0x1p+1\n", "r3", "if(x <= y, 1, 2)"},
           {"r2 = fcmp.olt.f64 r0 r1\nr3 = fcmp.ogt.f64 r0 f64:0x1p+0\nr4 = or.i1 r2 r3\n"
            "r5 = select.f64 r4 r0 f64:0x0p+0\n",
            "r5", "if(1 < y, if(y < x, y, 0), 0)"},
           {"r2 = fcmp.oeq.f64 r0 r1\nr3 = select.f64 r2 f64:0x1p+0 r0\n", "r3", "y"},
           {"r2 = fcmp.olt.f64 r0 f64:0x1p+0\nr3 = select.f64 r2 f64:0x1p+0 r0\n", "r3",
            "max(y, 1.0000000000000001)"},
           {"r2 = fsub.f64 r0 r1\n", "r2", "x - y"},
           {"r2 = fdiv.f64 r0 r1\n", "r2", "x/y"},
           {"r2 = fmul.f64 r0 r0\n", "r2", "y^3"},
           {"r2 = fma.f64 r0 r1 f64:-0x1p+0\n", "r2", "y*x + 1"},
           {"r2 = fadd.f64 r0 f64:-0x1p+0\n", "r2", "y - wrap(-1)"},
           {"r2 = fadd.f64 r0 f64:-0x1p+0\n", "r2", "y + 1"},
           {"r2 = fsub.f64 r0 f64:0x1p+0\n", "r2", "y + 1"},
           {"r2 = fmul.f64 r0 r1\nr3 = fsub.f64 r0 r2\n", "r3", "y + x*y"},
           {"r2 = fmul.f64 r0 r1\nr3 = fsub.f64 r0 r2\n", "r3", "y - (-x)*y"},
           {"r2 = floor.f64 r0\n", "r2", "y"},
           {"r2 = fmul.f64 r0 f64:bits7ff8000000000000\n", "r2", "y"},
           {"r2 = fptosi.i32 r0\nr3 = sitofp.f64 r2\n", "r3", "y"},
           // A value that is tested, but may be no number.
           {"r2 = sqrt.f64 r0\nr3 = fcmp.uno.f64 r2 r2\nr4 = select.f64 r3 r1 r0\n", "r4", "y"},
           {"r2 = fdiv.f64 r0 r1\nr3 = fcmp.ord.f64 r2 r2\nr4 = select.f64 r3 r0 r1\n", "r4", "y"},
           {"r2 = log.f64 r0\nr3 = fcmp.olt.f64 r2 r1\nr4 = select.f64 r3 r0 r0\n", "r4", "y"}}) {
    CAPTURE(each.operations);
    CAPTURE(each.formula);
    CHECK(function(each.operations, each.result, each.formula).objection() != "");
  }
}

TEST_CASE("obligations are shown by limits among the formulas") {
  const auto design = [](const std::string& comparison, const std::string& limit) {
    CodeDesign result =
        function("r2 = fsub.f64 r0 f64:0x1p+0\nr3 = fcmp." + comparison + "\n", "r2", "y - 1");
    result.listing += "must-be-zero r3 a divisor is not 0\n";
    result.step += limit;
    return result.objection();
  };
  CHECK(design("oeq.f64 r2 f64:0x0p+0", "must1 = stays_within(y - 1, 0, 100)\n") == "");
  CHECK(design("olt.f64 r2 r1", "must1 = stays_within(y - 1 - x, 0, 100)\n") == "");
  CHECK(design("oge.f64 r2 r1", "must1 = stays_within(x - (y - 1), 0, 100)\n") == "");
  CHECK(design("ogt.f64 r2 f64:0x1p+2", "must1 = stays_within(y - 1, -100, 3)\n") == "");
  CHECK(design("oeq.f64 r2 f64:0x0p+0", "") != "");
  CHECK(design("oeq.f64 r2 f64:0x0p+0", "must1 = stays_within(y - 1, -1, 100)\n") != "");
  CHECK(design("oeq.f64 r2 f64:0x0p+0", "must1 = stays_within(y - 1, -1e-400, 100)\n") != "");
  CHECK(design("oeq.f64 r2 f64:0x0p+0", "must1 = stays_within(y, 0, 100)\n") != "");
  CHECK(design("olt.f64 r2 r1", "must1 = stays_within(x - (y - 1), 0, 100)\n") != "");
  CHECK(design("olt.f64 r2 r1", "must1 = max(stays_within(y - 1 - x, 0, 100), 0)\n") != "");
  CHECK(design("one.f64 r2 f64:0x0p+0", "must1 = stays_within(y - 1, 0, 100)\n") != "");
}

TEST_CASE("what is nested without end is answered") {
  std::string operations;
  std::string last = "r0";
  for (int i = 2; i < 5000; ++i) {
    operations += "r" + std::to_string(i) + " = fmul.f64 " + last + " " + last + "\n";
    last = "r" + std::to_string(i);
  }
  CHECK(function(operations, last, "y").objection() != "");
  std::string sines;
  for (int i = 2; i < 5000; ++i) {
    sines += "r" + std::to_string(i) + " = exp.f64 r" + (i == 2 ? "0" : std::to_string(i - 1)) + "\n";
  }
  std::string formula = "y";
  for (int i = 2; i < 5000; ++i) {
    formula.insert(0, "exp(").append(")");
  }
  CHECK(function(sines, "r4999", formula).objection() != "");
}

}  // namespace
}  // namespace veritrack::checker
