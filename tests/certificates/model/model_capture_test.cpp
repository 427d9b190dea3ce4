// The start that a design knows exactly, and what its certificate says of it.
#include "certificates/model/model_capture.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/model/model_claims.hpp"
#include "certificates/model/model_sets.hpp"
#include "tests/certificates/model/model_certificates.hpp"
#include "tests/support/golden.hpp"

namespace veritrack::certificates {
namespace {

using rigor::Interval;

/// tests/certificates/model-from-rest.toml and a tube for its noise.
struct FromRest {
  Design design =
      read_design(test::read_file(VERITRACK_SOURCE_DIR "/tests/certificates/model-from-rest.toml"),
                  "model-from-rest.toml");
  Model model;
  model::TrackerModel tracker;
  std::vector<Interval> start;
  model::TubeSet set;

  FromRest() {
    const rigor::UpwardRounding upward;
    const ModelTables& tables = model_tables(design);
    model = make_model(tables.model, tables.assume.signal);
    tracker = proved_model(model, tables.assume);
    start = exact_start(model, tables.model, tables.assume.start_exactly);
    set = model::prove_set(proposed_tone(model, tables.assume), tracker, 0.312, 0.313,
                           {.name = "assumed",
                            .objective = model::ShapeObjective::largest_noise,
                            .noise = 0.0101,
                            .deviations = {}});
    REQUIRE(set.is_complete);
  }

  [[nodiscard]] ModelCapture capture(const std::vector<Interval>& from, double noise,
                                     const search::Deadline& deadline = {}) const {
    const rigor::UpwardRounding upward;
    return capture_of(model, tracker, from, set, noise, 0.02, deadline, {});
  }
};

TEST_CASE("the start of a design is a formula for each state, and is captured") {
  const FromRest rest;
  REQUIRE(rest.start.size() == 3);
  CHECK(rigor::contains(rest.start[0], 0.0));
  CHECK(rigor::contains(rest.start[2], 2.0 * std::sin(0.3125 / 2.0)));
  const ModelCapture found = rest.capture(rest.start, 0.0101);
  CAPTURE(found.reason);
  REQUIRE(found.is_proved);
  CHECK(found.samples > 20);
  CHECK(found.samples < 100);
  CHECK(found.phases > 0);
  CHECK(found.frequencies > 0);
  CHECK(found.frequency_error > 0.02);  // of the way, and of the set
  CHECK(found.frequency_error < 0.1);

  const ModelCapture stuck = rest.capture({Interval(0.0), Interval(0.0), Interval(0.0)}, 0.0101);
  CHECK_FALSE(stuck.is_proved);
  CHECK(stuck.reason.find("simulated at some phases") == 0);
  const ModelCapture loud = rest.capture(rest.start, 1.0);
  CHECK_FALSE(loud.is_proved);
  CHECK_FALSE(loud.reason.empty());
  const ModelCapture late = rest.capture(rest.start, 0.0101, search::Deadline(0.0));
  CHECK_FALSE(late.is_proved);
  CHECK(late.reason.find("the time was over") != std::string::npos);
}

TEST_CASE("an angle that turns is never captured from one value, and nothing by no set") {
  const rigor::UpwardRounding upward;
  const Design design = test::loop_design();
  const ModelTables& tables = model_tables(design);
  const Model model = make_model(tables.model, tables.assume.signal);
  const model::TrackerModel tracker = proved_model(model, tables.assume);
  model::TubeSet set;
  const std::vector<Interval> start{Interval(0.0), Interval(0.31)};
  const ModelCapture by_nothing = capture_of(model, tracker, start, set, 0.0, 0.01, {}, {});
  CHECK_FALSE(by_nothing.is_proved);
  CHECK(by_nothing.reason == "there is no set that it could come into");
  set.tubes.emplace_back();
  set.tubes.front().tube.turns = {1, 0};
  const ModelCapture turning = capture_of(model, tracker, start, set, 0.0, 0.01, {}, {});
  CHECK_FALSE(turning.is_proved);
  CHECK(turning.reason.starts_with("the angle theta turns with the signal"));
}

TEST_CASE("a claim says what is proved of the start, with all that it rests on") {
  std::string text = test::kLoopText;
  const std::string within = "start_within = { w = 0.001 }";
  text.replace(text.find(within), within.size(), "start_exactly = { theta = '1/2', w = 'wn' }");
  text += "captured_within = 40\n";
  const auto certificate_of = [&](const ModelCapture& capture, bool has_set) {
    ModelSets sets;
    sets.assumed.emplace();
    sets.assumed->tubes.name = "assumed";
    sets.assumed->tubes.is_complete = has_set;
    sets.assumed->frequency_error = 0.0078125;
    sets.assumed->half_distance = 0.25;
    sets.assumed->settled_error = INFINITY;
    sets.starts.frequency_error = INFINITY;
    sets.capture = capture;
    const rigor::UpwardRounding upward;
    Certificate certificate;
    certificate.design = test::loop_design(text);
    certificate.particulars = sets;
    add_model_claims(certificate);
    return certificate;
  };
  const auto find = [](const Certificate& certificate, const char* id) {
    const auto found = std::find_if(certificate.claims.begin(), certificate.claims.end(),
                                    [&](const Claim& claim) { return claim.id == id; });
    return found != certificate.claims.end() ? std::optional(*found) : std::nullopt;
  };
  const auto claim_of = [&](const ModelCapture& capture, bool has_set = true) {
    const auto claim = find(certificate_of(capture, has_set), "model/capture");
    return claim ? claim->statement : std::string();
  };
  const std::string start =
      "In exact arithmetic, on a tone of amplitude 1 with any constant frequency in [0.3, 0.32] rad/sample "
      "at "
      "1000 samples per second, with noise below 0.02, started exactly in {theta: 1/2, w: wn} at any phase "
      "of "
      "the signal, the tracker is in the set \"assumed\" of the certificate after at most 40 samples";
  CHECK(claim_of({true, "", 40, 0.015625, 16, 2}) ==
        start +
            ", with a frequency error of at most 0.01563 rad/sample (2.49 Hz) until then, and the frequency "
            "error stays at or below 0.007813 rad/sample (1.25 Hz) for ever after.");
  CHECK(claim_of({true, "", 40, INFINITY, 16, 2}) ==
        start + ", and the frequency error stays at or below 0.007813 rad/sample (1.25 Hz) for ever after.");
  CHECK(claim_of({false, "no", 0, 0.0, 16, 2}).empty());
  CHECK(claim_of({true, "", 40, 0.015625, 16, 2}, false).empty());

  const auto required = [&](const ModelCapture& capture, bool has_set = true) {
    return find(certificate_of(capture, has_set), "model/capture-time").value();
  };
  const Claim in_time = required({true, "", 40, INFINITY, 16, 2});
  CHECK(in_time.verdict == rigor::Verdict::proved);
  CHECK(in_time.required);
  CHECK(in_time.statement ==
        start + ", and there the frequency error stays at or below 0.007813 rad/sample (1.25 Hz).");
  CHECK(required({true, "", 41, INFINITY, 16, 2}).verdict == rigor::Verdict::undecided);
  CHECK(required({true, "", 40, INFINITY, 16, 2}, false).verdict == rigor::Verdict::undecided);
  const Claim open = required({false, "it is too far", 0, INFINITY, 16, 2});
  CHECK(open.verdict == rigor::Verdict::undecided);
  CHECK(open.reason == "It is not proved that it comes there: it is too far.");
}

}  // namespace
}  // namespace veritrack::certificates
