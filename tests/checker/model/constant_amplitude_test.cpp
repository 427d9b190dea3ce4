// A constant amplitude that is known to be in a range: sets in parts of the range, and certificates whose
// parts do not cover it.
#include <doctest/doctest.h>

#include <functional>
#include <stdexcept>
#include <string>

#include "checker/verification.hpp"
#include "tests/checker/model/proposed_certificate.hpp"

namespace veritrack::checker {
namespace {
namespace constant_amplitude {  // helpers of other tests of the unit have the same names

using test::decimal;
using test::hexadecimal;
using test::hexadecimals;
using test::Json;

Json part_of(const std::string& name, double noise, const Json& cells, double low, double high) {
  Json set = test::ProposedModel::set(name, noise, cells);
  set["amplitude"] = hexadecimals({low, high});
  return set;
}

/// The tube for noise 0.04 of an amplitude of 1, for less noise and both parts of a range around it.
Json constant_certificate() {
  Json json = test::loop_certificate();
  json["design"]["assume"]["amplitude"] = {
      {"constant", {decimal("0.984375", 0.984375, 0.984375), decimal("1.015625", 1.015625, 1.015625)}}};
  const Json cells = json["tubes"][1]["cells"];
  json["tubes"] = {part_of("starts", 0.0, cells, 0.984375, 1.0), part_of("starts", 0.0, cells, 1.0, 1.015625),
                   part_of("noise", 0.02, cells, 0.984375, 1.0),
                   part_of("noise", 0.025, cells, 1.0, 1.015625)};
  json["claims"] = {test::told_claim("model/guarantee", {{"frequency_error", "0.007"}}),
                    test::told_claim("model/limits", {{"noise", "0.0195"},
                                                      {"frequency_error", "0.007"},
                                                      {"reach", "0.001"},
                                                      {"reach_frequency_error", "0.007"}})};
  return json;
}

Verification verified(const Json& json) {
  return verify(read_json(json.dump()));
}

bool refuses(const std::function<void(Json&)>& change) {
  Json certificate = constant_certificate();
  change(certificate);
  try {
    return !verified(certificate).verified();
  } catch (const Malformed&) {
    return true;
  } catch (const std::invalid_argument&) {
    return true;
  }
}

std::string all_objections(const Verification& found) {
  std::string all;
  for (const Part& part : found.parts) {
    for (const std::string& objection : part.objections) {
      all.append(part.name).append(": ").append(objection).append("\n");
    }
  }
  return all;
}

/// Refused, and for this.
bool refuses_with(const std::string& objection, const std::function<void(Json&)>& change) {
  Json certificate = constant_certificate();
  change(certificate);
  const Verification found = verified(certificate);
  const std::string all = all_objections(found);
  CAPTURE(all);
  CHECK(all.find(objection) != std::string::npos);
  return !found.verified();
}

constexpr const char* kNoCover = "the parts do not go from low amplitudes to high ones without gaps";

Json& range(Json& json) {
  return json["design"]["assume"]["amplitude"]["constant"];
}
Json& ends(Json& json, std::size_t set) {
  return json["tubes"][set]["amplitude"];
}

TEST_CASE("a constant amplitude of a range: in these words, by the sets of all parts") {
  const Verification found = verified(constant_certificate());
  CHECK(all_objections(found).empty());
  REQUIRE(found.verified());
  REQUIRE(found.sentences.size() == 2);
  CHECK(found.sentences[0].text ==
        "In exact arithmetic, on a tone of any constant amplitude in [0.984375, 1.015625] with any constant "
        "frequency in [0.28125, 0.3125] rad/sample, without noise, started in the set \"starts\" of the "
        "certificate, the frequency error stays at or below 0.007 rad/sample for ever.");
  CHECK_FALSE(refuses([](Json&) {}));
  // Parts that overlap cover, too; so do those of a wider range.
  CHECK_FALSE(refuses([](Json& json) { ends(json, 0)[1] = hexadecimal(1.0078125); }));
  CHECK_FALSE(refuses([](Json& json) { range(json)[0] = decimal("1", 1.0, 1.0); }));
}

TEST_CASE("parts that do not cover the range are refused") {
  for (const std::size_t set : {0U, 1U, 2U, 3U}) {
    CAPTURE(set);
    CHECK(refuses_with(kNoCover, [&](Json& json) { json["tubes"].erase(set); }));
  }
  // A gap, and ends inside the range.
  CHECK(refuses_with(kNoCover, [](Json& json) { ends(json, 0)[1] = hexadecimal(0.99609375); }));
  CHECK(refuses_with(kNoCover, [](Json& json) { ends(json, 1)[0] = hexadecimal(0x1.0000000000001p+0); }));
  CHECK(refuses_with(kNoCover, [](Json& json) { ends(json, 2)[0] = hexadecimal(0x1.f800000000001p-1); }));
  CHECK(refuses_with(kNoCover, [](Json& json) { ends(json, 3)[1] = hexadecimal(0x1.03fffffffffffp+0); }));
  // In another order, or twice the same.
  CHECK(refuses_with(kNoCover, [](Json& json) { std::swap(json["tubes"][0], json["tubes"][1]); }));
  CHECK(refuses_with(kNoCover, [](Json& json) { ends(json, 1) = ends(json, 0); }));
  // A hole that a wide first part does not close.
  CHECK(refuses_with(kNoCover, [](Json& json) {
    ends(json, 2)[1] = hexadecimal(0.9921875);
    json["tubes"].push_back(json["tubes"][3]);
  }));
  // A range that is wider than the parts.
  CHECK(refuses_with(kNoCover, [](Json& json) { range(json)[0] = decimal("0.875", 0.875, 0.875); }));
  CHECK(refuses_with(kNoCover, [](Json& json) { range(json)[1] = decimal("1.125", 1.125, 1.125); }));
}

TEST_CASE("parts that are none are refused") {
  CHECK(refuses([](Json& json) { std::swap(ends(json, 0)[0], ends(json, 0)[1]); }));
  CHECK(refuses([](Json& json) { ends(json, 0)[0] = ends(json, 0)[1]; }));
  CHECK(refuses([](Json& json) { ends(json, 0)[0] = "nan"; }));
  CHECK(refuses([](Json& json) { ends(json, 0)[1] = "inf"; }));
  CHECK(refuses([](Json& json) { ends(json, 0)[0] = hexadecimal(-1.0); }));
  CHECK(refuses([](Json& json) { ends(json, 0)[0] = hexadecimal(0.0); }));
  CHECK(refuses([](Json& json) { ends(json, 0).erase(1); }));
  CHECK(refuses([](Json& json) { ends(json, 0).push_back(hexadecimal(2.0)); }));
  CHECK(refuses([](Json& json) { ends(json, 0) = "all"; }));
  // So wide a part that steps leave the tube.
  CHECK(refuses_with("a step may leave the tube", [](Json& json) { ends(json, 1)[1] = hexadecimal(1.25); }));
}

TEST_CASE("parts go with a constant amplitude in a range, and with nothing else") {
  CHECK(refuses_with("the set says no part", [](Json& json) { json["tubes"][0].erase("amplitude"); }));
  const char* const kFor = "parts of amplitudes are for a constant one that is known to be in a range";
  CHECK(refuses_with(kFor, [](Json& json) {
    json["design"]["assume"]["amplitude"] = Json(range(json));  // of every sample
  }));
  CHECK(
      refuses_with(kFor, [](Json& json) { json["design"]["assume"]["amplitude"] = decimal("1", 1.0, 1.0); }));
  CHECK(refuses([](Json& json) {
    const Json wide = range(json);
    json["design"]["assume"]["amplitude"] = wide;
    for (Json& set : json["tubes"]) {
      set.erase("amplitude");
    }
  }));
  CHECK(refuses([](Json& json) { std::swap(range(json)[0], range(json)[1]); }));
  CHECK(refuses([](Json& json) { range(json)[1] = range(json)[0]; }));
  CHECK(refuses([](Json& json) { range(json)[0] = decimal("0", 0.0, 0.0); }));
  CHECK(refuses([](Json& json) { range(json).erase(1); }));
  CHECK(refuses([](Json& json) { json["design"]["assume"]["amplitude"]["another"] = range(json); }));
  CHECK(refuses([](Json& json) {
    json["design"]["assume"]["noise"] = {{"deviation", decimal("0.0078125", 0.0078125, 0.0078125)}};
    json["design"]["assume"]["samples"] = decimal("1024", 1024.0, 1024.0);
  }));
}

TEST_CASE("claims are about the worst of the parts") {
  // The noise is the least one.
  CHECK(refuses([](Json& json) { json["claims"][1]["noise"] = "0.0201"; }));
  CHECK_FALSE(refuses([](Json& json) { json["claims"][1]["noise"] = "0.02"; }));
  // A part of which nothing is shown spoils the name.
  CHECK(refuses([](Json& json) { json["tubes"][3]["noise"] = hexadecimal(0.5); }));
  // A part whose tubes are smaller reaches less far, and one that is larger bounds less.
  const auto scaled = [](Json& json, std::size_t set, double level) {
    json["tubes"][set]["cells"][0]["levels"] = hexadecimals({level});
  };
  CHECK_FALSE(refuses([&](Json& json) { scaled(json, 1, 0.004375); }));
  CHECK(refuses([](Json& json) { json["claims"][0]["frequency_error"] = "0.004"; }));
  // A part over other frequencies.
  CHECK(refuses([](Json& json) { json["tubes"][1]["cells"][0]["half_width"] = hexadecimal(0.0078125); }));
}

}  // namespace constant_amplitude
}  // namespace
}  // namespace veritrack::checker
