#include "certificates/model/operation_words.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "tests/certificates/model/model_certificates.hpp"

namespace veritrack::certificates {
namespace {

/// The loop with some text in place of another one.
std::string loop_with(const std::string& old, const std::string& text) {
  std::string design = test::kLoopText;
  REQUIRE(design.find(old) != std::string::npos);
  return design.replace(design.find(old), old.size(), text);
}

std::string refusal_of(const std::string& text) {
  try {
    (void)read_design(text, "loop.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_CASE("what depends on whole turns of an angle is refused where it stands") {
  CHECK(refusal_of(test::kLoopText) == "no error");
  const std::string half = refusal_of(loop_with("sin(theta + w)", "sin(0.5*theta + w)"));
  CHECK_MESSAGE(contains(half, "loop.toml:12:"), half);
  CHECK_MESSAGE(contains(half, "theta' depends on a part of a turn of an angle, in 0.5*theta"), half);
  CHECK(refusal_of(loop_with("sin(theta + w)", "sin(2*theta + w)")) == "no error");
  const std::string faster = refusal_of(loop_with("theta' = theta", "theta' = 2*theta"));
  CHECK_MESSAGE(contains(faster, "loop.toml:14:"), faster);
  CHECK_MESSAGE(contains(faster, "theta' does not turn once when the angle turns once"), faster);
  const std::string frequency = refusal_of(loop_with("frequency = 'w'", "frequency = 'w + theta'"));
  CHECK_MESSAGE(contains(frequency, "loop.toml:16:"), frequency);
  CHECK_MESSAGE(contains(frequency, "the frequency is not the same after a whole turn"), frequency);
}

TEST_CASE("a wrap of the next value of an angle is as if it were not there, or the message shows it") {
  const std::string next = "theta' = theta + w + kp*e";
  const std::string wrapped = loop_with(next, "theta' = wrap(theta + w + kp*e)");
  CHECK(refusal_of(wrapped) == "no error");
  const auto instructions = [](const std::string& text) {
    const Design design = read_design(text, "loop.toml");
    const ModelTables& tables = model_tables(design);
    return make_model(tables.model, tables.assume.signal).step.program.instructions();
  };
  {
    const rigor::UpwardRounding upward;
    CHECK(instructions(wrapped) == instructions(test::kLoopText));
  }
  const std::string used =
      refusal_of(loop_with(next, "theta' = wrap(theta + w + kp*e)\nguard = stays_within(theta' - w, -9, 9)"));
  CHECK_MESSAGE(contains(used, "turns once, in wrap(theta + w + kp*e); allowed:"), used);
  CHECK_MESSAGE(contains(used, "allowed where no line uses theta'"), used);
  const std::string by_if = refusal_of(
      loop_with(next, "t = theta + w + kp*e\ntheta' = if(t > pi, t - 2*pi, if(t < -pi, t + 2*pi, t))"));
  CHECK_MESSAGE(contains(by_if, "; leave the wrap out: theta is an angle, known modulo 2*pi"), by_if);
}

TEST_CASE("an angle in turns is refused with what helps") {
  const std::string turns = refusal_of(loop_with("sin(theta + w)", "sin(2*pi*theta + w)"));
  CHECK_MESSAGE(contains(turns, "depends on a part of a turn of an angle, in 2*pi*theta; allowed:"), turns);
  CHECK_MESSAGE(
      contains(turns, "; an angle is in rad: for a state in turns use a state that is 2*pi times it"), turns);
  CHECK_FALSE(contains(refusal_of(loop_with("sin(theta + w)", "sin(0.5*theta + w)")), "in turns"));
}

TEST_CASE("a signal that is not known to have the period of the phase is refused") {
  const auto with_signal = [](const std::string& signal) {
    return refusal_of(loop_with("noise = 0.02", "noise = 0.02\nsignal = '" + signal + "'"));
  };
  CHECK(with_signal("A*cos(3*phi)") == "no error");
  for (const char* signal : {"A*cos(1.5*phi)", "A*(2*cos(0.5*phi)^2 - 1)", "A*phi"}) {
    const std::string found = with_signal(signal);
    CHECK_MESSAGE(contains(found, "loop.toml:24:"), found);
    CHECK_MESSAGE(contains(found, "the signal is not known to have the period 2 pi in phi"), found);
  }
}

TEST_CASE("units are those of states, and do not contradict their use") {
  const std::string unknown = refusal_of(loop_with("w = 'rad/sample' }", "ww = 'rad/sample' }"));
  CHECK_MESSAGE(contains(unknown, "loop.toml:10:"), unknown);
  CHECK_MESSAGE(contains(unknown, "ww is no state; nearest: w"), unknown);
  const std::string hertz = refusal_of(loop_with("w = 'rad/sample' }", "w = 'Hz' }"));
  CHECK_MESSAGE(contains(hertz, "w is in Hz, and frequency = 'w' has to be in rad/sample"), hertz);
  const std::string degrees = refusal_of(loop_with("theta = 'rad'", "theta = 'deg'"));
  CHECK_MESSAGE(contains(degrees, "the angle theta is in deg"), degrees);
  CHECK(refusal_of(loop_with("w = 'rad/sample' }", "w = 'radians per sample' }")) == "no error");
}

TEST_CASE("every operation that may be undefined has words with its formula and line") {
  const rigor::UpwardRounding upward;
  const Design design = read_design(loop_with("e      = -2*y*sin(theta + w)\n",
                                              "d = y - 2\ne = -2*stays_within(y, -3, 3)*sin(theta + w)/d + "
                                              "0*sqrt(w)*log(4 + y)*acos(y/2) + 0*sign(y)*if(y > w, 1, 0)\n"),
                                    "loop.toml");
  const ModelTables& tables = model_tables(design);
  const Model model = make_model(tables.model, tables.assume.signal);
  const std::vector<std::string> words = objections_to_operations(model);
  CHECK(words.size() == model.step.program.instructions().size());
  const auto has = [&](const std::string& text) {
    return std::find(words.begin(), words.end(), text) != words.end();
  };
  CHECK(has("the denominator d (line 13) may vanish"));
  CHECK(has("y (line 13) may leave the limits of stays_within, -3 and 3"));
  CHECK(has("y (line 13), at whose 0 sign jumps, may change its sign"));
  CHECK(has("y - w (line 13), at whose 0 a condition jumps, may change its sign"));
  CHECK(has("what the root is taken of, w (line 13), may be 0 or less"));
  CHECK(has("what the logarithm is taken of, 4 + y (line 13), may be 0 or less"));
  CHECK(has("the argument of acos, y/2 (line 13), may reach 1 or -1"));

  const Design wrapped = read_design(loop_with("-2*y*sin(theta + w)", "-2*wrap(y)*sin(theta + w)"), "l.toml");
  const std::vector<std::string> of_wrap =
      objections_to_operations(make_model(model_tables(wrapped).model, model_tables(wrapped).assume.signal));
  CHECK(std::find(of_wrap.begin(), of_wrap.end(),
                  "wrap(y) (line 12) may reach its jump, where what it wraps is half a turn") !=
        of_wrap.end());
}

TEST_CASE("a clamp is shown with its limits and its line") {
  const rigor::UpwardRounding upward;
  const Design design = read_design(
      loop_with("e      = -2*y*sin(theta + w)\n", "e = clamp(-2*y*sin(theta + w), -0.3, kp)\n"), "loop.toml");
  const ModelTables& tables = model_tables(design);
  const Model model = make_model(tables.model, tables.assume.signal);
  const std::vector<std::string> clamps = clamps_of(model);
  REQUIRE(clamps.size() == 1);
  CHECK_MESSAGE(std::regex_match(
                    clamps[0], std::regex(R"(clamp\(-2\*y\*sin\(.*\), -0\.3, kp = 0\.[0-9]+\) \(line 12\))")),
                clamps[0]);
}

}  // namespace
}  // namespace veritrack::certificates
