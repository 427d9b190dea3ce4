// The single-channel tracker as a recursion of the tracker "model", and what its certificate is used for.
#include "certificates/single_channel/recursion_part.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/document/json.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "certificates/model/model.hpp"
#include "certificates/single_channel/markdown_single_channel.hpp"
#include "certificates/single_channel/single_channel.hpp"
#include "tests/support/random.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"
#include "trackers/single_channel/single_channel_rotating_frame.hpp"

namespace veritrack::certificates {
namespace {

using rigor::Verdict;

Design design_of(const std::string& chosen, const std::string& assume, const std::string& require = "",
                 const std::string& off = "0.01") {
  return read_design("name = \"a design\"\ntracker = \"single-channel-ekf\"\n[design]\n" + chosen +
                         "\n[assume]\n" + assume + "\ninitial_frequency_error = " + off +
                         "\ninitial_phase_error = " + off + "\ninitial_amplitude_error = " + off +
                         "\n[require]\n" + require + "\n[simulate]\nsamples = 10\n",
                     "d.toml");
}

Design recursion_of(const Design& design, const RecursionQuestion& question = {}) {
  const rigor::UpwardRounding upward;
  return read_design(recursion_design_text(single_channel_tables(design), question), "recursion");
}

constexpr const char* kChosen = "q = 0.005\nr = 0.01\nepsilon = 0.05\nprocess_noise = \"identity\"";
constexpr const char* kAssumed = "frequency = [0.4, 2.6]\nnoise = 0.01\namplitude = 2";

TEST_CASE("the recursion is the tracker: a step from random states") {
  constexpr double kTolerance = 1e-12;  // of doubles that are added in another order
  test::Random random(1601);
  for (const char* chosen : {kChosen, "lambda = 10\nprocess_noise = \"identity\"",
                             "r = 0.02\nepsilon = 0.3\nprocess_noise = { q1 = 0.001, q2 = 0.004 }",
                             "q = 0.005\nr = 0.01\nepsilon = 0.01\nprocess_noise = \"frequency-only\""}) {
    CAPTURE(chosen);
    const Design design = design_of(chosen, kAssumed);
    const Design recursion = recursion_of(design);
    const Model model = [&] {
      const rigor::UpwardRounding upward;
      return make_model(model_tables(recursion).model, {});
    }();
    const auto tracker =
        trackers::single_channel_design(nearest_values(single_channel_tables(design).design));
    for (std::int64_t trial = 0; trial < test::effort(100); ++trial) {
      Eigen::Matrix3d root;
      Eigen::Vector3d x;
      for (Eigen::Index i = 0; i < 3; ++i) {
        x[i] = random.uniform(-2.0, 2.0);
        for (Eigen::Index j = 0; j < 3; ++j) {
          root(i, j) = random.uniform(-0.3, 0.3);
        }
      }
      const Eigen::Matrix3d p = root * root.transpose() + 0.01 * Eigen::Matrix3d::Identity();
      const double y = random.uniform(-2.0, 2.0);
      trackers::SingleChannelEkf<double> expected(
          tracker, {x[0], x[1], x[2], trackers::FactoredCovariance<double>::from_matrix(p)});
      expected.step(y);
      std::vector<double> inputs;
      for (const auto& constant : model.constants) {
        inputs.push_back(constant.nearest);
      }
      for (const double value : {x[0], x[1], x[2], p(0, 0), p(0, 1), p(0, 2), p(1, 1), p(1, 2), p(2, 2), y}) {
        inputs.push_back(value);
      }
      std::vector<double> registers;
      std::vector<double> next(model.states.size());
      model.step.program.run(std::span<const double>(inputs), registers, std::span(next));
      const auto& after = expected.filtered();
      const Eigen::Matrix3d q = after.covariance.matrix();
      const std::vector<double> wanted{after.in_phase, after.quadrature, after.frequency, q(0, 0), q(0, 1),
                                       q(0, 2),        q(1, 1),          q(1, 2),         q(2, 2)};
      REQUIRE(next.size() == wanted.size());
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        CHECK(std::fabs(next[i] - wanted[i]) <= kTolerance);
      }
    }
  }
}

TEST_CASE("the recursion has the amplitude, the noise and the band, and what it is asked") {
  const Design design = design_of(kChosen, kAssumed, "largest_noise_at_least = 0.002");
  const ModelTables& told = model_tables(recursion_of(design));
  CHECK(told.assume.one_amplitude);
  CHECK(told.assume.amplitude[0].text == "2");
  CHECK(told.assume.noise.text == "0.01");
  CHECK(told.assume.frequency[0].text == "0.4");
  CHECK(told.assume.frequency[1].text == "2.6");
  CHECK(told.assume.slew.text == "0");
  CHECK_FALSE(told.require.sets.largest_noise_at_least);
  const Design asked = recursion_of(design, {.largest_noise = true});
  CHECK(model_tables(asked).assume.frequency[0].text == "0.4");
  CHECK(model_tables(asked).assume.frequency[1].text == "2.6");
  CHECK(model_tables(asked).require.sets.largest_noise_at_least->text == "0.002");
  const Design hertz =
      recursion_of(design_of(kChosen, "frequency = { hz = [100, 400] }\nsample_rate = 1000\nnoise = 0.01"));
  CHECK(model_tables(hertz).assume.frequency_in_hertz);
  CHECK(model_tables(hertz).assume.frequency[0].text == "100");
  CHECK(model_tables(hertz).assume.sample_rate->text == "1000");
}

/// Of a certificate with nothing but a required claim that is open, or decided.
Certificate with_recursion(const Design& design, Extent extent, Verdict verdict) {
  Certificate certificate;
  certificate.design = design;
  certificate.extent = extent;
  Claim claim;
  claim.id = "ekf/largest-noise";
  claim.required = true;
  claim.verdict = verdict;
  certificate.claims.push_back(claim);
  const rigor::UpwardRounding upward;
  add_recursion(certificate, {});
  return certificate;
}

TEST_CASE("nothing is looked for where there is nothing to find, or nothing open") {
  const std::string require = "largest_noise_at_least = 0.002";
  for (const char* chosen : {"q = 0.005\nr = 0.01\nprocess_noise = \"frequency-only\"",
                             "lambda = 0\nprocess_noise = \"identity\""}) {
    const Certificate certificate =
        with_recursion(design_of(chosen, kAssumed, require), Extent::everything, Verdict::undecided);
    CHECK_FALSE(has_recursion(certificate));
    CHECK(recursion_part(certificate).objection.starts_with("Not looked for"));
  }
  const Certificate single = with_recursion(design_of(kChosen, "frequency = 0.9\nnoise = 0.01", require),
                                            Extent::everything, Verdict::undecided);
  CHECK(recursion_part(single).objection.find("not a single one") != std::string::npos);
  for (const Extent extent : {Extent::everything, Extent::requirements, Extent::verdicts, Extent::quick}) {
    for (const Verdict verdict : {Verdict::proved, Verdict::refuted, Verdict::undecided}) {
      if (verdict == Verdict::undecided && extent != Extent::quick) {
        continue;
      }
      const Certificate certificate = with_recursion(design_of(kChosen, kAssumed, require), extent, verdict);
      CHECK_FALSE(has_recursion(certificate));
      CHECK(recursion_part(certificate).objection.empty());
      CHECK(certificate.claims.size() == 1);
    }
  }
}

TEST_CASE("a bound of the long run is compared with the error to first order, which is not above it") {
  const std::string assume = "frequency = [1.4, 1.6]\nnoise = 0.001\nslew = ";
  const std::string text = "q = 0.005\nr = 0.01\nprocess_noise = \"identity\"";
  for (const char* slew : {"0", "0.00001"}) {
    CAPTURE(slew);
    const Certificate certificate =
        certify(design_of(text, assume + slew, "", "0.001"), "d.toml", text, {}, Extent::everything);
    const auto bound = proved_long_run(certificate);
    const auto& first_order = recursion_part(certificate).first_order_error;
    REQUIRE(bound);
    REQUIRE(first_order);
    CHECK(*first_order <= bound->upper());
    CHECK(*first_order >= bound->upper() / 10.0);
    const std::string document = recursion_section(certificate);
    CHECK(document.find("to first order in the errors") != std::string::npos);
    // The recursion has no slew: no advice that does not help.
    CHECK((document.find("largest_noise_at_least") != std::string::npos) == (slew[1] == '\0'));
  }
}

TEST_CASE("no recursion is offered where none would be looked for") {
  const std::string text = "q = 0.005\nr = 0.01\nprocess_noise = \"identity\"";
  const Certificate single = certify(design_of(text, "frequency = 1.5\nnoise = 0.001\nslew = 0", "", "0.001"),
                                     "d.toml", text, {}, Extent::everything);
  REQUIRE(recursion_part(single).first_order_error);
  CHECK(recursion_section(single).find("largest_noise_at_least") == std::string::npos);
}

TEST_CASE("what the windows leave open is decided by the recursion" * doctest::test_suite("nightly")) {
  constexpr const char* kQuiet = "frequency = [1.5, 1.501]\nnoise = 0.003\nslew = 0";
  const std::string text = "q = 0.005\nr = 0.01\nprocess_noise = \"identity\"";
  const Design design =
      design_of(text, kQuiet, "largest_noise_at_least = 0.004\nfrequency_error_radius_at_least = 0.01");
  const Certificate certificate = certify(design, "d.toml", text, {}, Extent::verdicts);
  CHECK(certificate.verdict == Verdict::proved);
  for (const Claim& claim : certificate.claims) {
    if (claim.required) {
      CHECK(claim.verdict == Verdict::proved);
      CHECK(claim.values == std::vector<std::pair<std::string, std::string>>{{"by", "recursion"}});
      CHECK(claim.evidence.empty());
      CHECK(claim.statement.starts_with("In exact arithmetic"));
    }
  }
  const std::string json = to_json(certificate);
  CHECK(json.find("\"recursion\": {") != std::string::npos);
}

}  // namespace
}  // namespace veritrack::certificates
