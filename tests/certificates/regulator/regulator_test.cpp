#include "certificates/regulator/regulator.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/document/markdown.hpp"
#include "certificates/regulator/regulator_simulation.hpp"
#include "reports/figures.hpp"
#include "tests/support/golden.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"
#include "trackers/regulator/frequency_regulator.hpp"

namespace {

using namespace veritrack;
using namespace veritrack::certificates;
using rigor::Verdict;

std::string design_text() {
  return test::read_file(VERITRACK_SOURCE_DIR "/tests/certificates/regulator.toml");
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), with);
}

Certificate certificate_of(const std::string& text) {
  return certify(read_design(text, "regulator.toml"), "regulator.toml", text);
}

const Certificate& certificate() {
  static const Certificate found = certificate_of(design_text());
  return found;
}

const Claim& claim_of(const Certificate& found, const std::string& id) {
  const auto claim =
      std::find_if(found.claims.begin(), found.claims.end(), [&](const Claim& one) { return one.id == id; });
  REQUIRE(claim != found.claims.end());
  return *claim;
}

double upper(const char* name) {
  return find_quantity(certificate().derivations.back(), name).value.upper();
}

std::string message_of(const std::string& text) {
  try {
    (void)read_design(text, "x.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE(
    "the sentence begins with the tracker's guarantee, word for word, and names what the regulator rests "
    "on") {
  const Claim& guarantee = claim_of(certificate(), "regulator/guarantee");
  CHECK(guarantee.verdict == Verdict::proved);
  const Claim& tracker = claim_of(regulator_particulars(certificate()).tracker, "ekf/guarantee");
  CHECK(guarantee.statement.starts_with(tracker.statement + " A regulator"));
  for (const char* words : {"A1 = 1 - 1.2 q^-1 + 0.45 q^-2 and B1 = 0.5 - 0.2 q^-1", "known exactly",
                            "at rest at sample 0", "whose own sums are exact", "it sees y with that noise",
                            "the same in both channels", "between 0.2 and 0.5 rad/sample"}) {
    CHECK_MESSAGE(guarantee.statement.find(words) != std::string::npos, words);
  }
  CHECK(*certificate().verdict == Verdict::proved);
  CHECK(claim_of(certificate(), "regulator/frequency-tracker").statement ==
        claim_of(regulator_particulars(certificate()).tracker, "ekf/settling-time").statement);
}

TEST_CASE(
    "the loop with the tracker itself stays below what is proved, from the corners of the assumed starts") {
  constexpr std::array kFrequencies{0.2, 0.35, 0.5};
  const double ever = upper("output_bound");
  const double settled = upper("settled_output");
  const double from = upper("settling_samples");
  const double input_bound = upper("input_bound");
  const rigor::NearestRounding nearest;
  trackers::PlantModel<double, 2> model;
  model.a << -1.2, 0.45;
  model.b << 0.5, -0.2;
  // M of the sentence.
  Eigen::Matrix3d covariance;
  covariance << 0.0096353, 0, 0, 0, 0.03095, 0.0066192, 0, 0.0066192, 0.0053772;
  REQUIRE(claim_of(certificate(), "regulator/guarantee")
              .statement.find("M = [0.0096353, 0, 0; 0, 0.03095, "
                              "0.0066192; 0, 0.0066192, 0.0053772]") != std::string::npos);
  test::Random random(4403);
  double closest = 0.0;
  for (int run = 0; run < 24; ++run) {
    const double amplitude = 2.0;
    double frequency = kFrequencies[static_cast<std::size_t>(run % 3)];
    double phase = random.uniform(-3.0, 3.0);
    const double start_phase = phase + (run % 2 == 0 ? 0.005 : -0.005);
    const double start_amplitude = amplitude + (run % 4 < 2 ? 0.005 : -0.005);
    const auto turned = trackers::turned(trackers::FactoredCovariance<double>::from_matrix(covariance),
                                         std::sin(start_phase), std::cos(start_phase));
    trackers::QuadratureEkf<double> tracker(
        {0.0023, 0.0023, 0.05, 0.0},
        {start_amplitude * std::cos(start_phase), start_amplitude * std::sin(start_phase),
         frequency + (run % 8 < 4 ? 0.005 : -0.005), turned});
    std::array<trackers::Plant<double, 2>, 2> plants{trackers::Plant<double, 2>(model),
                                                     trackers::Plant<double, 2>(model)};
    std::array<trackers::Plant<double, 2>, 2> known = plants;
    std::array<trackers::FrequencyRegulator<double, 2>, 2> regulators{
        trackers::FrequencyRegulator<double, 2>(model), trackers::FrequencyRegulator<double, 2>(model)};
    std::array<double, 2> input{};
    for (int k = 0; k < 400; ++k) {
      const double turn = random.uniform(0.0, 6.28);
      const std::array v{amplitude * std::cos(phase), amplitude * std::sin(phase)};
      const std::array noise{0.0019999 * std::cos(turn), 0.0019999 * std::sin(turn)};
      std::array<double, 2> output{}, seen{};
      for (std::size_t i = 0; i < 2; ++i) {
        output.at(i) = plants.at(i).step(input.at(i)) + v.at(i);
        seen.at(i) = output.at(i) + noise.at(i) - known.at(i).step(input.at(i));
      }
      if (k > 0) {
        tracker.step(seen[0], seen[1]);
      }
      for (std::size_t i = 0; i < 2; ++i) {
        input.at(i) = regulators.at(i).step(output.at(i) + noise.at(i),
                                            [&](double /*v*/) { return tracker.filtered().frequency; });
      }
      const double length = std::hypot(output[0], output[1]);
      REQUIRE(length <= ever);
      REQUIRE(std::hypot(input[0], input[1]) <= input_bound);
      if (k >= from) {
        REQUIRE(length <= settled);
        closest = std::max(closest, length / settled);
      }
      phase += frequency;
      frequency = std::min(0.5, std::max(0.2, frequency + 0.00000999 * (k % 200 < 100 ? 1.0 : -1.0)));
    }
  }
  CHECK(closest > 0.2);
}

TEST_CASE("the simulated loops of the figure stay below the bounds, too, and the document shows them") {
  const auto runs = simulate_closed_loop(certificate());
  REQUIRE(runs.size() == 3);
  for (const ClosedLoopRun& run : runs) {
    REQUIRE(run.output.size() == 1000);
    CHECK(*std::max_element(run.output.begin(), run.output.end()) <= upper("output_bound"));
    CHECK(*std::max_element(run.output.begin() + 100, run.output.end()) <= upper("settled_output"));
    CHECK(*std::max_element(run.disturbance.begin(), run.disturbance.end()) == doctest::Approx(2.0));
  }
  const std::string document = to_markdown(certificate(), {});
  CHECK(document.find("## The frequency tracker\n") != std::string::npos);
  CHECK(document.find("\n### ") != std::string::npos);
}

TEST_CASE("where the tracker promises nothing, nothing is claimed, and the reason says so") {
  std::string text = replaced(design_text(), "noise = 0.002", "noise = { snr_db = 30 }\nsamples = 1e6");
  text =
      replaced(text, "[design.frequency_tracker.require]\nsettles_within = 100\nsettled_below = 0.003\n", "");
  text = replaced(text, "slew = 0.00001\n", "");
  const Certificate gaussian = certificate_of(text);
  CHECK(*gaussian.verdict == Verdict::undecided);
  CHECK(claim_of(gaussian, "regulator/guarantee").verdict == Verdict::undecided);
  CHECK(claim_of(gaussian, "regulator/attenuation").reason.find("Gaussian") != std::string::npos);
  CHECK(simulate_closed_loop(gaussian).empty());
}

TEST_CASE("a plant that cannot be regulated: which of its polynomials it is") {
  // Of a tracker that has no certified set, which is found out fast.
  const std::string text = replaced(design_text(), "q1 = 0.0023", "q1 = 0");
  const std::string unstable = replaced(text, "a = [-1.2, 0.45]", "a = [-1.2, 1]");
  CHECK(claim_of(certificate_of(unstable), "regulator/attenuation").reason.find("the plant is unstable") !=
        std::string::npos);
  const std::string inverse = replaced(text, "b = [0.5, -0.2]", "b = [0.5, 0.6]");
  CHECK(claim_of(certificate_of(inverse), "regulator/attenuation").reason.find("the input would grow") !=
        std::string::npos);
}

TEST_CASE("bad design files: where, and what is allowed") {
  CHECK(message_of(replaced(design_text(), "b = [0.5, -0.2]", "b = [0.5]")).find("as many of each") !=
        std::string::npos);
  CHECK(message_of(replaced(design_text(), "b = [0.5, -0.2]", "b = [0, -0.2]")).find("b_0 not 0") !=
        std::string::npos);
  CHECK(
      message_of(replaced(design_text(), "attenuation_above = 30\n", "")).find("attenuated_within without") !=
      std::string::npos);
  CHECK(message_of(replaced(design_text(), "q1 = 0.0023", "q3 = 0.0023"))
            .find("x.toml:12:1: in [design.frequency_tracker]: unknown key design.q3") != std::string::npos);
  CHECK(message_of(replaced(design_text(), "tracker = \"quadrature-ekf\"", "tracker = \"oracle\""))
            .find("in [design.frequency_tracker]: tracker is \"oracle\"") != std::string::npos);
  const std::string within = message_of(
      "name = 'x'\ntracker = 'vibration-regulator'\n[plant]\na = [0]\nb = [1]\n[design.frequency_tracker]\n"
      "tracker = 'kkl-observer'\n[design.frequency_tracker.design]\nlambda = [1, 2, 3, 4]\n"
      "[design.frequency_tracker.assume]\nfrequency = [2, 4]\namplitude = [1, 1]\n");
  CHECK(within.find("allowed: a table with a design of quadrature-ekf, single-channel-ekf or model") !=
        std::string::npos);
}
