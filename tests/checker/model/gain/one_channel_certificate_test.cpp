// Certificates by gains for a loop of one channel, and forged ones.
#include <doctest/doctest.h>

#include <functional>
#include <string>

#include "checker/verification.hpp"
#include "tests/checker/model/gain/gain_certificates.hpp"

namespace veritrack::checker {
namespace {

using test::claim;
using test::decimal;
using test::Json;

Json type_2_certificate() {
  Json certificate;
  certificate["schema"] = kFormat;
  certificate["design_sha256"] = std::string(64, '0');
  certificate["design"] = {{"name", "a loop"}, {"tracker", "model"}, {"source", ""}};
  certificate["design"]["model"] = test::type_2_loop("0.001").model();
  certificate["design"]["assume"] = {{"amplitude", decimal("1")},
                                     {"frequency", {decimal("0.2"), decimal("0.5")}},
                                     {"frequency_in_hertz", false},
                                     {"noise", decimal("0.05")},
                                     {"slew", decimal("0")},
                                     {"slew_in_hertz_per_second", false},
                                     {"start_within", Json::array({{{"name", "theta"}, {"formula", "0.1"}},
                                                                   {{"name", "w"}, {"formula", "0.0001"}}})}};
  certificate["design"]["require"] = {{"frequency_error_below", decimal("0.0005")},
                                      {"settles_within", decimal("20000")},
                                      {"settled_below", decimal("0.00015")},
                                      {"largest_noise_at_least", decimal("0.25")},
                                      {"frequency_error_radius_at_least", decimal("0.0001")},
                                      {"bias_below", decimal("0.000013")},
                                      {"ripple_below", decimal("0.00003")}};
  certificate["derivations"] = Json::array();
  certificate["gains"] = {
      {"steady_state", Json::array({{{"turns", 1}, {"constant", "0x0p+0"}, {"per_frequency", "0x0p+0"}},
                                    {{"turns", 0}, {"constant", "0x0p+0"}, {"per_frequency", "0x1p+0"}}})},
      {"horizon", 16384},
      {"blocks", 32}};
  certificate["claims"] =
      Json::array({claim("model/guarantee", false,
                         {{"frequency_error", "0.0004"}, {"settled_frequency_error", "0.00012"}}),
                   claim("model/limits", false,
                         {{"noise", "0.27"},
                          {"frequency_error", "0.002"},
                          {"reach", "0.0001"},
                          {"reach_frequency_error", "0.001"}}),
                   claim("model/steady-state", false,
                         {{"bias_low", "-0.0000125"}, {"bias_high", "0.0000125"}, {"ripple", "0.000029"}}),
                   claim("model/frequency-error-bound", true, Json::object()),
                   claim("model/settling-time", true, Json::object()),
                   claim("model/largest-noise", true, {{"frequency_error", "0.002"}}),
                   claim("model/frequency-error-radius", true, {{"frequency_error", "0.002"}}),
                   claim("model/bias", true, Json::object()), claim("model/ripple", true, Json::object())});
  certificate["verdict"] = "proved";
  return certificate;
}

Verification verify_type_2(const std::function<void(Json&)>& change) {
  Json certificate = type_2_certificate();
  change(certificate);
  return verify(read_json(certificate.dump()));
}

bool refuses_type_2(const std::function<void(Json&)>& change) {
  try {
    return !verify_type_2(change).verified();
  } catch (const std::exception&) {
    return true;
  }
}

/// With one claim that is not required.
void claim_only(Json& certificate, const std::string& id, const Json& values) {
  certificate["design"]["require"] = {{"frequency_error_below", decimal("0.0005")}};
  certificate["claims"] =
      Json::array({claim(id, false, values), claim("model/frequency-error-bound", true, Json::object())});
}

TEST_CASE("a loop of one channel is verified by gains, in these words") {
  const Verification found = verify_type_2([](Json&) {});
  for (const Part& part : found.parts) {
    CAPTURE(part.name);
    for (const std::string& objection : part.objections) {
      CAPTURE(objection);
      CHECK(part.objections.empty());
    }
  }
  CHECK(found.verified());
  CHECK(found.requirements_proved);
  REQUIRE(found.sentences.size() == 9);
  CHECK(found.sentences[0].text ==
        "In exact arithmetic, on a tone of amplitude 1 with any constant frequency in [0.2, 0.5] rad/sample, "
        "with noise below 0.05, started within {theta: 0.1, w: 0.0001} of the steady state of the "
        "certificate, the other states in it, the frequency error stays at or below 0.0004 rad/sample for "
        "ever, and at or below 0.00012 rad/sample in the long run.");
}

TEST_CASE("nothing of one channel that was changed for the better is verified") {
  const auto changes_claim = [](std::size_t index, const std::string& name, const std::string& value) {
    return refuses_type_2([&](Json& c) { c["claims"][index][name] = value; });
  };
  CHECK(changes_claim(0, "frequency_error", "0.0001"));
  CHECK(changes_claim(0, "settled_frequency_error", "0.00009"));
  CHECK(changes_claim(1, "noise", "0.28"));
  CHECK(changes_claim(1, "frequency_error", "0.2"));  // perhaps another lock
  CHECK(changes_claim(1, "reach", "0.01"));
  CHECK(changes_claim(2, "bias_high", "0.000003"));  // the bound less the ripple
  CHECK(changes_claim(2, "bias_low", "0"));
  CHECK(changes_claim(2, "ripple", "0.0000115"));
  const auto changes = [](const std::string& name, const Json& value) {
    return refuses_type_2([&](Json& c) { c["design"]["assume"][name] = value; });
  };
  CHECK(changes("noise", decimal("0.3")));
  CHECK(changes("slew", decimal("1e-12")));
  CHECK(changes("amplitude", Json::array({decimal("0.99"), decimal("1")})));
  CHECK(changes("amplitude", decimal("0.8")));
  CHECK(changes("frequency", {decimal("-0.5"), decimal("0.5")}));
  CHECK(changes("frequency", {decimal("-0.5"), decimal("-0.2")}));
  CHECK(changes("frequency", {decimal("0"), decimal("0.5")}));
  CHECK(changes("frequency", {decimal("0.5"), decimal("0.2")}));
  CHECK(changes("frequency", {decimal("0.001"), decimal("0.5")}));
  for (const char* signal : {"A*cos(phi) + 0.1", "A*cos(2*phi)", "A*sin(phi)", "cos(phi)*A"}) {
    CAPTURE(signal);
    CHECK(refuses_type_2([&](Json& c) { c["design"]["model"]["signal"][0] = signal; }));
  }
}

TEST_CASE("a wrong steady state of one channel, or a horizon that is too short, is refused") {
  const auto changes_state = [](std::size_t index, const std::string& name, const Json& value) {
    return refuses_type_2([&](Json& c) { c["gains"]["steady_state"][index][name] = value; });
  };
  CHECK(changes_state(0, "turns", 0));
  CHECK(changes_state(0, "turns", 2));
  CHECK(changes_state(0, "turns", -1));
  CHECK(changes_state(0, "constant", "0x1p-1"));
  CHECK(changes_state(0, "constant", "0x1.921fb54442d18p+1"));  // half a turn: not stable
  CHECK(changes_state(0, "per_frequency", "0x1p-1"));
  CHECK(changes_state(1, "turns", 1));
  CHECK(changes_state(1, "constant", "0x1p-10"));
  CHECK(changes_state(1, "per_frequency", "0x1.01p+0"));
  CHECK(refuses_type_2([](Json& c) { c["gains"]["horizon"] = 512; }));
}

TEST_CASE("of one channel, neither a slew nor stability is established") {
  CHECK_FALSE(refuses_type_2([](Json& c) {
    claim_only(c, "model/guarantee", {{"frequency_error", "0.0004"}});
  }));
  CHECK(refuses_type_2([](Json& c) {
    claim_only(c, "model/slew-limit", {{"slew", "1e-12"}, {"frequency_error", "0.002"}});
  }));
  CHECK(refuses_type_2([](Json& c) { claim_only(c, "model/stability", {{"decay", "0.9999"}}); }));
  CHECK(refuses_type_2([](Json& c) {
    c["design"]["require"]["largest_slew_at_least"] = decimal("1e-12");
    c["claims"].push_back(claim("model/largest-slew", true, {{"frequency_error", "0.002"}}));
  }));
}

TEST_CASE("of one channel, a constant amplitude in a range is one amplitude") {
  const auto in_range = [](Json& c) {
    claim_only(c, "model/guarantee", {{"frequency_error", "0.00045"}});
    c["design"]["assume"]["amplitude"] = {{"constant", {decimal("0.95"), decimal("1.05")}}};
  };
  CHECK_FALSE(refuses_type_2(in_range));
  CHECK(refuses_type_2([&](Json& c) {
    in_range(c);
    c["design"]["assume"]["amplitude"] = {{"constant", {decimal("0.2"), decimal("1.05")}}};
  }));
}

}  // namespace
}  // namespace veritrack::checker
