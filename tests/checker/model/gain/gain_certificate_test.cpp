// Certificates by gains: what is true is verified, in these words, and nothing that was changed for the
// better is.
#include <doctest/doctest.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "checker/model/gain/gain_evidence.hpp"
#include "checker/verification.hpp"
#include "tests/checker/model/gain/gain_certificates.hpp"
#include "tests/checker/model/gain/gain_loops.hpp"

namespace veritrack::checker {
namespace {

using test::claim;
using test::decimal;
using test::Json;

Json motor_certificate() {
  Json certificate;
  certificate["schema"] = kFormat;
  certificate["design_sha256"] = std::string(64, '0');
  certificate["design"] = {{"name", "a loop"}, {"tracker", "model"}, {"source", ""}};
  certificate["design"]["model"] = test::motor_loop().model();
  certificate["design"]["assume"] = {{"amplitude", decimal("1")},
                                     {"sample_rate", decimal("12500")},
                                     {"frequency", {decimal("20"), decimal("1000")}},
                                     {"frequency_in_hertz", true},
                                     {"noise", decimal("0.02")},
                                     {"slew", decimal("0")},
                                     {"slew_in_hertz_per_second", false},
                                     {"start_within", Json::array({{{"name", "phase"}, {"formula", "0.1"}},
                                                                   {{"name", "speed"}, {"formula", "10"}}})}};
  certificate["design"]["require"] = {{"frequency_error_below", decimal("0.002")},
                                      {"settles_within", decimal("8000")},
                                      {"settled_below", decimal("0.0001")},
                                      {"largest_noise_at_least", decimal("0.9")},
                                      {"largest_slew_at_least", decimal("1e-5")},
                                      {"frequency_error_radius_at_least", decimal("0.01")},
                                      {"bias_below", decimal("1e-12")},
                                      {"ripple_below", decimal("1e-12")}};
  certificate["derivations"] = Json::array();
  certificate["gains"] = {
      {"steady_state",
       Json::array({{{"turns", 1}, {"constant", "0x0p+0"}, {"per_frequency", "0x1p+0"}},
                    {{"turns", 0}, {"constant", "0x0p+0"}, {"per_frequency", "0x1.86ap+13"}}})},
      {"horizon", 16384},
      {"blocks", 64}};
  certificate["claims"] = Json::array(
      {claim("model/guarantee", false,
             {{"frequency_error", "0.0015"}, {"settled_frequency_error", "0.00005"}}),
       claim("model/limits", false,
             {{"noise", "0.99"},
              {"frequency_error", "0.01"},
              {"reach", "0.01"},
              {"reach_frequency_error", "0.05"}}),
       claim("model/slew-limit", false, {{"slew", "1e-5"}, {"noise", "0.1"}, {"frequency_error", "0.05"}}),
       claim("model/steady-state", false,
             {{"bias_low", "-1e-14"}, {"bias_high", "1e-14"}, {"ripple", "1e-14"}}),
       claim("model/frequency-error-bound", true, Json::object()),
       claim("model/settling-time", true, Json::object()),
       claim("model/largest-noise", true, {{"frequency_error", "0.01"}}),
       claim("model/largest-slew", true, {{"frequency_error", "0.05"}}),
       claim("model/frequency-error-radius", true, {{"frequency_error", "0.05"}}),
       claim("model/bias", true, Json::object()), claim("model/ripple", true, Json::object())});
  certificate["verdict"] = "proved";
  return certificate;
}

Verification verify_json(const Json& certificate) {
  return verify(read_json(certificate.dump()));
}

bool refuses(const std::function<void(Json&)>& change) {
  Json certificate = motor_certificate();
  change(certificate);
  try {
    return !verify_json(certificate).verified();
  } catch (const std::exception&) {
    return true;
  }
}

TEST_CASE("a loop of a motor controller is verified by gains, in these words") {
  const Verification found = verify_json(motor_certificate());
  for (const Part& part : found.parts) {
    CAPTURE(part.name);
    for (const std::string& objection : part.objections) {
      CAPTURE(objection);
      CHECK(part.objections.empty());
    }
  }
  CHECK(found.verified());
  CHECK(found.requirements_proved);
  const std::string tone =
      "In exact arithmetic, on a tone of amplitude 1 with any constant frequency in [20, 1000] Hz at 12500 "
      "samples per second";
  REQUIRE(found.sentences.size() == 11);
  CHECK(found.sentences[0].text ==
        tone +
            ", with noise below 0.02, started within {phase: 0.1, speed: 10} of the steady state of the "
            "certificate, the other states in it, the frequency error stays at or below 0.0015 rad/sample "
            "(2.99 Hz) for ever, and at or below 0.00005 rad/sample (0.0995 Hz) in the long run.");
  CHECK(found.sentences[1].text ==
        tone +
            ", the tracker tolerates noise up to 0.99: a certified invariant set exists in which the "
            "frequency error stays at or below 0.01 rad/sample (19.9 Hz), and without noise a certified "
            "invariant set in which it stays at or below 0.05 rad/sample (99.5 Hz) contains frequency errors "
            "up to 0.01 rad/sample (19.8 Hz) at every phase.");
  CHECK(found.sentences[3].text.find(
            ", without noise, started in the steady state of the certificate, the mean "
            "over the phase of the frequency error in the long run is between") != std::string::npos);
  Json anywhere = motor_certificate();
  anywhere["design"]["assume"].erase("start_within");
  CHECK(verify_json(anywhere).sentences[0].text.find(", started in the steady state of the certificate, the "
                                                     "frequency error") != std::string::npos);
}

TEST_CASE("nothing that was changed for the better is verified") {
  CHECK_FALSE(refuses([](Json&) {}));
  const auto changes_claim = [](std::size_t index, const std::string& name, const std::string& value) {
    return refuses([&](Json& c) { c["claims"][index][name] = value; });
  };
  CHECK(changes_claim(0, "frequency_error", "0.0007"));
  CHECK(changes_claim(0, "settled_frequency_error", "0.000046"));
  CHECK(changes_claim(1, "noise", "0.99999"));
  CHECK(changes_claim(1, "noise", "1"));
  CHECK(changes_claim(1, "noise", "-0.1"));
  CHECK(changes_claim(1, "frequency_error", "0.002"));
  CHECK(changes_claim(1, "frequency_error", "3.2"));  // another lock
  CHECK(changes_claim(1, "reach", "3.1"));
  CHECK(changes_claim(1, "reach", "0.06"));
  CHECK(changes_claim(2, "slew", "0.01"));
  CHECK(changes_claim(2, "noise", "0.9999"));
  CHECK(changes_claim(3, "bias_low", "1e-12"));
  CHECK(changes_claim(3, "ripple", "1e-18"));
  CHECK(changes_claim(0, "from", "30"));
  for (const char* key : {"frequency_error_below", "settled_below", "bias_below", "ripple_below"}) {
    CAPTURE(key);
    CHECK(refuses([&](Json& c) { c["design"]["require"][key] = decimal("1e-18"); }));
  }
  CHECK(refuses([](Json& c) { c["design"]["require"]["settles_within"] = decimal("100"); }));
  CHECK(refuses([](Json& c) { c["design"]["require"]["largest_noise_at_least"] = decimal("0.99999"); }));
  CHECK(refuses([](Json& c) { c["design"]["require"]["largest_slew_at_least"] = decimal("0.01"); }));
  CHECK(refuses([](Json& c) { c["design"]["require"]["frequency_error_radius_at_least"] = decimal("1"); }));
}

TEST_CASE("evidence or a design that is not what it should be is refused") {
  const auto changes = [](const std::string& name, const Json& value) {
    return refuses([&](Json& c) { c["gains"][name] = value; });
  };
  CHECK(changes("horizon", 64));
  CHECK(changes("horizon", 16385));
  CHECK(changes("horizon", 1L << 40U));
  CHECK(changes("horizon", -64));
  CHECK(changes("blocks", 0));
  CHECK(changes("blocks", -1));
  CHECK(changes("blocks", 512));
  CHECK(changes("steady_state", Json::array()));
  CHECK(changes("other", 1));
  CHECK(changes("one_noise", 1));
  // Noise of 0.99 of the amplitude is near the end of the series of the angle that it adds.
  CHECK(changes("one_noise", true));
  CHECK_FALSE(changes("one_noise", false));
  const auto changes_state = [](std::size_t index, const std::string& name, const Json& value) {
    return refuses([&](Json& c) { c["gains"]["steady_state"][index][name] = value; });
  };
  CHECK(changes_state(0, "turns", 0));
  CHECK(changes_state(0, "turns", -1));
  CHECK(changes_state(1, "turns", 1));
  CHECK(changes_state(0, "constant", "0x1p-1"));
  CHECK(changes_state(0, "constant", "0.5"));
  CHECK(changes_state(0, "per_frequency", "0x1p-1"));
  CHECK(changes_state(1, "per_frequency", "0x1.84p+13"));
  CHECK(refuses([](Json& c) { c["gains"]["steady_state"].push_back(c["gains"]["steady_state"][1]); }));
  CHECK(refuses([](Json& c) { c["tubes"] = Json::array(); }));
  CHECK(refuses([](Json& c) { c["design"]["model"]["signal"][1] = "A*sin(phi) + 0.1"; }));
  CHECK(refuses([](Json& c) { c["design"]["assume"]["noise"] = {{"snr_db", decimal("20")}}; }));
  CHECK(refuses([](Json& c) { c["design"]["assume"]["frequency"][0] = decimal("-7000"); }));
  CHECK(refuses([](Json& c) { c["design"]["model"]["angles"] = Json::array(); }));
  CHECK(refuses([](Json& c) { c["design"]["model"]["parameters"][2]["formula"] = "2.1*12500"; }));
}

TEST_CASE("with rounding each state has a room above 0, and an angle none") {
  Json certificate = motor_certificate();
  const Tree tree = read_json(certificate.dump());
  const Tree& model = tree.at("design").at("model");
  Objections of_design;
  ModelRecursion recursion(model);
  const ModelDesign design = read_model_design(tree.at("design"), recursion, of_design, true);
  REQUIRE(of_design.empty());
  const RoundingOfStep rounding = [](const std::vector<Ball>&, const Ball&) {
    return std::optional(std::vector<Ball>{Ball(1e-7), Ball(1e-3), Ball(1e-9)});
  };
  const auto objections_with = [&](const Json& room, const RoundingOfStep& of_program) {
    Json gains = certificate["gains"];
    gains["rounding"] = room;
    Objections objections;
    const auto found = read_gains(read_json(gains.dump()), model, recursion, design, of_program, objections);
    CHECK((found != nullptr) == objections.empty());
    return objections;
  };
  const Json room{"0x0p+0", "0x1p+10"};
  CHECK(objections_with(room, rounding).empty());
  CHECK_FALSE(objections_with(room, {}).empty());
  CHECK_FALSE(objections_with({"0x0p+0"}, rounding).empty());
  const Objections no_room{"the room of a state is a number above 0, and that of an angle 0"};
  CHECK(objections_with({"0x1p-1", "0x1p+10"}, rounding) == no_room);
  CHECK(objections_with({"0x0p+0", "0x0p+0"}, rounding) == no_room);
  CHECK(objections_with({"0x0p+0", "-0x1p+10"}, rounding) == no_room);
}

TEST_CASE("a signal that turns backwards is one like any other") {
  Json certificate = motor_certificate();
  certificate["design"]["assume"]["frequency"] = {decimal("-1000"), decimal("1000")};
  CHECK(verify_json(certificate).verified());
}

}  // namespace
}  // namespace veritrack::checker
