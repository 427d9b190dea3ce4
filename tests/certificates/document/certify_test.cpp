#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "certificates/quadrature/guarantee.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"
#include "tests/certificates/test_design.hpp"

namespace {

using namespace veritrack;
using rigor::Verdict;

const certificates::Claim& find_claim(const certificates::Certificate& certificate, const std::string& id) {
  const auto found = std::find_if(certificate.claims.begin(), certificate.claims.end(),
                                  [&](const certificates::Claim& claim) { return claim.id == id; });
  REQUIRE(found != certificate.claims.end());
  return *found;
}

TEST_CASE("nothing required is no verdict") {
  const certificates::Certificate certificate = test::certificate();
  CHECK_FALSE(certificate.verdict.has_value());
  CHECK(certificates::verdict_text(certificate) == "nothing-required");
  CHECK(certificates::derivations_of(certificate, "theorem-2.9/").size() == 3);
  CHECK(certificates::derivations_of(certificate, "contraction").size() == 1);
  CHECK(certificates::derivations_of(certificate, "reif-1999").size() == 2);
  CHECK(certificates::quadrature_particulars(certificate).audits.size() == 2);
}

TEST_CASE("contraction proves what is required where it can") {
  const auto certificate = test::certificate(
      {{"[require]", "[require]\nfrequency_error_below = 0.05\nsettles_within = 20\nsettled_below = 0.01"}});
  CHECK(certificate.verdict == Verdict::proved);
  CHECK(certificates::proved_frequency_bound(certificate)->upper() < 0.05);
  for (const char* id : {"ekf/frequency-error-bound", "ekf/settling-time"}) {
    const certificates::Claim& claim = find_claim(certificate, id);
    CHECK(claim.verdict == Verdict::proved);
    CHECK_FALSE(claim.evidence.empty());
  }
}

TEST_CASE("a proved bound is not broken by the simulated run") {
  const auto certificate = test::certificate({{"samples = 60", "samples = 3000"}});
  const auto bound = certificates::proved_frequency_bound(certificate);
  REQUIRE(bound.has_value());
  for (const auto& record : certificate.simulation.trajectory) {
    CHECK(std::fabs(record.filtered_state[2] - record.true_state[2]) <= bound->upper());
  }
}

TEST_CASE("what contraction does not cover is undecided, with the reason" * doctest::test_suite("nightly")) {
  const std::pair<std::string, std::string> require{
      "[require]", "[require]\nfrequency_error_below = 0.05\nsettles_within = 20\nsettled_below = 0.01"};
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"noise = 0.001", "noise = 0.5"},
           {"slew = 0.0", "slew = 0.5"},
           {"initial_frequency_error = 0.005", "initial_frequency_error = 0.04999"},
           {"epsilon = 0.0", "epsilon = 0.01"},
           {"q1 = 0.0023", "q1 = 0"}}) {
    const auto certificate = test::certificate({require, {from, to}});
    CHECK_MESSAGE(certificate.verdict == Verdict::undecided, to);
    for (const char* id : {"ekf/frequency-error-bound"}) {
      const certificates::Claim& claim = find_claim(certificate, id);
      CHECK(claim.required);
      CHECK(claim.verdict == Verdict::undecided);
      CHECK_FALSE(claim.reason.empty());
      CHECK(claim.position.line > 0);
    }
  }
}

TEST_CASE("the sizes of certified sets can be required, with the largest certified one in the answer" *
          doctest::test_suite("nightly")) {
  struct Case {
    const char* claim;
    const char* key;
    const char* quantity;
    double amplitude;  // noise is required in signal units and certified relative to the amplitude
  };
  for (const Case& each : {Case{"ekf/largest-noise", "largest_noise_at_least", "largest_noise", 2.0},
                           Case{"ekf/largest-slew", "largest_slew_at_least", "largest_slew", 1.0},
                           Case{"ekf/frequency-error-radius", "frequency_error_radius_at_least",
                                "frequency_error_radius", 1.0}}) {
    CAPTURE(each.key);
    const auto required = [&](double value) {
      return test::certificate({{"amplitude = 1.0", fmt::format("amplitude = {}", each.amplitude)},
                                {"[require]", fmt::format("[require]\n{} = {}", each.key, value)}});
    };
    const auto generous = required(1.0);
    CHECK(generous.verdict == Verdict::undecided);
    CHECK(find_claim(generous, each.claim).reason.find("; 1 was required") != std::string::npos);
    const double certified =
        each.amplitude *
        theorems::find_quantity(*certificates::find_derivation(generous, "contraction"), each.quantity)
            .value.lower();
    CHECK(required(0.999 * certified).verdict == Verdict::proved);
    CHECK(required(1.001 * certified).verdict == Verdict::undecided);
  }
  const auto uncontrollable = test::certificate(
      {{"q1 = 0.0023", "q1 = 0"}, {"[require]", "[require]\nlargest_noise_at_least = 1e-9"}});
  CHECK(uncontrollable.verdict == Verdict::undecided);
}

TEST_CASE("starts beyond the certified set are followed into it") {
  const auto certificate = test::certificate(
      {{"[require]", "[require]\nfrequency_error_below = 0.5\nsettles_within = 200\nsettled_below = 0.1"},
       {"initial_frequency_error = 0.005", "initial_frequency_error = 0.3"},
       {"initial_phase_error = 0.005", "initial_phase_error = 0.4"}});
  CHECK(certificate.verdict == Verdict::proved);
  CHECK(certificate.derivations.back().id == "capture");
  CHECK(find_claim(certificate, "ekf/capture").verdict == Verdict::proved);
  const auto bound = certificates::proved_frequency_bound(certificate);
  REQUIRE(bound.has_value());
  CHECK(bound->upper() >= 0.3);
  REQUIRE(certificates::quadrature_particulars(certificate).followed_starts.has_value());
  for (const auto& record : certificate.simulation.trajectory) {
    CHECK(std::fabs(record.filtered_state[2] - record.true_state[2]) <= bound->upper());
  }
}

TEST_CASE("a start that locks a turn off refutes every bound below that") {
  const auto certificate =
      test::certificate({{"[require]", "[require]\nfrequency_error_below = 6.05"},
                         {"initial_frequency_error = 0.005", "initial_frequency_error = 6.0"}});
  CHECK(find_claim(certificate, "ekf/capture").verdict == Verdict::refuted);
  CHECK(certificate.verdict == Verdict::refuted);
}

TEST_CASE("a bound that the assumed start does not keep is refuted") {
  for (const char* bound : {"0.004", "0.005", "0.0050", "5e-3", "1e-300"}) {
    const auto certificate =
        test::certificate({{"[require]", std::string("[require]\nfrequency_error_below = ") + bound}});
    CHECK_MESSAGE(
        certificate.verdict == (std::string(bound) == "0.0050" || std::string(bound) == "5e-3"
                                    ? Verdict::undecided  // the same number, which texts do not show
                                    : Verdict::refuted),
        bound);
  }
  const auto above = test::certificate({{"[require]", "[require]\nfrequency_error_below = 0.0051"}});
  CHECK(above.verdict == Verdict::undecided);
}

TEST_CASE("the theorem is evaluated at amplitude 1") {
  // q1, r, noise and start error at amplitude 2 that are those of the unit design: powers of 2 scale exactly.
  const auto unit = test::certificate({{"0.0023\nq2", "0.25\nq2"}, {"r = 0.05", "r = 0.5"}});
  const auto scaled =
      test::certificate({{"0.0023\nq2", "1.0\nq2"},
                         {"r = 0.05", "r = 2.0"},
                         {"amplitude = 1.0", "amplitude = 2.0"},
                         {"noise = 0.001", "noise = 0.002"},
                         {"initial_amplitude_error = 0.005", "initial_amplitude_error = 0.010"}});
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& expected = unit.derivations[i].quantities;
    const auto& found = scaled.derivations[i].quantities;
    REQUIRE(expected.size() == found.size());
    for (std::size_t j = 0; j < expected.size(); ++j) {
      CHECK_MESSAGE(rigor::identical(expected[j].value, found[j].value), expected[j].name);
    }
    CHECK(scaled.derivations[i].notes.size() == unit.derivations[i].notes.size() + 1);
  }
}

}  // namespace
