// Certificates of models: what is true is verified, and nothing that was changed for the better is.
#include "checker/model/model_certificate.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

#include "checker/verification.hpp"
#include "tests/checker/model/proposed_certificate.hpp"

namespace veritrack::checker {
namespace {

using test::decimal;
using test::hexadecimal;
using test::hexadecimals;
using test::Json;

Verification verify_json(const Json& certificate) {
  return verify(read_json(certificate.dump()));
}

/// The objections to a part; "no such part" for one that is not there.
std::string objections_to(const Verification& found, const std::string& part) {
  for (const Part& each : found.parts) {
    if (each.name == part) {
      std::string all;
      for (const std::string& objection : each.objections) {
        all += objection + "\n";
      }
      return all;
    }
  }
  return "no such part";
}

/// With a change, NOT VERIFIED, or malformed.
bool refuses(const std::function<void(Json&)>& change) {
  Json certificate = test::loop_certificate();
  change(certificate);
  try {
    return !verify_json(certificate).verified();
  } catch (const Malformed&) {
    return true;
  }
}

/// What a required claim about lock names.
Json error_of(const std::string& id) {
  const bool is_about_lock =
      id == "model/largest-noise" || id == "model/largest-slew" || id == "model/frequency-error-radius";
  return is_about_lock ? Json{{"frequency_error", "0.014"}} : Json::object();
}

TEST_CASE("a phase-locked loop is verified, in these words") {
  const Verification found = verify_json(test::loop_certificate());
  for (const Part& part : found.parts) {
    CAPTURE(part.name);
    CHECK(objections_to(found, part.name).empty());
  }
  REQUIRE(found.verified());
  REQUIRE(found.sentences.size() == 3);
  CHECK(found.sentences[0].text ==
        "In exact arithmetic, on a tone of amplitude 1 with any constant frequency in [0.28125, 0.3125] "
        "rad/sample, without noise, started in the set \"starts\" of the certificate, the frequency error "
        "stays at or "
        "below 0.014 rad/sample for ever, and at or below 0.0012 rad/sample in the long run.");
  CHECK(found.sentences[1].text ==
        "In exact arithmetic, on a tone of amplitude 1 with any constant frequency in [0.28125, 0.3125] "
        "rad/sample, the tracker tolerates noise up to 0.039: a certified invariant set exists in which the "
        "frequency error stays at or below 0.01 rad/sample, and without noise a certified invariant set in "
        "which it stays at or below 0.014 rad/sample contains frequency errors up to 0.0095 rad/sample at "
        "every phase.");
  CHECK(
      found.sentences[2].text ==
      "In exact arithmetic, on a tone of amplitude 1 with any constant frequency in [0.28125, 0.3125] "
      "rad/sample, without noise, started in the set \"starts\" of the certificate, the mean over the phase "
      "of the "
      "frequency error in the long run is between -0.0001 and 0.0001 rad/sample, and the error varies by at "
      "most 0.0023 rad/sample over the phase.");
}

TEST_CASE("tubes that are wrong are refused") {
  const auto cell = [](Json& json) -> Json& { return json["tubes"][0]["cells"][0]; };
  CHECK_FALSE(refuses([](Json&) {}));
  // A curve that is another one, a shape that is larger here than there, a radius, a rate.
  CHECK(refuses([&](Json& json) { cell(json)["curve"][1][0][0][0] = hexadecimal(0.304); }));
  CHECK(refuses([&](Json& json) { cell(json)["shape"][0][0][0][0] = hexadecimal(1e-3); }));
  CHECK(refuses([&](Json& json) { cell(json)["shape"][0] = Json::array(); }));
  CHECK(refuses([&](Json& json) { cell(json)["shape"][0][0][0][0] = "nan"; }));
  CHECK(refuses([&](Json& json) { cell(json)["shape"][0][0][0][0] = "0x1p+2000"; }));
  CHECK(refuses([&](Json& json) { cell(json)["levels"][0] = hexadecimal(0.02); }));
  CHECK(refuses([&](Json& json) { cell(json)["levels"][0] = hexadecimal(10.0); }));
  CHECK(refuses([&](Json& json) { cell(json)["shrinking"][1] = hexadecimal(0.98); }));
  CHECK(refuses([&](Json& json) { json["tubes"][0]["noise"] = hexadecimal(0.04); }));
  CHECK(refuses([&](Json& json) { json["tubes"][1]["noise"] = hexadecimal(0.08); }));
  // The last level is below what the curve is good for.
  CHECK(refuses([&](Json& json) { cell(json)["levels"][3] = hexadecimal(1e-12); }));
  // Turns.
  CHECK(refuses([&](Json& json) { cell(json)["turns"] = {0, 0}; }));
  CHECK(refuses([&](Json& json) { cell(json)["turns"] = {2, 0}; }));
  CHECK(refuses([&](Json& json) { cell(json)["turns"] = {1, 1}; }));
  CHECK(refuses([&](Json& json) { json["design"]["model"]["angles"] = Json::array(); }));
  CHECK(refuses([&](Json& json) { json["design"]["model"]["angles"] = {"theta", "w"}; }));
  CHECK(refuses([&](Json& json) { json["design"]["model"]["frequency"] = "w + theta/1000000"; }));
  CHECK(refuses([&](Json& json) { json["design"]["model"]["signal"][0] = "A*cos(phi/2)"; }));
}

TEST_CASE("evidence that is not in order is refused") {
  const auto cell = [](Json& json) -> Json& { return json["tubes"][0]["cells"][0]; };
  CHECK(refuses([&](Json& json) { cell(json)["levels"] = hexadecimals({0.006, 0.012, 0.0005, 5e-5}); }));
  CHECK(refuses([&](Json& json) { cell(json)["levels"] = hexadecimals({0.012, 0.006, 0.006, 5e-5}); }));
  CHECK(refuses([&](Json& json) { cell(json)["levels"] = hexadecimals({0.012, 0.006, 0.0005, -1.0}); }));
  CHECK(refuses([&](Json& json) { cell(json)["levels"] = hexadecimals({0.012, 0.006, 0.0005, 0.0}); }));
  CHECK(refuses([&](Json& json) { cell(json)["levels"] = Json::array(); }));
  CHECK(refuses([&](Json& json) { cell(json)["shrinking"][0] = hexadecimal(1.0); }));
  CHECK(refuses([&](Json& json) { cell(json)["shrinking"][0] = hexadecimal(-0.5); }));
  CHECK(refuses([&](Json& json) { cell(json)["shrinking"].push_back(hexadecimal(0.5)); }));
  CHECK(refuses([&](Json& json) { cell(json)["turns"].push_back(0); }));
  CHECK(refuses([&](Json& json) { cell(json)["curve"].push_back(Json::array()); }));
  CHECK(refuses([&](Json& json) { cell(json)["shape"].erase(2); }));
  CHECK(refuses([&](Json& json) { cell(json)["phases"] = 3; }));
  CHECK(refuses([&](Json& json) { cell(json)["phases"] = 0; }));
  CHECK(refuses([&](Json& json) { cell(json)["frequencies"] = 1 << 20; }));
  CHECK(refuses([&](Json& json) { cell(json)["half_width"] = hexadecimal(-0.021); }));
  CHECK(refuses([&](Json& json) { cell(json)["half_width"] = hexadecimal(0.0); }));
  CHECK(refuses([&](Json& json) { cell(json)["another"] = "thing"; }));
  CHECK(refuses([&](Json& json) { json["tubes"][0]["crossing"] = hexadecimals({1.0}); }));
  CHECK(refuses([&](Json& json) { json["tubes"][0]["slew"] = hexadecimal(1e-9); }));
  CHECK(refuses([&](Json& json) { json["tubes"][0]["noise"] = hexadecimal(-1.0); }));
  CHECK(refuses([&](Json& json) { json["tubes"][0]["cells"] = Json::array(); }));
  CHECK(refuses([&](Json& json) { json["tubes"][0]["name"] = "other"; }));
  CHECK(refuses([&](Json& json) { json["tubes"][1]["name"] = "starts"; }));
  CHECK(refuses([&](Json& json) { json["derivations"].push_back({{"id", "contraction"}}); }));
}

TEST_CASE("cells are in order, without gaps") {
  // Two halves, of which the evidence is wrong on purpose: only the cover is of interest.
  const auto cover = [](const std::vector<std::pair<double, double>>& cells) {
    Json json = test::loop_certificate();
    Json cell = json["tubes"][0]["cells"][0];
    json["tubes"] = Json::array({json["tubes"][0]});
    json["tubes"][0]["cells"] = Json::array();
    json["claims"] = Json::array();
    for (const auto& place : cells) {
      cell["frequency"] = hexadecimal(place.first);
      cell["half_width"] = hexadecimal(place.second);
      json["tubes"][0]["cells"].push_back(cell);
    }
    return objections_to(verify_json(json), "tubes starts").find("without gaps") == std::string::npos;
  };
  constexpr double kHalf = 0x1p-7;  // the band is from 36 to 40 of these
  CHECK(cover({{37 * kHalf, kHalf}, {39 * kHalf, kHalf}}));
  CHECK(cover({{37 * kHalf, kHalf}, {38.5 * kHalf, 1.5 * kHalf}}));
  CHECK_FALSE(cover({{39 * kHalf, kHalf}, {37 * kHalf, kHalf}}));
  CHECK_FALSE(cover({{37 * kHalf, kHalf}, {39 * kHalf + 0x1p-50, kHalf}}));
  // What they cover of the band counts for the claims.
  CHECK(cover({{37 * kHalf, kHalf}}));
  CHECK(cover({{39 * kHalf, kHalf}}));
}

TEST_CASE("sets of a part of the band prove claims about that part, and nothing else") {
  // The band is wider than the sets.
  const auto wider = [](const std::string& from, const std::string& to) {
    Json json = test::loop_certificate();
    json["design"]["assume"]["frequency"] = {decimal("0.25", 0.25, 0.25), decimal("0.3125", 0.3125, 0.3125)};
    for (Json& claim : json["claims"]) {
      claim["from"] = from;
      claim["to"] = to;
    }
    return json;
  };
  const auto verifies = [](const Json& json) {
    try {
      return verify_json(json).verified();
    } catch (const Malformed&) {
      return false;
    }
  };
  const Verification found = verify_json(wider("0.28", "0.3125"));
  REQUIRE(found.verified());
  REQUIRE(found.sentences.size() == 3);
  for (const Sentence& sentence : found.sentences) {
    CHECK(sentence.text.starts_with(
        "In exact arithmetic, on a tone of amplitude 1 with any constant frequency in "
        "[0.28, 0.3125] rad/sample (a part of the assumed band), "));
  }
  CHECK(verifies(wider("0.29", "0.3")));
  // More than the sets, beyond the band, nothing, half of it, no number.
  CHECK_FALSE(verifies(wider("0.278", "0.3125")));
  CHECK_FALSE(verifies(wider("0.25", "0.3125")));
  CHECK_FALSE(verifies(wider("0.29", "0.3126")));
  CHECK_FALSE(verifies(wider("0.3", "0.3")));
  CHECK_FALSE(verifies(wider("0.31", "0.29")));
  CHECK_FALSE(verifies(wider("-0.3", "0.3")));
  CHECK_FALSE(verifies(wider("nan", "0.3")));
  CHECK_FALSE(verifies(wider("", "0.3")));
  for (const char* missing : {"from", "to"}) {
    Json json = wider("0.29", "0.3");
    json["claims"][0].erase(missing);
    CHECK_FALSE(verifies(json));
  }
  // The whole band.
  Json json = wider("0.29", "0.3");
  json["claims"][0].erase("from");
  json["claims"][0].erase("to");
  CHECK_FALSE(verifies(json));
  // What is required is required of the whole band.
  const auto required = [&](const std::string& key, const std::string& id, const Json& number) {
    Json demanding = wider("0.29", "0.3");
    demanding["design"]["require"][key] = number;
    demanding["claims"].push_back(test::told_claim(id, error_of(id), true));
    demanding["verdict"] = "proved";
    CHECK_FALSE(verifies(demanding));
    demanding["claims"].back()["from"] = "0.29";
    demanding["claims"].back()["to"] = "0.3";
    CHECK_FALSE(verifies(demanding));
    demanding["claims"].erase(3);
    demanding["verdict"] = "undecided";
    CHECK(verifies(demanding));
  };
  required("frequency_error_below", "model/frequency-error-bound", decimal("0.5", 0.5, 0.5));
  required("largest_noise_at_least", "model/largest-noise", decimal("0.015625", 0.015625, 0.015625));
  required("frequency_error_radius_at_least", "model/frequency-error-radius",
           decimal("0.0078125", 0.0078125, 0.0078125));
  required("bias_below", "model/bias", decimal("0.00048828125", 0x1p-11, 0x1p-11));
  required("ripple_below", "model/ripple", decimal("0.00390625", 0x1p-8, 0x1p-8));
  // The set of the noise has to cover the part: here its cell begins at 0.29.
  json = wider("0.28", "0.3125");
  json["claims"].erase(0);
  json["claims"].erase(1);
  CHECK(verifies(json));
  json["tubes"][1]["cells"][0]["frequency"] = hexadecimal(0.3105);
  CHECK_FALSE(verifies(json));
}

/// With the set for the noise as the one for what is assumed, and another set for the largest noise.
Json with_two_noises(double searched) {
  Json json = test::loop_certificate();
  json["design"]["assume"]["noise"] = decimal("0.03125", 0.03125, 0.03125);
  Json assumed = json["tubes"][1];
  assumed["name"] = "assumed";
  json["tubes"][1]["noise"] = hexadecimal(searched);
  json["tubes"].push_back(assumed);
  json["claims"] = Json::array({json["claims"][1]});
  return json;
}

TEST_CASE("limits are those of all verified sets, and the sentence names the set") {
  const auto sentence_of = [](const Json& json) {
    try {
      const Verification found = verify_json(json);
      return found.verified() && found.sentences.size() == 1 ? found.sentences[0].text : std::string();
    } catch (const Malformed&) {
      return std::string();
    }
  };
  // The search for the largest noise ended at 0.005; 0.04 is proved by the other set.
  const Json json = with_two_noises(0.005);
  CHECK(sentence_of(json).find(", the tracker tolerates noise up to 0.039 (by the set \"assumed\" of the "
                               "certificate): a certified invariant set exists in which") !=
        std::string::npos);
  CHECK(sentence_of(with_two_noises(0.04)).find("by the set") == std::string::npos);
  // Above every verified set.
  Json above = json;
  above["claims"][0]["noise"] = "0.0401";
  CHECK(sentence_of(above).empty());
  // A set that is not verified does not count.
  Json wrong = json;
  wrong["tubes"][2]["noise"] = hexadecimal(0.08);
  CHECK(sentence_of(wrong).empty());
  // Nor one over a part of the band, for the whole of it.
  Json part = json;
  part["design"]["assume"]["frequency"][0] = decimal("0.25", 0.25, 0.25);
  CHECK(sentence_of(part).empty());
  part["claims"][0]["from"] = "0.28";
  part["claims"][0]["to"] = "0.3125";
  CHECK(sentence_of(part).find("[0.28, 0.3125] rad/sample (a part of the assumed band), the tracker") !=
        std::string::npos);
  // Errors that only the set for some noise contains.
  Json reach = json;
  reach["claims"][0]["reach"] = "0.002";
  reach["claims"][0]["reach_frequency_error"] = "0.01";
  reach["tubes"].erase(0);
  CHECK(sentence_of(reach).find("frequency errors up to 0.002 rad/sample at every phase.") !=
        std::string::npos);
  reach["claims"][0]["reach"] = "0.0095";
  CHECK(sentence_of(reach).empty());
  // No set is for a frequency that moves.
  Json slew = json;
  slew["claims"][0] = test::told_claim("model/slew-limit", {{"slew", "1e-9"}, {"frequency_error", "0.01"}});
  CHECK(sentence_of(slew).empty());
}

TEST_CASE("a band may begin at 0 and end at half the sample rate") {
  Json json = test::loop_certificate();
  json["design"]["assume"]["frequency"] = {decimal("0", 0.0, 0.0),
                                           decimal("3.1416", 3.1415999999999999, 3.1416000000000004)};
  json["claims"] = Json::array({json["claims"][0]});
  CHECK_FALSE(verify_json(json).verified());
  json["claims"][0]["from"] = "0.28";
  json["claims"][0]["to"] = "0.32";
  CHECK(verify_json(json).verified());
  json["design"]["assume"]["frequency"][1] = decimal("3.25", 3.25, 3.25);
  CHECK_FALSE(verify_json(json).verified());
}

TEST_CASE("claims that say more are refused") {
  CHECK(refuses([](Json& json) { json["claims"][0]["frequency_error"] = "0.0115"; }));
  CHECK(refuses([](Json& json) { json["claims"][0]["settled_frequency_error"] = "0.0006"; }));
  CHECK(refuses([](Json& json) { json["claims"][0]["frequency_error"] = "-1"; }));
  CHECK(refuses([](Json& json) { json["claims"][0]["frequency_error"] = "inf"; }));
  CHECK(refuses([](Json& json) { json["claims"][0].erase("frequency_error"); }));
  CHECK(refuses([](Json& json) { json["claims"][0]["another"] = "0.1"; }));
  CHECK(refuses([](Json& json) { json["claims"][0]["required"] = true; }));
  CHECK(refuses([](Json& json) { json["claims"][0]["verdict"] = "refuted"; }));
  CHECK(refuses([](Json& json) { json["claims"][0]["id"] = "model/largest-noise"; }));
  CHECK(refuses([](Json& json) { json["claims"][0]["id"] = "model/anything"; }));
  CHECK(refuses([](Json& json) { json["claims"][0]["evidence"]["x"] = {{"lo", "0x1p+0"}}; }));
  CHECK(refuses([](Json& json) { json["claims"].push_back(json["claims"][0]); }));
  CHECK(refuses([](Json& json) { json["claims"][1]["noise"] = "0.0401"; }));
  CHECK(refuses([](Json& json) { json["claims"][1]["reach"] = "0.0125"; }));
  CHECK(refuses([](Json& json) { json["claims"][2]["bias_low"] = "0.0001"; }));
  CHECK(refuses([](Json& json) { json["claims"][2]["bias_high"] = "-0.0001"; }));
  CHECK(refuses([](Json& json) { json["claims"][2]["ripple"] = "0.0012"; }));
  CHECK(refuses([](Json& json) { json["verdict"] = "proved"; }));
  // Without the set, or with a set of another kind.
  CHECK(refuses([](Json& json) { json["tubes"].erase(0); }));
  CHECK(refuses([](Json& json) { json["tubes"].erase(1); }));
  // One level: no long run.
  CHECK(refuses([](Json& json) {
    json["tubes"][0]["cells"][0]["levels"] = hexadecimals({0.012});
    json["tubes"][0]["cells"][0]["shrinking"] = hexadecimals({1.0});
  }));
}

TEST_CASE("designs that are none are refused, and noise needs a set of its own") {
  const auto assume = [](Json& json) -> Json& { return json["design"]["assume"]; };
  CHECK(refuses([&](Json& json) { assume(json)["noise"] = decimal("0.5", 0.5, 0.5); }));
  CHECK(refuses([&](Json& json) { assume(json)["noise"] = decimal("-0.5", -0.5, -0.5); }));
  CHECK(refuses([&](Json& json) { assume(json)["slew"] = decimal("0.5", 0.5, 0.5); }));
  CHECK(refuses([&](Json& json) { assume(json)["amplitude"] = decimal("0", 0.0, 0.0); }));
  CHECK(refuses([&](Json& json) { assume(json)["amplitude"] = decimal("2", 2.0, 2.0); }));
  CHECK(refuses([&](Json& json) { assume(json)["amplitude"] = decimal("1.5", 1.0, 1.0); }));
  CHECK(refuses([&](Json& json) { std::swap(assume(json)["frequency"][0], assume(json)["frequency"][1]); }));
  CHECK(refuses([&](Json& json) { assume(json)["frequency"][1] = decimal("4", 4.0, 4.0); }));
  CHECK(refuses([&](Json& json) { assume(json)["frequency"][0] = decimal("0.25", 0.25, 0.25); }));
  CHECK(refuses([&](Json& json) { assume(json)["frequency_in_hertz"] = true; }));
  CHECK(refuses([&](Json& json) { assume(json)["another"] = "thing"; }));
  CHECK(refuses([&](Json& json) { json["design"]["model"]["another"] = "thing"; }));
  CHECK(refuses([&](Json& json) { json["design"]["model"]["step"] = "w' = w\ntheta' = theta + w*y"; }));
  CHECK(refuses([&](Json& json) { json["design"]["model"]["parameters"][0]["formula"] = "0.04"; }));
  CHECK(refuses([&](Json& json) { json["design"]["require"]["another"] = decimal("1", 1.0, 1.0); }));
}

/// The tube for noise 0.04, for less noise and amplitudes that differ by a fiftieth.
Json varying_certificate() {
  Json json = test::loop_certificate();
  json["design"]["assume"]["amplitude"] = {decimal("0.984375", 0.984375, 0.984375),
                                           decimal("1.015625", 1.015625, 1.015625)};
  const Json cells = json["tubes"][1]["cells"];
  json["tubes"] = {test::ProposedModel::set("starts", 0.0, cells),
                   test::ProposedModel::set("noise", 0.02, cells)};
  json["claims"] = {test::told_claim("model/guarantee", {{"frequency_error", "0.007"}}),
                    test::told_claim("model/limits", {{"noise", "0.0195"},
                                                      {"frequency_error", "0.007"},
                                                      {"reach", "0.001"},
                                                      {"reach_frequency_error", "0.007"}})};
  return json;
}

TEST_CASE("amplitudes that differ from sample to sample: in these words, and for no wider range") {
  const Verification found = verify_json(varying_certificate());
  for (const Part& part : found.parts) {
    CAPTURE(part.name);
    CHECK(objections_to(found, part.name).empty());
  }
  REQUIRE(found.verified());
  REQUIRE(found.sentences.size() == 2);
  CHECK(found.sentences[0].text ==
        "In exact arithmetic, on a tone with an amplitude in [0.984375, 1.015625], which may differ from "
        "sample to sample, with any constant frequency in [0.28125, 0.3125] rad/sample, without noise, "
        "started in the set \"starts\" of the certificate, the frequency error stays at or below 0.007 "
        "rad/sample for ever.");
  const auto refuses_with = [](const std::function<void(Json&)>& change) {
    Json certificate = varying_certificate();
    change(certificate);
    try {
      return !verify_json(certificate).verified();
    } catch (const Malformed&) {
      return true;
    }
  };
  CHECK_FALSE(refuses_with([](Json&) {}));
  const auto amplitude = [](Json& json) -> Json& { return json["design"]["assume"]["amplitude"]; };
  // What is proved for a range is proved for one that is narrower.
  CHECK_FALSE(refuses_with([&](Json& json) { amplitude(json)[0] = decimal("1", 1.0, 1.0); }));
  CHECK(refuses_with([&](Json& json) { amplitude(json)[0] = decimal("0.75", 0.75, 0.75); }));
  CHECK(refuses_with([&](Json& json) { amplitude(json)[1] = decimal("1.25", 1.25, 1.25); }));
  CHECK(refuses_with([&](Json& json) { amplitude(json)[1] = decimal("1e300", 1e300, 1e300); }));
  CHECK(refuses_with([&](Json& json) { std::swap(amplitude(json)[0], amplitude(json)[1]); }));
  CHECK(refuses_with([&](Json& json) { amplitude(json)[1] = amplitude(json)[0]; }));
  CHECK(refuses_with([&](Json& json) { amplitude(json)[0] = decimal("0", 0.0, 0.0); }));
  CHECK(refuses_with([&](Json& json) { amplitude(json)[0] = decimal("-1", -1.0, -1.0); }));
  CHECK(refuses_with([&](Json& json) { amplitude(json)[1] = decimal("1.25", 1.015625, 1.015625); }));
  CHECK(refuses_with([&](Json& json) { amplitude(json)[1] = decimal("1.015625", 1.0, 1.0); }));
  CHECK(refuses_with([&](Json& json) { amplitude(json).erase(1); }));
  CHECK(refuses_with([&](Json& json) { amplitude(json).push_back(amplitude(json)[1]); }));
  CHECK(refuses_with([&](Json& json) { amplitude(json) = Json::array(); }));
  CHECK(refuses_with([&](Json& json) { json["design"]["assume"].erase("amplitude"); }));
  CHECK(refuses_with([&](Json& json) { json["tubes"][1]["noise"] = hexadecimal(0.08); }));
  // Nothing is certified of Gaussian noise with a range.
  CHECK(refuses_with([&](Json& json) {
    json["design"]["assume"]["noise"] = {{"deviation", decimal("0.0078125", 0.0078125, 0.0078125)}};
    json["design"]["assume"]["samples"] = decimal("1024", 1024.0, 1024.0);
  }));
}

TEST_CASE("starts within given deviations") {
  const auto with_starts = [](const std::string& w, const std::string& theta) {
    Json json = test::loop_certificate();
    json["design"]["assume"]["start_within"] = {{{"name", "w"}, {"formula", w}},
                                                {{"name", "theta"}, {"formula", theta}}};
    json["claims"] = Json::array({test::told_claim("model/guarantee", {{"frequency_error", "0.014"}})});
    return json;
  };
  const Verification found = verify_json(with_starts("wn/40", "pi/400"));
  CHECK(found.verified());
  REQUIRE(found.sentences.size() == 1);
  CHECK(found.sentences[0].text.find(
            ", without noise, started within {w: wn/40, theta: pi/400} of the curve of the set "
            "\"starts\" of the certificate, the other states on it, the frequency error stays at or below "
            "0.014 ") != std::string::npos);
  CHECK_FALSE(verify_json(with_starts("wn", "0")).verified());
  CHECK_FALSE(verify_json(with_starts("0", "3")).verified());
  CHECK_FALSE(verify_json(with_starts("-wn/40", "0")).verified());
  CHECK_THROWS_AS((void)verify_json(with_starts("A", "0")), Malformed);
  Json twice = with_starts("0", "0");
  twice["design"]["assume"]["start_within"][1]["name"] = "w";
  CHECK_FALSE(verify_json(twice).verified());
  twice["design"]["assume"]["start_within"][1]["name"] = "x";
  CHECK_FALSE(verify_json(twice).verified());
}

TEST_CASE("requirements follow from the sets, or not") {
  const auto with = [](const std::string& key, const Json& number, const std::string& id) {
    Json json = test::loop_certificate();
    json["design"]["require"][key] = number;
    json["claims"] = Json::array({test::told_claim(id, error_of(id), true)});
    json["verdict"] = "proved";
    return json;
  };
  const auto check = [&](const std::string& key, const std::string& id, const Json& met, const Json& not_met,
                         const std::string& sentence) {
    CAPTURE(key);
    const Verification found = verify_json(with(key, met, id));
    CHECK(objections_to(found, "claim " + id).empty());
    CHECK(found.verified());
    CHECK(found.requirements_proved);
    REQUIRE(found.sentences.size() == 1);
    CHECK(found.sentences[0].text.ends_with(sentence));
    CHECK_FALSE(verify_json(with(key, not_met, id)).verified());
  };
  check("frequency_error_below", "model/frequency-error-bound", decimal("0.015625", 0.015625, 0.015625),
        decimal("0.0078125", 0.0078125, 0.0078125),
        "the frequency error stays below 0.015625 rad/sample for ever.");
  check("largest_noise_at_least", "model/largest-noise", decimal("0.03125", 0.03125, 0.03125),
        decimal("0.0625", 0.0625, 0.0625),
        "the tracker tolerates noise up to 0.03125: a certified invariant set exists in which the frequency "
        "error stays at or below 0.014 rad/sample.");
  check("frequency_error_radius_at_least", "model/frequency-error-radius",
        decimal("0.0078125", 0.0078125, 0.0078125), decimal("0.015625", 0.015625, 0.015625),
        "without noise, a certified invariant set in which the frequency error stays at or below 0.014 "
        "rad/sample contains frequency errors up to 0.0078125 rad/sample at every phase.");
  check(
      "bias_below", "model/bias", decimal("0.00048828125", 0x1p-11, 0x1p-11), decimal("1e-6", 1e-6, 1e-6),
      "the mean over the phase of the frequency error in the long run is at most 0.00048828125 rad/sample in "
      "absolute value.");
  check("ripple_below", "model/ripple", decimal("0.00390625", 0x1p-8, 0x1p-8),
        decimal("0.0009765625", 0x1p-10, 0x1p-10),
        "the frequency error in the long run varies by at most 0.00390625 rad/sample over the phase.");
  // No set is for a frequency that moves.
  CHECK_FALSE(verify_json(with("largest_slew_at_least", decimal("0.0009765625", 0x1p-10, 0x1p-10),
                               "model/largest-slew"))
                  .verified());
}

TEST_CASE("settling in time") {
  // log(1/2)/log(0.9998), and so on: 3466 + 1242 + 575 samples down to the last level.
  const auto with = [](const std::string& within, double samples, double error, const std::string& below) {
    Json json = test::loop_certificate();
    json["design"]["require"]["settles_within"] = decimal(within, samples, samples);
    json["design"]["require"]["settled_below"] = decimal(below, error, error);
    json["claims"] = Json::array({test::told_claim("model/settling-time", Json::object(), true)});
    json["verdict"] = "proved";
    return json;
  };
  CHECK(verify_json(with("5283", 5283.0, 0x1p-9, "0.001953125")).verified());
  CHECK_FALSE(verify_json(with("4700", 4700.0, 0x1p-10, "0.0009765625")).verified());
  CHECK(verify_json(with("3466", 3466.0, 0x1p-7, "0.0078125")).verified());
  CHECK_FALSE(verify_json(with("3465", 3465.0, 0x1p-7, "0.0078125")).verified());
  Json alone = with("5283", 5283.0, 0x1p-9, "0.001953125");
  alone["design"]["require"].erase("settled_below");
  CHECK_FALSE(verify_json(alone).verified());
}

TEST_CASE("what is said of lock names an error, which the whole set keeps and which excludes other locks") {
  const auto limits = [](const char* error, const char* of_reach) {
    return [=](Json& json) {
      json["claims"][1]["frequency_error"] = error;
      json["claims"][1]["reach_frequency_error"] = of_reach;
    };
  };
  CHECK_FALSE(refuses(limits("0.01", "0.014")));
  CHECK(refuses(limits("0.002", "0.014")));
  CHECK(refuses(limits("0.01", "0.0096")));
  // One channel does not tell 0.28125 from -0.28125 rad/sample.
  CHECK_FALSE(refuses(limits("0.28", "0.28")));
  CHECK(refuses(limits("0.28126", "0.014")));
  CHECK(refuses(limits("0.01", "0.28126")));
  CHECK(refuses([](Json& json) { json["claims"][1].erase("frequency_error"); }));
  CHECK(refuses([](Json& json) { json["claims"][1].erase("reach_frequency_error"); }));
  // A frequency that is not defined in all of the set.
  CHECK(refuses([](Json& json) {
    json["design"]["model"]["frequency"] = "w + 0*sqrt(w - 0.295)";
    json["claims"].erase(0);
    json["claims"].erase(1);
  }));
}

TEST_CASE(
    "a line that nothing needs is an objection, a limit is shown wherever it stands, and x^0 is refused") {
  const auto with_line = [](const std::string& line) {
    Json json = test::loop_certificate();
    json["design"]["model"]["step"] = json["design"]["model"]["step"].get<std::string>() + line;
    return json;
  };
  CHECK(objections_to(verify_json(with_line("\nu = log(-1 - w)\n")), "design") ==
        "nothing needs the line u\n");
  CHECK(objections_to(verify_json(with_line("\nu = w\nv = u\n")), "design") == "nothing needs the line v\n");
  CHECK(objections_to(verify_json(with_line("\ngone' = w\n")), "design") == "nothing needs the line gone'\n");
  CHECK(verify_json(with_line("\nguard = stays_within(w, 0.2, 0.4)\n")).verified());
  CHECK(verify_json(with_line("\ndouble = 2*w\nguard = stays_within(double, 0.4, 0.8)\n")).verified());
  for (const std::string limit :
       {"stays_within(w, 0.8, 0.81)", "stays_within(w, 0.31, 0.4)", "stays_within(w, 0.4, 0.2)",
        "stays_within(1/(w - w), 0, 1)", "stays_within(theta, -1, 1)"}) {
    CAPTURE(limit);
    const Verification found = verify_json(with_line("\nguard = " + limit + "\n"));
    CHECK_FALSE(found.verified());
    CHECK(objections_to(found, "design").empty());
  }
  CHECK_THROWS_AS(verify_json(with_line("\nguard = stays_within(w, 0.8, 0.81)^0\n")), Malformed);
  CHECK_THROWS_AS(verify_json(with_line("\nguard = (1/(w - w))^0\n")), Malformed);
  // Used, and a factor of 0.
  for (const std::string term : {"0*stays_within(w, 0.8, 0.81)", "0*log(-1 - w)", "0*(1/(w - w))"}) {
    CAPTURE(term);
    Json json = test::loop_certificate();
    std::string step = json["design"]["model"]["step"];
    step.replace(step.find("w + ki*e"), 8, std::string("w + ki*e + ") + term);
    json["design"]["model"]["step"] = step;
    CHECK_FALSE(verify_json(json).verified());
  }
}

}  // namespace
}  // namespace veritrack::checker
