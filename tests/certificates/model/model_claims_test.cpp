#include "certificates/model/model_claims.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/rigor/rounding.hpp"
#include "certificates/model/model_sets.hpp"
#include "tests/certificates/model/model_certificates.hpp"

namespace veritrack::certificates {
namespace {

using model::ProvedSet;
using rigor::Interval;
using rigor::Verdict;

constexpr const char* kRequired = R"(
settles_within = 500
settled_below = 0.01
largest_noise_at_least = 0.03
largest_slew_at_least = 1e-6
frequency_error_radius_at_least = 0.004
bias_below = 1e-5
ripple_below = 0.003
)";

/// Sets of one tube with these numbers, which nothing has proved.
ProvedSet set_of(const char* name, double noise, double slew) {
  ProvedSet set;
  set.tubes.name = name;
  set.tubes.noise = noise;
  set.tubes.slew = slew;
  set.tubes.is_complete = true;
  model::ProvedTube proved;
  proved.levels = {0.01, 0.005};
  proved.shrinking = {0.99};
  set.tubes.tubes = {proved};
  set.frequency_error = 0.015625;
  set.half_distance = 0.25;
  set.settled_error = 0.0078125;
  set.reach = 0.005;
  set.start_share = 0.5;
  set.bias = Interval::from_bounds(-1e-6, 2e-6);
  set.ripple = 0.002;
  return set;
}

ModelSets sets_of() {
  ModelSets sets;
  sets.starts = set_of("starts", 0.0, 0.0);
  sets.assumed = set_of("assumed", 0.02, 0.0);
  sets.noise = set_of("noise", 0.05, 0.0);
  return sets;
}

/// Without the requirement on settling, which needs a tube to look at.
std::string text_of(const char* required) {
  std::string text = test::kLoopText;
  return text + std::string(required).substr(std::string(required).find("largest_noise"));
}

Certificate certificate_of(const ModelSets& sets, const std::string& text) {
  const rigor::UpwardRounding upward;
  Certificate certificate;
  certificate.design = test::loop_design(text);
  certificate.particulars = sets;
  add_model_claims(certificate);
  return certificate;
}

const Claim* find(const Certificate& certificate, const std::string& id) {
  const auto found = std::find_if(certificate.claims.begin(), certificate.claims.end(),
                                  [&](const Claim& claim) { return claim.id == id; });
  return found != certificate.claims.end() ? &*found : nullptr;
}

TEST_CASE("every claim is decided by its set") {
  const Certificate certificate = certificate_of(sets_of(), text_of(kRequired));
  for (const char* id :
       {"model/guarantee", "model/limits", "model/steady-state", "model/frequency-error-bound",
        "model/largest-noise", "model/frequency-error-radius", "model/bias", "model/ripple"}) {
    CAPTURE(id);
    const Claim* claim = find(certificate, id);
    REQUIRE(claim != nullptr);
    CHECK(claim->verdict == Verdict::proved);
    CHECK(
        claim->statement.starts_with("In exact arithmetic, on a tone of amplitude 1 with any constant "
                                     "frequency in [0.3, 0.32] rad/sample"));
    CHECK(claim->statement.ends_with("."));
  }
  CHECK(find(certificate, "model/guarantee")
            ->statement.find(", with noise below 0.02, started within {w: 0.001} of the curve of the set "
                             "\"assumed\" of the certificate, the other states on it, the frequency "
                             "error stays at or below 0.01563 rad/sample (2.49 Hz) for ever, and at or below "
                             "0.007813 rad/sample (1.25 Hz) in the long run.") != std::string::npos);
  const Claim* slew = find(certificate, "model/largest-slew");
  REQUIRE(slew != nullptr);
  CHECK(slew->verdict == Verdict::undecided);
  CHECK(certificate.verdict == Verdict::undecided);
}

TEST_CASE("where no set was proved for the assumed noise, the reason says for which it was") {
  ModelSets sets = sets_of();
  sets.assumed = ProvedSet{};
  sets.assumed->tubes.name = "assumed";
  sets.assumed->tubes.noise = 0.3;
  sets.assumed->tubes.reasons = {"no radius was proved for noise 0.3 between 0.3 and 0.32 rad/sample"};
  sets.slew = ProvedSet{};
  sets.slew->tubes.name = "slew";
  sets.slew->tubes.reasons = {"no slew was proved"};
  const Certificate certificate = certificate_of(sets, text_of(kRequired));
  const Claim* bound = find(certificate, "model/frequency-error-bound");
  REQUIRE(bound != nullptr);
  CHECK(bound->reason ==
        "No set of tubes was proved for the whole band: no radius was proved for noise 0.3 between 0.3 and "
        "0.32 rad/sample. The largest noise at a constant frequency for which a set was proved is 0.05.");
  // A slew is told by its own set.
  const Claim* slew = find(certificate, "model/largest-slew");
  REQUIRE(slew != nullptr);
  CHECK(slew->reason == "No set of tubes was proved for the whole band: no slew was proved.");
}

TEST_CASE("what is not known, or not enough, is not proved") {
  const auto verdict = [](const ModelSets& sets, const char* id) {
    const Certificate certificate = certificate_of(sets, text_of(kRequired));
    const Claim* claim = find(certificate, id);
    return claim != nullptr ? claim->verdict : Verdict::undecided;
  };
  for (const double unknown : {static_cast<double>(INFINITY), std::nan("")}) {
    ModelSets sets = sets_of();
    sets.assumed->frequency_error = unknown;
    CHECK(verdict(sets, "model/guarantee") == Verdict::undecided);
    CHECK(verdict(sets, "model/frequency-error-bound") == Verdict::undecided);
    sets = sets_of();
    sets.assumed->start_share = unknown;
    CHECK(verdict(sets, "model/guarantee") == Verdict::undecided);
    sets = sets_of();
    sets.starts.ripple = unknown;
    CHECK(verdict(sets, "model/ripple") == Verdict::undecided);
    CHECK(verdict(sets, "model/steady-state") == Verdict::undecided);
    sets = sets_of();
    sets.assumed->reach = unknown;
    CHECK(verdict(sets, "model/frequency-error-radius") == Verdict::undecided);
  }
  ModelSets sets = sets_of();
  sets.starts.bias = Interval::empty();
  CHECK(verdict(sets, "model/bias") == Verdict::undecided);
  CHECK(verdict(sets, "model/steady-state") == Verdict::undecided);
  sets = sets_of();
  sets.starts.bias = Interval::from_bounds(-2e-5, 0.0);
  CHECK(verdict(sets, "model/bias") == Verdict::undecided);
  sets = sets_of();
  sets.assumed->start_share = 1.01;
  CHECK(verdict(sets, "model/frequency-error-bound") == Verdict::undecided);
  CHECK(verdict(sets, "model/guarantee") == Verdict::undecided);
  sets = sets_of();
  sets.assumed->tubes.is_complete = false;
  CHECK(verdict(sets, "model/frequency-error-bound") == Verdict::undecided);
  CHECK(verdict(sets, "model/guarantee") == Verdict::undecided);
  CHECK(verdict(sets, "model/largest-noise") == Verdict::proved);
  sets.noise->tubes.is_complete = false;
  CHECK(verdict(sets, "model/largest-noise") == Verdict::undecided);
  sets = sets_of();
  sets.noise->tubes.noise = 0.029;
  CHECK(verdict(sets, "model/largest-noise") == Verdict::undecided);
}

/// Proved from 0.3 to 0.3125 rad/sample only.
void limit(ProvedSet& set, double low = 0.3, double high = 0.3125) {
  set.tubes.is_complete = false;
  set.tubes.part = {low, high};
  set.tubes.reasons = {"no radius was proved between 0.3125 and 0.32 rad/sample"};
}

TEST_CASE("a part of the band has claims of its own, and what is required stays undecided") {
  ModelSets sets = sets_of();
  limit(*sets.assumed);
  limit(sets.starts, 0.3, 0.312345678);
  limit(*sets.noise, 0.301, 0.32);
  const Certificate certificate = certificate_of(sets, text_of(kRequired));
  const Claim* guarantee = find(certificate, "model/guarantee");
  REQUIRE(guarantee != nullptr);
  CHECK(guarantee->verdict == Verdict::proved);
  CHECK_FALSE(guarantee->required);
  CHECK(
      guarantee->statement.starts_with("In exact arithmetic, on a tone of amplitude 1 with any constant "
                                       "frequency in [0.3, 0.3125] rad/sample at 1000 samples per second (a "
                                       "part of the assumed band), with noise below 0.02, started"));
  const auto value = [](const Claim* claim, const std::string& name) {
    REQUIRE(claim != nullptr);
    const auto found = std::find_if(claim->values.begin(), claim->values.end(),
                                    [&](const auto& each) { return each.first == name; });
    return found != claim->values.end() ? found->second : std::string();
  };
  CHECK(value(guarantee, "from") == "0.3");
  CHECK(value(guarantee, "to") == "0.3125");
  CHECK(value(find(certificate, "model/steady-state"), "to") == "0.312345");
  // Of the widest part in which some noise is tolerated.
  CHECK(value(find(certificate, "model/limits"), "from") == "0.301");
  CHECK(value(find(certificate, "model/limits"), "to") == "0.32");
  CHECK(value(find(certificate, "model/limits"), "noise") == "0.05");
  for (const char* id : {"model/frequency-error-bound", "model/largest-noise", "model/frequency-error-radius",
                         "model/bias", "model/ripple"}) {
    CAPTURE(id);
    const Claim* claim = find(certificate, id);
    REQUIRE(claim != nullptr);
    CHECK(claim->verdict == Verdict::undecided);
    CHECK(claim->statement.find("in [0.3, 0.32] rad/sample at 1000 samples per second, ") !=
          std::string::npos);
    CHECK(claim->reason.find(" rad/sample only: no radius was proved between 0.3125 and 0.32 rad/sample.") !=
          std::string::npos);
  }
  CHECK(find(certificate, "model/frequency-error-bound")->reason.starts_with("Proved over 0.3 to 0.3125 "));
  CHECK(find(certificate, "model/bias")->reason.starts_with("Proved over 0.3 to 0.312345 "));
  CHECK(certificate.verdict == Verdict::undecided);
}

TEST_CASE("a part that is empty, or in which too little is proved, has no claims") {
  const auto has = [](const ModelSets& sets, const char* id) {
    return find(certificate_of(sets, text_of(kRequired)), id) != nullptr;
  };
  ModelSets sets = sets_of();
  limit(*sets.assumed, 0.3, 0.3);
  CHECK_FALSE(has(sets, "model/guarantee"));
  limit(*sets.assumed, 0.31, std::nan(""));
  CHECK_FALSE(has(sets, "model/guarantee"));
  limit(*sets.assumed);
  CHECK(has(sets, "model/guarantee"));
  sets.assumed->start_share = 1.1;
  CHECK_FALSE(has(sets, "model/guarantee"));
  sets = sets_of();
  limit(*sets.assumed, 0.3, 0.3);
  limit(*sets.noise, 0.31, std::nan(""));
  CHECK_FALSE(has(sets, "model/limits"));
  sets.noise->tubes.tubes.clear();
  CHECK_FALSE(has(sets, "model/limits"));
  sets.assumed.reset();
  CHECK_FALSE(has(sets, "model/limits"));
  CHECK_FALSE(has(sets, "model/slew-limit"));
  sets = sets_of();
  sets.starts.reach = sets.assumed->reach = sets.noise->reach = 0.0;  // as with a bias: of the noise alone
  const Certificate biased = certificate_of(sets, text_of(kRequired));
  REQUIRE(find(biased, "model/limits") != nullptr);
  CHECK(find(biased, "model/limits")->values.size() == 2);
  CHECK(
      find(biased, "model/limits")
          ->statement.ends_with(": a certified invariant set exists in which the frequency error stays at or "
                                "below 0.01563 rad/sample (2.49 Hz)."));
  sets.starts.ripple = INFINITY;
  CHECK_FALSE(has(sets, "model/steady-state"));
  sets = sets_of();
  limit(*sets.assumed);
  sets.assumed->frequency_error = 0.03;  // more than is required
  const Certificate certificate = certificate_of(sets, text_of(kRequired));
  CHECK(find(certificate, "model/frequency-error-bound")
            ->reason.starts_with("A set of tubes was proved over 0.3 to 0.3125 rad/sample only: "));
}

/// The value of a claim, "" where there is none, and how its statement ends.
struct Told {
  std::string noise, slew, reach, from, statement;
};
Told told(const ModelSets& sets, const char* id) {
  Told result;
  const Certificate certificate = certificate_of(sets, text_of(kRequired));
  if (const Claim* claim = find(certificate, id)) {
    for (const auto& [name, text] : claim->values) {
      if (!name.ends_with("frequency_error")) {
        (name == "noise"   ? result.noise
         : name == "slew"  ? result.slew
         : name == "reach" ? result.reach
                           : result.from) = text;
      }
    }
    result.statement = claim->statement;
  }
  return result;
}

TEST_CASE("limits are the largest that some set proves over the whole band, and name the set") {
  ModelSets sets = sets_of();
  CHECK(told(sets, "model/limits").noise == "0.05");
  CHECK(told(sets, "model/limits").statement.find("by the set") == std::string::npos);
  // A search that ends below what is assumed.
  sets.noise->tubes.noise = 0.005;
  CHECK(told(sets, "model/limits").noise == "0.02");
  CHECK(
      told(sets, "model/limits")
          .statement.find(", the tracker tolerates noise up to 0.02 (by the set \"assumed\" of the "
                          "certificate): a certified invariant set exists in which the frequency error stays "
                          "at or below 0.01563 rad/sample (2.49 Hz), and without noise a certified") !=
      std::string::npos);
  // Or that was not made, or proves it over a part only.
  limit(*sets.noise);
  sets.noise->tubes.noise = 0.5;
  CHECK(told(sets, "model/limits").noise == "0.02");
  CHECK(told(sets, "model/limits").from.empty());
  sets.noise.reset();
  CHECK(told(sets, "model/limits").noise == "0.02");
  // How far sets reach: a set for some noise is one without, and the widest counts.
  CHECK(told(sets, "model/limits").reach == "0.005");
  sets.assumed->reach = 0.0625;
  CHECK(told(sets, "model/limits").reach == "0.0625");
  limit(sets.starts);
  sets.starts.reach = 0.25;
  CHECK(told(sets, "model/limits").reach == "0.0625");
  // Of equal ones, the one that was made for it.
  sets.noise = set_of("noise", 0.02, 0.0);
  CHECK(told(sets, "model/limits").statement.find("by the set") == std::string::npos);
  for (const double unknown : {static_cast<double>(INFINITY), std::nan("")}) {
    sets.noise->tubes.noise = unknown;
    CHECK(told(sets, "model/limits").noise == "0.02");
    sets.noise->reach = unknown;
    CHECK(told(sets, "model/limits").reach == "0.0625");
  }
  sets.objection = "the assumed frequencies are no band";
  CHECK(told(sets, "model/limits").statement.empty());
}

TEST_CASE("what is said of lock is said of sets that exclude other locks") {
  ModelSets sets = sets_of();
  const auto claims_of = [](const ModelSets& of) { return certificate_of(of, text_of(kRequired)); };
  const Certificate locked = claims_of(sets);
  for (const char* id : {"model/largest-noise", "model/frequency-error-radius"}) {
    const Claim& claim = *find(locked, id);
    CHECK(claim.verdict == Verdict::proved);
    CHECK(claim.requirement.find(
              "in which the frequency error stays at or below 0.01563 rad/sample (2.49 Hz)") !=
          std::string::npos);
    REQUIRE(claim.values.size() == 1);
    CHECK(claim.values[0] == std::pair<std::string, std::string>("frequency_error", "0.01563"));
  }
  // The set for the largest noise is none; that for the assumed one is.
  sets.noise->half_distance = 0.0156;
  CHECK(told(sets, "model/limits").noise == "0.02");
  sets.noise->half_distance = 0.25;
  sets.noise->frequency_error = INFINITY;
  CHECK(told(sets, "model/limits").noise == "0.02");
  sets.assumed->half_distance = 0.0078125;
  CHECK(told(sets, "model/limits").noise.empty());
  const Certificate certificate = claims_of(sets);
  CHECK(find(certificate, "model/largest-noise")->reason ==
        "A set was proved. Its frequency is not defined everywhere in it: no lock can be named.");
  const Claim& radius = *find(certificate, "model/frequency-error-radius");
  CHECK(radius.verdict == Verdict::undecided);
  CHECK(radius.values.empty());
  CHECK(radius.requirement ==
        "a certified invariant set contains frequency errors up to 0.004 rad/sample at every phase");
  CHECK(radius.reason ==
        "The certified set reaches 0.005 rad/sample. Its frequency error may reach 0.01563 rad/sample, and "
        "from 0.007812 rad/sample on it may be nearer to a false lock: no lock can be named.");
  // Its error is bounded all the same.
  CHECK(find(certificate, "model/guarantee") != nullptr);
}

TEST_CASE("the largest slew is that of any set for a slew, with the noise of that set") {
  ModelSets sets = sets_of();
  CHECK(told(sets, "model/slew-limit").statement.empty());
  sets.assumed = set_of("assumed", 0.02, 0x1p-20);
  sets.slew = ProvedSet{};
  sets.slew->tubes.name = "slew";
  const Told of_assumed = told(sets, "model/slew-limit");
  CHECK(of_assumed.slew == "9.536e-7");
  CHECK(of_assumed.noise == "0.02");
  CHECK(of_assumed.statement.find(
            "with a frequency that stays in [0.3, 0.32] rad/sample at 1000 samples per second, with noise of "
            "at most 0.02, the tracker tolerates a slew up to 9.536e-7 rad/sample per sample (0.151 Hz per "
            "second) (by the set \"assumed\" of the certificate): a certified invariant set exists in which "
            "the frequency error stays at or below 0.01563 rad/sample (2.49 Hz).") != std::string::npos);
  sets.slew = set_of("slew", 0.0, 0x1p-18);
  const Told of_search = told(sets, "model/slew-limit");
  CHECK(of_search.slew == "3.814e-6");
  CHECK(of_search.noise.empty());
  CHECK(of_search.statement.find(" per second, without noise, the tracker tolerates a slew up to ") !=
        std::string::npos);
  CHECK(of_search.statement.find("by the set") == std::string::npos);
  // A part of it is not in the certificate.
  limit(*sets.slew);
  CHECK(told(sets, "model/slew-limit").slew == "9.536e-7");
  limit(*sets.assumed);
  CHECK(told(sets, "model/slew-limit").from == "0.3125");  // to, the last
  sets.slew->tubes.noise = 1.0;
  sets.noise.reset();
  CHECK(told(sets, "model/limits").noise == "0.02");
}

TEST_CASE("a loop is certified for its design") {
  const Certificate& certificate = test::loop_certificate();
  CHECK(certificate.verdict == Verdict::proved);
  const ModelSets& sets = model_sets(certificate);
  CHECK(sets.objection.empty());
  CHECK(sets.starts.is_proved());
  REQUIRE(sets.assumed.has_value());
  CHECK(sets.assumed->tubes.noise >= 0.02);
  CHECK(sets.assumed->start_share <= 1.0);
  CHECK_FALSE(sets.noise.has_value());
}

TEST_CASE("units of frequency and slew") {
  const rigor::UpwardRounding upward;
  std::string text = test::kLoopText;
  text.replace(text.find("frequency = [0.3, 0.32]"), 23,
               "slew = { hz_per_second = 5 }\nfrequency = { hz = [50, 51] }");
  const Design design = test::loop_design(text);
  const ModelAssumptions& assume = model_tables(design).assume;
  const Interval band = band_of(assume);
  CHECK(band.lower() <= 2.0 * M_PI * 0.05);
  CHECK(band.upper() >= 2.0 * M_PI * 0.051);
  CHECK(band.upper() - band.lower() < 2.0 * M_PI * 0.001 + 1e-14);
  CHECK(slew_of(assume).upper() >= 2.0 * M_PI * 5e-6 * (1.0 - 1e-15));
  CHECK(slew_of(assume).upper() <= 2.0 * M_PI * 5e-6 * (1.0 + 1e-14));
}

}  // namespace
}  // namespace veritrack::certificates
