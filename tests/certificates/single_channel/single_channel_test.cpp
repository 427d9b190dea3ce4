#include "certificates/single_channel/single_channel.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/document/json.hpp"
#include "certificates/document/markdown.hpp"
#include "certificates/single_channel/single_channel_design.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"

namespace {

using namespace veritrack;
using certificates::Certificate;
using rigor::Interval;
using rigor::Verdict;

std::string text_of(const std::string& design, const std::string& assume, const std::string& require = "") {
  return "name = \"a design\"\ntracker = \"single-channel-ekf\"\n[design]\n" + design +
         "\n[assume]\nfrequency = 0.9\nnoise = 0.01\ninitial_frequency_error = 0.01\n"
         "initial_phase_error = 0.01\ninitial_amplitude_error = 0.01\n" +
         assume + "\n[require]\n" + require + "\n[simulate]\nsamples = 300\n";
}

constexpr const char* kExample1 = "q = 0.005\nr = 0.01\nepsilon = 0.05\nprocess_noise = \"identity\"";

certificates::SingleChannelDesignTable design_of(const std::string& design) {
  return certificates::single_channel_tables(certificates::read_design(text_of(design, ""), "d.toml")).design;
}

Certificate certificate_of(const std::string& design, const std::string& assume = "",
                           const std::string& require = "") {
  const std::string text = text_of(design, assume, require);
  return certificates::certify(certificates::read_design(text, "d.toml"), "d.toml", text);
}

Verdict verdict_of(const Certificate& certificate, const std::string& id) {
  const auto found = std::find_if(certificate.claims.begin(), certificate.claims.end(),
                                  [&](const certificates::Claim& claim) { return claim.id == id; });
  REQUIRE(found != certificate.claims.end());
  return found->verdict;
}

TEST_CASE("the readings of the process noise") {
  const auto identity = nearest_values(design_of(kExample1));
  CHECK(identity.q1 == 0.005);
  CHECK(identity.q2 == 0.005);
  CHECK(identity.r == 0.01);
  CHECK(identity.epsilon == 0.05);
  const auto printed = nearest_values(design_of("q = 0.005\nr = 0.01\nprocess_noise = \"frequency-only\""));
  CHECK(printed.q1 == 0.0);
  CHECK(printed.q2 == 0.005);
  CHECK(printed.epsilon == 0.0);
  const auto diagonal = nearest_values(design_of("r = 0.01\nprocess_noise = { q1 = 0.1, q2 = 0.2 }"));
  CHECK(diagonal.q1 == 0.1);
  CHECK(diagonal.q2 == 0.2);
  const auto ratio = nearest_values(design_of("lambda = 10\nprocess_noise = \"identity\""));
  CHECK(ratio.q1 == 1.0);
  CHECK(ratio.r == 10.0);
  const rigor::UpwardRounding upward;
  for (const char* design : {kExample1, "lambda = 0\nprocess_noise = \"frequency-only\"",
                             "r = 0.01\nprocess_noise = { q1 = 0.1, q2 = 0.2 }"}) {
    const auto nearest = nearest_values(design_of(design));
    const auto enclosed = enclosed_values(design_of(design));
    CHECK(rigor::contains(enclosed.q1, nearest.q1));
    CHECK(rigor::contains(enclosed.q2, nearest.q2));
    CHECK(rigor::contains(enclosed.r, nearest.r));
    CHECK(rigor::contains(enclosed.epsilon, nearest.epsilon));
  }
}

TEST_CASE("keys of [design] that do not go together are refused, with their place") {
  for (const char* design :
       {"q = 0.005\nprocess_noise = \"identity\"", "r = 0.01\nprocess_noise = \"identity\"",
        "lambda = 1\nr = 0.01\nprocess_noise = \"identity\"",
        "q = 1\nr = 1\nprocess_noise = { q1 = 0.1, q2 = 0.2 }",
        "lambda = 1\nprocess_noise = { q1 = 0.1, q2 = 0.2 }"}) {
    CAPTURE(design);
    CHECK_THROWS_WITH_AS(design_of(design), doctest::Contains("d.toml:3:1: the keys of [design]"),
                         certificates::InputError);
  }
  for (const char* noise : {"\"other\"", "3", "{ q1 = 0.1 }", "{ q1 = 0.1, q3 = 0.2 }",
                            "{ q1 = 0.1, q2 = 0.2, q3 = 0.3 }", "{ q1 = 0.1, q2 = -0.2 }"}) {
    CAPTURE(noise);
    CHECK_THROWS_WITH_AS(design_of(std::string("q = 1\nr = 1\nprocess_noise = ") + noise),
                         doctest::Contains("design.process_noise"), certificates::InputError);
  }
}

TEST_CASE("with a leak the bias is a number, and Proposition 1 holds in both directions") {
  const Certificate certificate = certificate_of(kExample1);
  CHECK_FALSE(certificate.verdict.has_value());
  const auto biases = certificates::derivations_of(certificate, "single-channel-bias");
  REQUIRE(biases.size() == 1);
  CHECK(biases.front().verdict == Verdict::proved);
  const Interval mean = find_quantity(biases.front(), "mean_bias").value;
  const Interval smallest = find_quantity(biases.front(), "min_error").value;
  const Interval largest = find_quantity(biases.front(), "max_error").value;
  CHECK(smallest.upper() < mean.lower());
  CHECK(mean.upper() < largest.lower());
  CHECK(largest.upper() < 0.0);
  CHECK(find_quantity(biases.front(), "quadrature_bias").value.upper() < 0.0);
  CHECK(verdict_of(certificate, "proposition-1/if") == Verdict::proved);
  CHECK(verdict_of(certificate, "proposition-1/only-if") == Verdict::proved);
  CHECK(verdict_of(certificate, "proposition-2/scaled-start") == Verdict::proved);
  CHECK(certificates::headline(certificate) == "Nothing is required of this design");
}

TEST_CASE("without a leak there is none; a band has its bias at nine frequencies") {
  const std::string band = text_of("q = 0.005\nr = 0.01\nprocess_noise = \"identity\"", "");
  std::string text = band;
  text.replace(text.find("frequency = 0.9"), 15, "frequency = [0.6, 2.2]");
  const Certificate certificate =
      certificates::certify(certificates::read_design(text, "d.toml"), "d.toml", text);
  const auto biases = certificates::derivations_of(certificate, "single-channel-bias");
  CHECK(biases.size() == 9);
  for (const auto& bias : biases) {
    CHECK(bias.verdict == Verdict::proved);
    CHECK(find_quantity(bias, "mean_bias").value == Interval(0.0));
  }
  CHECK(verdict_of(certificate, "proposition-1/if") == Verdict::proved);
}

TEST_CASE("frequency-only process noise without a leak has no exponentially stable steady state") {
  const Certificate certificate = certificate_of("q = 0.005\nr = 0.01\nprocess_noise = \"frequency-only\"");
  CHECK(verdict_of(certificate, "single-channel/exponentially-stable-steady-state") == Verdict::refuted);
  CHECK(verdict_of(certificate, "proposition-1/if") == Verdict::undecided);
  const auto biases = certificates::derivations_of(certificate, "single-channel-bias");
  CHECK(biases.front().verdict == Verdict::undecided);
  CHECK(find_quantity(biases.front(), "mean_bias").not_applicable.has_value());
}

TEST_CASE("what is required is undecided, never a silent success") {
  const Certificate certificate = certificate_of(kExample1, "",
                                                 "frequency_error_below = 0.5\nsettles_within = "
                                                 "100\nsettled_below = 0.1\nlargest_noise_at_least = 1e-9");
  CHECK(certificate.verdict == Verdict::undecided);
  CHECK(verdict_of(certificate, "ekf/frequency-error-bound") == Verdict::undecided);
  CHECK(verdict_of(certificate, "ekf/settling-time") == Verdict::undecided);
}

TEST_CASE(
    "the simulated run settles within the enclosed error, and stops at an innovation without variance") {
  const auto tables = certificates::read_design(text_of(kExample1, "amplitude = 2.0"), "d.toml");
  const certificates::Simulation simulation =
      simulate_single_channel(certificates::single_channel_tables(tables));
  REQUIRE(simulation.trajectory.size() == 300);
  CHECK(simulation.trajectory.front().filtered_state(2) == doctest::Approx(0.91));
  CHECK(std::fabs(simulation.trajectory.back().filtered_state(2) - 0.9) < 0.25);
  const auto certain = certificates::read_design(
      text_of("lambda = 0\nprocess_noise = \"frequency-only\"",
              "initial_covariance = [[1e-300, 0, 0], [0, 1e-300, 0], [0, 0, 1e-300]]"),
      "d.toml");
  CHECK_NOTHROW(simulate_single_channel(certificates::single_channel_tables(certain)));
}

TEST_CASE("the documents hold the same bytes for the same design") {
  const Certificate once = certificate_of(kExample1);
  const Certificate twice = certificate_of(kExample1);
  CHECK(certificates::to_json(once) == certificates::to_json(twice));
  CHECK(certificates::to_markdown(once, {}) == certificates::to_markdown(twice, {}));
  CHECK(nlohmann::json::parse(certificates::to_json(once))["design"]["design"]["process_noise"] ==
        "identity");
}

}  // namespace
