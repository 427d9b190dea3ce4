// The steady state of the single-channel tracker: the established curve against the tracker that runs, and
// what must not be verified of it.
#include "checker/single_channel/bias.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "checker/single_channel/invariant_curve.hpp"
#include "tests/support/golden.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"
#include "trackers/single_channel/single_channel_rotating_frame.hpp"

namespace {

using Json = nlohmann::ordered_json;
using namespace veritrack;
using checker::Ball;

constexpr double kEpsilon = 0.01;
constexpr double kFrequency = 1.5;  // rad/sample
constexpr double kRate = 0.92;

checker::TrackerValues<Ball> values() {
  return {Ball(1.0), Ball(1.0), Ball(10.0), Ball(kEpsilon)};
}

Json accepted() {
  return Json::parse(test::read_file(VERITRACK_SOURCE_DIR "/tests/certificates/accepted/steady-state.json"));
}

/// What is wrong with the derivation of the accepted certificate.
checker::Objections objections_to(const Json& derivation) {
  checker::Objections objections;
  const auto design =
      checker::read_single_channel_design(checker::read_json(accepted()["design"].dump()), objections);
  checker::QuadratureBranch quadrature({design.q1, design.q2, design.r, design.epsilon});
  check_bias(checker::read_json(derivation.dump()), design, quadrature, objections);
  return objections;
}

double number_of(const Json& value) {
  return std::strtod(value.get<std::string>().c_str(), nullptr);
}
std::string hexadecimal(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%a", value);
  return text;
}

}  // namespace

TEST_CASE("the simulated tracker settles within the distances of the curve") {
  const auto curve = checker::establish_invariant_curve(values(), Ball(kFrequency), 0.0, Ball(kRate));
  REQUIRE(curve.has_value());
  const trackers::ToneModel<double> design{1.0, 1.0, 10.0, kEpsilon};
  trackers::SingleChannelEkf<double> tracker(
      trackers::single_channel_design(design),
      {1.0, 0.0, kFrequency, trackers::diagonal_process_noise(1.0, 1.0)});
  constexpr int kSettling = 500;
  for (int k = 1; k <= kSettling + test::effort(300); ++k) {
    tracker.step(std::cos(kFrequency * k));
    if (k > kSettling) {
      const Ball phase(std::remainder(kFrequency * k, std::numbers::pi));
      const checker::Matrix b = checker::waves(curve->family.harmonics, phase, Ball(1.0), 1);
      const Ball expected = (curve->family.terms.front() * b)(2, 0);
      CHECK(std::fabs(tracker.filtered().frequency - kFrequency - expected.near()) <=
            curve->near_here[2].near() + 1e-12);
    }
  }
  CHECK(curve->near_here[2].near() < 1e-8);
}

TEST_CASE("the quadrature tracker's fixed point is where the simulated one settles") {
  checker::QuadratureBranch branch(values());
  const trackers::ToneModel<double> design{1.0, 1.0, 10.0, kEpsilon};
  for (const double frequency : {0.3, 2.6, kFrequency}) {
    trackers::RotatingFrameState<double> x;
    x << 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0;
    constexpr int kSettling = 3000;
    for (int k = 0; k < kSettling; ++k) {
      x = trackers::rotating_frame_map<double>(x, {0.0, 0.0, 0.0, frequency}, design);
    }
    const Ball found = branch.error_at(Ball(frequency));
    CHECK(std::fabs(found.near() - x(2)) <= 1e-13);
    CHECK(certainly_less(abs(found - Ball(found.near())), Ball(1e-15)));
  }
  CHECK(!branch.error_at(Ball(4.5)).finite());
  CHECK(!branch.error_at(Ball::everything()).finite());
}

TEST_CASE("no curve where one of the conditions fails") {
  const auto establish = [](const Ball& frequency, double half_width, const Ball& rate) {
    return checker::establish_invariant_curve(values(), frequency, half_width, rate).has_value();
  };
  // Faster than the products of the Jacobians shrink.
  CHECK(!establish(Ball(kFrequency), 0.0, Ball(0.7)));
  CHECK(!establish(Ball(kFrequency), 0.0, Ball(1.0)));
  CHECK(!establish(Ball(kFrequency), 0.0, Ball(1.5)));
  CHECK(!establish(Ball(kFrequency), 0.0, Ball(-0.99)));
  // A frequency that no double is, from either side.
  CHECK(!establish(checker::from_decimal("1.1"), 0.0, Ball(kRate)));
  CHECK(!establish(checker::from_decimal("1.2"), 0.0, Ball(kRate)));
  // Around one that is not where it is asked for.
  CHECK(!establish(Ball::hull(Ball(1.5 - 1e-6), Ball(1.5 + 1e-6)), 1e-7, Ball(kRate)));
  // Frequencies too far apart for one curve, and for one family.
  CHECK(!establish(Ball::hull(Ball(1.49), Ball(1.51)), 0.0, Ball(kRate)));
  CHECK(!establish(Ball(kFrequency), 0.5, Ball(kRate)));
  CHECK(!establish(Ball::everything(), 0.0, Ball(kRate)));
  auto undefined = values();
  undefined.r = Ball::everything();
  CHECK(!checker::establish_invariant_curve(undefined, Ball(kFrequency), 0.0, Ball(kRate)));
}

TEST_CASE("every number of the derivation, one part in a thousand better" * doctest::test_suite("nightly")) {
  const Json derivation = accepted()["derivations"][0];
  REQUIRE(objections_to(derivation).empty());
  std::vector<Json> changed;
  for (const auto& [name, quantity] : derivation["quantities"].items()) {
    for (const char* end : {"lo", "hi"}) {
      const double number = number_of(quantity[end]);
      if (number == 0.0) {
        continue;
      }
      // Into the enclosure; of the frequency, another one. The decimals stay as they are.
      const bool up = (std::string(end) == "lo") == (number > 0.0);
      Json better = derivation;
      better["quantities"][name][end] = hexadecimal(number * (up ? 1.001 : 0.999));
      changed.push_back(better);
    }
  }
  int refused = 0;
  int proved_anew = 0;
  for (const Json& better : changed) {
    // A rate that is a little better may be proved: by other norms, or on finer cells.
    const bool of_rate =
        better["quantities"]["contraction_rate"] != derivation["quantities"]["contraction_rate"];
    const bool accepted_anew = objections_to(better).empty();
    CHECK_MESSAGE((!accepted_anew || of_rate), better["quantities"].dump());
    (accepted_anew ? proved_anew : refused) += 1;
  }
  MESSAGE(refused << " changed numbers refused, " << proved_anew << " proved anew");
  CHECK(refused >= 14);
}

TEST_CASE(
    "without a leak zero needs no curve, but a frequency between 0 and pi, and no rate is taken on trust") {
  Json derivation = accepted()["derivations"][0];
  const Json zero{{"lo", "0x0p+0"}, {"hi", "0x0p+0"}, {"decimal", "[0, 0]"}};
  for (const char* name :
       {"mean_bias", "min_error", "max_error", "mean_bias_around", "min_error_around", "max_error_around"}) {
    derivation["quantities"][name] = zero;
  }
  derivation["quantities"].erase("contraction_rate");
  checker::Objections none;
  auto design = checker::read_single_channel_design(checker::read_json(accepted()["design"].dump()), none);
  design.epsilon = Ball(0.0);
  const auto objections_at = [&](double frequency, double q1, const Json& claimed) {
    Json at = claimed;
    at["quantities"]["frequency"] = {
        {"lo", hexadecimal(frequency)}, {"hi", hexadecimal(frequency)}, {"decimal", "[-10, 10]"}};
    auto changed = design;
    changed.q1 = Ball(q1);
    checker::QuadratureBranch quadrature({changed.q1, changed.q2, changed.r, changed.epsilon});
    checker::Objections objections;
    check_bias(checker::read_json(at.dump()), changed, quadrature, objections);
    return objections;
  };
  Json without_around = derivation;
  for (const char* name : {"mean_bias_around", "min_error_around", "max_error_around"}) {
    without_around["quantities"].erase(name);
  }
  CHECK(objections_at(1.5, 1.0, derivation).empty());
  CHECK(objections_at(0.001, 1.0, without_around).empty());
  CHECK(objections_at(3.14, 1.0, without_around).empty());
  // Around 0.001 there are frequencies below 0.
  CHECK_FALSE(objections_at(0.001, 1.0, derivation).empty());
  CHECK_FALSE(objections_at(3.15, 1.0, without_around).empty());
  CHECK_FALSE(objections_at(-0.5, 1.0, without_around).empty());
  CHECK_FALSE(objections_at(0.0, 1.0, without_around).empty());
  CHECK_FALSE(objections_at(1.5, 0.0, without_around).empty());
  Json biased = without_around;
  biased["quantities"]["min_error"] = {{"lo", "0x1p-9"}, {"hi", "0x1p-9"}};
  CHECK_FALSE(objections_at(1.5, 1.0, biased).empty());
  Json fast = without_around;
  fast["quantities"]["contraction_rate"] = {{"lo", "0x0p+0"}, {"hi", "0x1p-3"}};
  CHECK_FALSE(objections_at(0.001, 1.0, fast).empty());
}

TEST_CASE("words, verdicts and another frequency") {
  Json derivation = accepted()["derivations"][0];
  for (const char* name : {"mean_bias_around", "min_error_around", "max_error_around"}) {
    derivation["quantities"].erase(name);  // they take longest
  }
  std::vector<Json> changed(4, derivation);
  changed[0]["id"] = "single-channel-bias/1.501";
  changed[1]["conditions"][0]["verdict"] = changed[1]["verdict"] = "refuted";
  // Nothing is said to be proved, and quantities are there all the same.
  changed[2]["conditions"].erase(0);
  changed[2].erase("verdict");
  changed[3]["quantities"]["quadrature_bias"] = derivation["quantities"]["mean_bias"];
  for (const Json& one : changed) {
    CHECK_MESSAGE(!objections_to(one).empty(), one.dump().substr(0, 200));
  }
  Json nothing = derivation;
  nothing["conditions"].erase(0);
  nothing.erase("verdict");
  nothing["quantities"] = {{"frequency", derivation["quantities"]["frequency"]}};
  CHECK(objections_to(nothing).empty());
}

TEST_CASE("Proposition 1 rests on a bias that was established at the frequency in the sentence") {
  const Json claims = accepted()["claims"];
  const checker::SingleChannelDesign design{
      Ball(1.0), Ball(1.0), Ball(1.0), Ball(10.0), Ball(kEpsilon), Ball(1.5), Ball(1.5), {}, {}, {}, {}, {}};
  const auto objections = [&](Json claim, const std::string& frequency, const checker::Range& mean) {
    claim["frequency"] = frequency;
    checker::Objections found;
    const checker::Claim checked =
        check_proposition_1(checker::read_json(claim.dump()), design, {{Ball(1.5), mean}}, found);
    CHECK(checked.statement.find(frequency + " rad/sample") != std::string::npos);
    return found.size();
  };
  const Ball mean(-0.049402273);
  CHECK(objections(claims[0], "1.5", mean) == 0);
  CHECK(objections(claims[1], "1.5", mean) == 0);
  CHECK(objections(claims[1], "1.5", Ball(0.0)) > 0);
  CHECK(objections(claims[1], "1.5", Ball::everything()) > 0);
  // Claimed as wide as it was found, and on one side or on both of 0.
  Json wide = claims[1];
  const auto objections_within = [&](const char* low, const char* high) {
    wide["evidence"]["mean_bias"] = {{"lo", low}, {"hi", high}};
    return objections(wide, "1.5", {checker::from_hexadecimal(low), checker::from_hexadecimal(high)});
  };
  CHECK(objections_within("-0x1p-1", "-0x1p-2") == 0);
  CHECK(objections_within("0x1p-2", "0x1p-1") == 0);
  CHECK(objections_within("-0x1p-1", "0x1p-1") > 0);
  CHECK(objections_within("-0x1p-1", "0x0p+0") > 0);
  CHECK(objections_within("0x0p+0", "0x1p-1") > 0);
  CHECK(objections(claims[1], "1.4", mean) > 0);
  CHECK(objections(claims[0], "3.2", mean) > 0);
  CHECK(objections(claims[1], "3.2", mean) > 0);
  for (Ball checker::SingleChannelDesign::*value :
       {&checker::SingleChannelDesign::q1, &checker::SingleChannelDesign::q2,
        &checker::SingleChannelDesign::r}) {
    checker::SingleChannelDesign without = design;
    without.*value = Ball(0.0);
    checker::Objections found;
    check_proposition_1(checker::read_json(claims[0].dump()), without, {}, found);
    CHECK_FALSE(found.empty());
  }
}
