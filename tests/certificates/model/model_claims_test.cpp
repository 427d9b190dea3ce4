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
ModelSet set_of(const char* name, double noise, double slew) {
  ModelSet set;
  set.tubes.name = name;
  set.tubes.noise = noise;
  set.tubes.slew = slew;
  set.tubes.is_complete = true;
  model::ProvedTube proved;
  proved.levels = {0.01, 0.005};
  proved.shrinking = {0.99};
  set.tubes.tubes = {proved};
  set.frequency_error = 0.015625;
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
                             "error stays at or below 0.01563 rad/sample for ever, and at or below 0.007813 "
                             "rad/sample in the long "
                             "run.") != std::string::npos);
  const Claim* slew = find(certificate, "model/largest-slew");
  REQUIRE(slew != nullptr);
  CHECK(slew->verdict == Verdict::undecided);
  CHECK(certificate.verdict == Verdict::undecided);
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
