#include "certificates/model/model_tuning.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <string>

#include "certificates/design/request_error.hpp"
#include "certificates/model/model_design.hpp"
#include "tests/certificates/model/model_certificates.hpp"

namespace veritrack::certificates {
namespace {

std::string loop_text(const std::string& assume, const std::string& require = "") {
  return test::two_channel_text("kp = 0.06, ki = 0.001, half = '1/2'",
                                assume + (require.empty() ? "" : "[require]\n" + require));
}

TuningResult tuned(const std::string& text, const std::string& objective, std::vector<FreeParameter> over,
                   int designs = 12) {
  TuningRequest request;
  request.design_text = text;
  request.objective = objective;
  request.over = std::move(over);
  request.most_designs = designs;
  return tune_model(test::loop_design(text), request);
}

double parameter_of(const TuningResult& result, const std::string& name) {
  const Design design = test::loop_design(result.design_text.value());
  for (const NamedText& each : model_tables(design).model.parameters) {
    if (each.name.text == name) {
      return std::stod(each.formula.text);
    }
  }
  return NAN;
}

}  // namespace

TEST_CASE("the bound in the long run is least with the least gain, and the words of the file stay") {
  const std::string text = loop_text("noise = 0.01\n");
  const TuningResult result = tuned(text, "", {{"ki", 1e-4, 3e-3}});
  REQUIRE(result.design_text);
  CHECK(parameter_of(result, "ki") == doctest::Approx(1e-4));
  CHECK(parameter_of(result, "kp") == 0.06);
  CHECK(result.design_text->find("half = '1/2' }") != std::string::npos);
  REQUIRE(result.notes.size() == 1);
  CHECK(result.notes[0].starts_with(
      "ki = 0.001 -> 0.0001: the certified bound on the frequency error in the long run goes from "));
  CHECK(result.changes.empty());
}

TEST_CASE("requirements come first") {
  // z^2 - (2 - kp) z + 1 - kp + ki: the slowest mode decays like (1 - kp + ki)^(k/2), or is real and slower.
  const std::string text = loop_text("noise = 0.01\n", "settles_like = 34\n");
  const TuningResult result = tuned(text, "long-run", {{"kp", 0.03, 0.3}, {"ki", 1e-4, 3e-3}}, 40);
  REQUIRE(result.design_text);
  CHECK(result.changes.empty());
  const double kp = parameter_of(result, "kp");
  const double ki = parameter_of(result, "ki");
  const double root = (2.0 - kp) * (2.0 - kp) - 4.0 * (1.0 - kp + ki);
  const double largest = root < 0.0 ? std::sqrt(1.0 - kp + ki) : 0.5 * (2.0 - kp + std::sqrt(root));
  CHECK(-1.0 / std::log(largest) < 34.0);
  const TuningResult impossible =
      tuned(loop_text("noise = 0.01\n", "settles_like = 1\n"), "long-run", {{"ki", 1e-4, 3e-3}}, 5);
  REQUIRE(impossible.changes.size() == 1);
  CHECK(impossible.changes[0].starts_with("Not proved: "));
}

TEST_CASE("each objective is certified, whether it is required or not" * doctest::test_suite("nightly")) {
  for (const char* objective : {"long-run", "for-ever", "radius", "noise"}) {
    CAPTURE(objective);
    const TuningResult result =
        tuned(loop_text("noise = 0.01\n"), objective, {{"kp", 0.05, 0.1}, {"ki", 5e-4, 2e-3}}, 6);
    REQUIRE(result.notes.size() == 1);
    CHECK(result.notes[0].find("nothing certified") == std::string::npos);
  }
  const TuningResult slew = tuned(loop_text("noise = 0\nslew = 1e-6\n"), "slew", {{"ki", 5e-4, 2e-3}}, 6);
  REQUIRE(slew.notes.size() == 1);
  CHECK(slew.notes[0].find("rad/sample per sample.") != std::string::npos);
  CHECK(tuned(loop_text("noise = 0\n"), "", {{"ki", 5e-4, 2e-3}}, 2)
            .notes[0]
            .find("the noise that is tolerated") != std::string::npos);
}

TEST_CASE("what cannot be asked is refused with the place in the file") {
  const auto key_of = [](const std::string& text, const FreeParameter& over) {
    try {
      (void)tuned(text, "", {over}, 1);
    } catch (const RequestError& error) {
      return error.key();
    }
    return std::string("nothing");
  };
  CHECK(key_of(loop_text("noise = 0.01\n"), {"kq", 1.0, 2.0}) == "model.parameters");
  CHECK(key_of(loop_text("noise = 0.01\n"), {"pi", 1.0, 4.0}) == "model.parameters");
  CHECK(key_of(loop_text("noise = 0.01\n"), {"kp", 1.0, 2.0}) == "model.parameters");
  CHECK_THROWS_AS((void)tuned(loop_text("noise = 0.01\n"), "", {{"kp", 0.01, 0.1}, {"kp", 0.02, 0.2}}, 1),
                  RequestError);
  CHECK(key_of(loop_text("noise = { snr_db = 20 }\nsamples = 100\n"), {"kp", 0.01, 2.0}) == "assume.noise");
}

TEST_CASE("words of a parameter that may change") {
  const auto found = free_parameter("kp=-1e-3:2.5");
  REQUIRE(found);
  CHECK(found->name == "kp");
  CHECK(found->low == -1e-3);
  CHECK(found->high == 2.5);
  for (const char* words : {"kp", "kp=", "kp=1", "kp=1:", "kp=:1", "kp=2:1", "kp=1:1", "=1:2", "kp=1:nan",
                            "kp=1:2:3", "kp=1:inf", "kp:1=2"}) {
    CAPTURE(words);
    CHECK_FALSE(free_parameter(words));
  }
}

}  // namespace veritrack::certificates
