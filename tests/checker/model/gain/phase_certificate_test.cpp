// Certificates by gains that depend on the phase: what is true is verified, in these words, and nothing that
// was changed for the better is.
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "checker/verification.hpp"
#include "tests/checker/model/gain/phase_loops.hpp"

namespace veritrack::checker {
namespace {

using test::claim;
using test::decimal;
using test::exactly;
using test::Json;

Json smoothing_certificate() {
  Json certificate;
  certificate["schema"] = kFormat;
  certificate["design_sha256"] = std::string(64, '0');
  certificate["design"] = {{"name", "a loop"}, {"tracker", "model"}, {"source", ""}};
  certificate["design"]["model"] = test::smoothing_model();
  certificate["design"]["assume"] = {{"amplitude", decimal("1")},
                                     {"frequency", {decimal("0.2991"), decimal("0.3009")}},
                                     {"frequency_in_hertz", false},
                                     {"noise", decimal("0.01")},
                                     {"slew", decimal("1e-6")},
                                     {"slew_in_hertz_per_second", false},
                                     {"start_within", Json::array({{{"name", "w"}, {"formula", "0.02"}}})}};
  certificate["design"]["require"] = {{"frequency_error_below", decimal("0.35")},
                                      {"settles_within", decimal("200")},
                                      {"settled_below", decimal("0.32")}};
  certificate["derivations"] = Json::array();
  certificate["tubes"] = Json::array();
  certificate["gains"] = test::smoothing_gains();
  const auto by_gains = [](const std::string& id, bool required, Json values) {
    values["by"] = "gains";
    return claim(id, required, values);
  };
  certificate["claims"] = Json::array(
      {by_gains("model/guarantee", false, {{"frequency_error", "0.34"}, {"settled_frequency_error", "0.32"}}),
       by_gains("model/steady-state", false,
                {{"bias_low", "0.1989"}, {"bias_high", "0.2011"}, {"ripple", "0.18"}}),
       by_gains("model/frequency-error-bound", true, Json::object()),
       by_gains("model/settling-time", true, Json::object())});
  certificate["verdict"] = "proved";
  return certificate;
}

Verification verified(const Json& certificate) {
  return verify(read_json(certificate.dump()));
}

bool is_refused(const std::function<void(Json&)>& change) {
  Json certificate = smoothing_certificate();
  change(certificate);
  try {
    return !verified(certificate).verified();
  } catch (const std::exception&) {
    return true;
  }
}

}  // namespace

TEST_CASE("a loop with a ripple is verified by gains with phases, in these words") {
  const Verification found = verified(smoothing_certificate());
  for (const Part& part : found.parts) {
    CAPTURE(part.name);
    for (const std::string& objection : part.objections) {
      CAPTURE(objection);
      CHECK(part.objections.empty());
    }
  }
  CHECK(found.verified());
  CHECK(found.requirements_proved);
  REQUIRE(found.sentences.size() == 4);
  CHECK(found.sentences[0].text.find("started within {w: 0.02} of the steady state of the certificate") !=
        std::string::npos);
  CHECK(found.sentences[0].text.find("the frequency error stays at or below 0.34 rad/sample for ever, and at "
                                     "or below 0.32 rad/sample in the long run.") != std::string::npos);
}

TEST_CASE("no claim by gains with phases that was changed for the better is verified") {
  CHECK_FALSE(is_refused([](Json&) {}));
  const auto changes = [](std::size_t index, const std::string& name, const Json& value) {
    return is_refused([&](Json& c) { c["claims"][index][name] = value; });
  };
  CHECK(changes(0, "frequency_error", "0.31"));
  CHECK(changes(0, "settled_frequency_error", "0.29"));
  CHECK(changes(0, "by", "tubes"));
  CHECK(changes(1, "bias_low", "0.1995"));
  CHECK(changes(1, "bias_high", "0.2005"));
  CHECK(changes(1, "ripple", "0.17"));
  CHECK(is_refused([](Json& c) { c["claims"][0].erase("by"); }));
  CHECK(is_refused([](Json& c) { c["design"]["require"]["frequency_error_below"] = decimal("0.31"); }));
  CHECK(is_refused([](Json& c) { c["design"]["assume"]["start_within"][0]["formula"] = "0.2"; }));
  CHECK(is_refused([](Json& c) { c["design"]["require"]["settled_below"] = decimal("0.29"); }));
  CHECK(is_refused([](Json& c) {
    c["claims"].push_back(claim("model/stability", false, {{"decay", "0.95"}, {"by", "gains"}}));
  }));
}

TEST_CASE("evidence with phases that is not what it should be is refused") {
  const auto changes = [](const std::string& name, const Json& value) {
    return is_refused([&](Json& c) { c["gains"][name] = value; });
  };
  for (const Json& phases : {Json(4), Json(48), Json(1024), Json(0), Json(-64), Json("64")}) {
    CHECK(changes("phases", phases));
  }
  for (const Json& horizon : {Json(0), Json(4), Json(1L << 17U), Json(-1)}) {
    CHECK(changes("horizon", horizon));
  }
  CHECK(changes("cells", Json::array()));
  CHECK(changes("steady_state", Json::array()));
  CHECK(changes("other", 1));
  const auto changes_cell = [](const std::string& name, const Json& value) {
    return is_refused([&](Json& c) { c["gains"]["cells"][0][name] = value; });
  };
  CHECK(changes_cell("other", 1));
  for (const Json& parts : {Json(0), Json(-1), Json(4097)}) {
    CHECK(changes_cell("parts", parts));
  }
  CHECK(changes_cell("turns", {1}));  // not an angle
  CHECK(changes_cell("turns", {0, 0}));
  CHECK(changes_cell("turns", Json::array()));
  CHECK(changes_cell("curve", Json::array()));
  CHECK(changes_cell("basis", Json::array()));
  CHECK(changes_cell("basis", Json::array({Json::array()})));  // 0
  CHECK(changes_cell("matrix", Json::array()));
  CHECK(changes_cell("matrix", Json::array({Json::array({"0.9"})})));
  CHECK(changes_cell("matrix", Json::array({Json::array({exactly(0.5)})})));
  CHECK(changes_cell("matrix", Json::array({Json::array({exactly(1.1)})})));
  CHECK(changes_cell("half_width", exactly(0.0)));
  CHECK(changes_cell("half_width", exactly(-1e-3)));
  CHECK(changes_cell("half_width", exactly(5e-4)));  // the band is not covered
  CHECK(changes_cell("frequency", exactly(0.31)));
  // The same cell, from 0.299 to 0.301, and a wider band.
  for (const auto& [from, to] : {std::pair("0.2989", "0.3009"), std::pair("0.2991", "0.3011")}) {
    const Json band = Json::array({decimal(from), decimal(to)});
    CHECK(is_refused([&](Json& c) { c["design"]["assume"]["frequency"] = band; }));
  }
  CHECK(is_refused([](Json& c) { c["gains"]["cells"].push_back(c["gains"]["cells"][0]); }));
}

TEST_CASE("a curve that is another one has a residual, and bounds that are larger by it") {
  CHECK(is_refused([](Json& c) { c["gains"]["cells"][0]["curve"][0][0][0][0] = exactly(0.6); }));
  CHECK(is_refused([](Json& c) { c["gains"]["cells"][0]["curve"][0][2] = Json::array(); }));
}

TEST_CASE("a design that gains with phases are not for is refused") {
  const auto assumes = [](const std::string& name, const Json& value) {
    return is_refused([&](Json& c) { c["design"]["assume"][name] = value; });
  };
  CHECK(assumes("amplitude", Json::array({decimal("0.9"), decimal("1.1")})));
  CHECK(assumes("amplitude", {{"constant", Json::array({decimal("0.9"), decimal("1.1")})}}));
  CHECK(assumes("noise", {{"snr_db", decimal("20")}}));
  CHECK(assumes("start_exactly", Json::array({{{"name", "w"}, {"formula", "0.5"}}})));
  CHECK(assumes("slew", decimal("1")));
  for (const auto& [from, to] : {std::pair("0", "0.3009"), std::pair("0.2991", "3.1416")}) {
    Json certificate = smoothing_certificate();
    certificate["design"]["assume"]["frequency"] = {decimal(from), decimal(to)};
    const Verification found = verified(certificate);
    CHECK(std::any_of(found.parts.begin(), found.parts.end(), [](const Part& part) {
      return part.name == "gains" && !part.objections.empty() &&
             part.objections.front() == "in one channel, gains are for frequencies between 0 and pi";
    }));
  }
  CHECK(is_refused([](Json& c) {
    Json second = c["gains"]["cells"][0];
    second["frequency"] = exactly(0.3015);
    c["gains"]["cells"].push_back(second);  // two cells, and a slew
  }));
  CHECK(is_refused([](Json& c) { c["design"]["model"]["signal"] = {"A*cos(0.5*phi)"}; }));
  CHECK(is_refused([](Json& c) { c["design"]["model"]["step"] = "w' = 0.9*w + 0.1*max(y*y, 0)\n"; }));
}

TEST_CASE("a curve that is no steady state is refused, whatever the claims say") {
  Json certificate = smoothing_certificate();
  certificate["claims"].erase(1);
  certificate["design"]["model"]["signal"] = {"A*cos(phi) + 0.0001*cos(3*phi)"};
  certificate["claims"][0]["frequency_error"] = "0.5";
  certificate["claims"][0]["settled_frequency_error"] = "0.49";
  const Verification found = verified(certificate);
  const auto gains = std::find_if(found.parts.begin(), found.parts.end(),
                                  [](const Part& part) { return part.name == "gains"; });
  REQUIRE(gains != found.parts.end());
  CHECK_FALSE(gains->objections.empty());
}

TEST_CASE("a harmonic in the signal is one like any other, with its own curve") {
  Json certificate = smoothing_certificate();
  certificate["claims"].erase(1);  // false locks are nearer
  certificate["design"]["model"]["signal"] = {"A*cos(phi) + 0.000001*cos(3*phi)"};
  CHECK(verified(certificate).verified());  // the residual has room
  certificate["design"]["model"]["signal"] = {"A*cos(phi) + 0.1*cos(3*phi)"};
  CHECK_FALSE(verified(certificate).verified());
}

}  // namespace veritrack::checker
