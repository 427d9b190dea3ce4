// The claims about starts that are followed into the certified set.
#include "checker/quadrature/capture.hpp"

#include <doctest/doctest.h>

#include <array>
#include <map>
#include <optional>
#include <string>

using namespace veritrack::checker;

namespace {

/// A tone of amplitude 2 with a noise of 0.5 and a slew of 0.25, and starts up to 0.5 rad/sample off.
Tree design() {
  const auto number = [](const char* text, const char* value) {
    return std::string(R"({"text": ")") + text + R"(", "lo": ")" + value + R"(", "hi": ")" + value + R"("})";
  };
  const std::string half = number("0.5", "0x1p-1");
  const std::string quarter = number("0.25", "0x1p-2");
  return read_json(R"({"assume": {"amplitude": )" + number("2", "0x1p+1") + R"(, "frequency": [)" + quarter +
                   ", " + number("3", "0x1.8p+1") + R"(], "noise": )" + half + R"(, "slew": )" + quarter +
                   R"(, "initial_frequency_error": )" + half + R"(, "initial_phase_error": )" + quarter +
                   R"(, "initial_amplitude_error": )" + quarter + R"(}, "require": {}})");
}

/// The claim, when that is what was found.
Claim checked(const std::string& id, const std::map<std::string, Captured>& captured,
              Objections& objections) {
  const Tree claim = read_json(R"({"id": ")" + id + R"(", "verdict": "proved", "evidence": {}})");
  const Tree tables = design();
  const Guarantee guarantee(tables, {false, true, kDoublePrecision}, objections);
  return check_capture_claim(claim, captured, guarantee, objections);
}

/// The claim "ekf/capture-at-reduced-noise", when the starts were followed under so much noise and slew.
Claim claim_under(double noise, double slew, Verdict verdict, Objections& objections) {
  Captured captured;
  captured.noise = Ball(noise);
  captured.slew = Ball(slew);
  captured.verdict = verdict;
  captured.covariance = "and with P(0|0) = M";
  captured.set_error = Ball(3.0);
  return checked("ekf/capture-at-reduced-noise", {{"capture/reduced-noise", captured}}, objections);
}

}  // namespace

TEST_CASE("starts are captured under the noise and slew that they were followed under, and no more") {
  Objections objections;
  const Claim found = claim_under(0.2505, 0.125, Verdict::proved, objections);
  CHECK(objections.empty());
  CHECK(
      found.statement ==
      std::string(kDoublePrecision) +
          ", for a tone of constant amplitude 2 whose frequency is at most pi rad/sample and changes by at "
          "most 0.125 rad/sample per sample, with measurement noise of at most 0.25 of the amplitude (the "
          "length of the error in both channels), started within 0.5 rad/sample of the true frequency, 0.25 "
          "rad of the phase and 0.25 of the amplitude and with P(0|0) = M, the tracker enters the certified "
          "set, in which the frequency error stays below 3.14 rad/sample, and never leaves it.");
  claim_under(0.25, 0.125, Verdict::undecided, objections);
  CHECK_FALSE(objections.empty());
}

TEST_CASE("the sentence names the noise and slew under which starts are captured") {
  Captured captured;
  captured.verdict = Verdict::proved;
  captured.set_error = Ball(3.0);
  Objections objections;
  const std::string assumed = checked("ekf/capture", {{"capture", captured}}, objections).statement;
  CHECK(assumed.find(
            " and changes by at most 0.25 rad/sample per sample, with measurement noise of at most 0.5 "
            "(the length of the error in both channels; 0.353 in each is enough), started") !=
        std::string::npos);
  const std::string none =
      checked("ekf/capture-noise-free", {{"capture/noise-free", captured}}, objections).statement;
  CHECK(none.find(" and is constant, without measurement noise, started") != std::string::npos);
  CHECK(objections.empty());
}

TEST_CASE("what is captured by a set that reaches another lock is not said to be") {
  for (const std::optional<Ball>& error : {std::optional<Ball>(Ball(3.14)), std::optional<Ball>()}) {
    Captured captured;
    captured.verdict = Verdict::proved;
    captured.set_error = error;
    Objections objections;
    checked("ekf/capture", {{"capture", captured}}, objections);
    CHECK_FALSE(objections.empty());
  }
}

TEST_CASE("without the derivation nothing is captured") {
  Objections objections;
  for (const char* id : {"ekf/capture", "ekf/capture-noise-free", "ekf/capture-at-reduced-noise"}) {
    objections.clear();
    checked(id, {}, objections);
    CHECK_FALSE(objections.empty());
  }
}

namespace {

/// A set that somebody has verified: frequency errors up to `reach` rad/sample, and others up to twice that.
CertifiedSet set_reaching(double reach) {
  CertifiedSet set{"start-error", {}, true};
  Setting& s = set.setting;
  s.metric = {half, half, zero, one};
  s.lower = {Ball(0.001), Ball(0.001), zero, Ball(0.001)};
  s.upper = {half, half, zero, half};
  s.radius = Ball(reach);
  s.noise = s.slew = Ball(0.01);
  s.rate = half;
  s.noise_gain = s.slew_gain = one;
  s.error_rounding = s.covariance_rounding = zero;
  return set;
}

/// Starts with frequency errors up to this, and no others.
Design starts_within(double frequency_error) {
  Design design;
  design.amplitude = one;
  design.q1 = design.q2 = Ball(0.01);
  design.r = Ball(0.1);
  design.epsilon = zero;
  design.largest_frequency = Ball(3.0);
  design.noise = design.slew = zero;
  design.amplitude_error = design.phase_error = zero;
  design.frequency_error = Ball(frequency_error);
  design.covariance = std::array<std::array<Ball, 3>, 3>{
      {{Ball(0.4), zero, zero}, {zero, Ball(0.4), zero}, {zero, zero, Ball(0.4)}}};
  return design;
}

struct Evidence {
  std::string name = "cover", low = "-0x1p-4", high = "0x1p-4", samples = "0x0p+0", level = "0x1.1p-4";
  std::string noise = "0x0p+0", slew = "0x0p+0", turns = "0x0p+0", quantities;
};

/// What is found of a single box of starts, whose frequency errors are between `low` and `high`.
Captured follow(const Evidence& e, const Design& design, double reach, Objections& objections) {
  const std::string box = R"(["0x0p+0","0x0p+0","0x0p+0","0x0p+0",")" + e.low + "\",\"" + e.high + "\",\"" +
                          e.samples + "\",\"" + e.level + "\"]";
  const Tree claimed = read_json(R"({"id": "capture", "conditions": [], "quantities": {)" + e.quantities +
                                 R"(}, "evidence": [{"name": ")" + e.name + R"(", "numbers": {"noise": ")" +
                                 e.noise + R"(", "slew": ")" + e.slew + R"(", "turns": ")" + e.turns +
                                 R"("}, "matrices": {"boxes": [)" + box + "]}}]}");
  return check_capture(claimed, design, {set_reaching(reach)}, false, objections);
}

Verdict verdict_on(const Evidence& evidence, const Design& design, double reach = 0.125) {
  Objections objections;
  return follow(evidence, design, reach, objections).verdict;
}

}  // namespace

TEST_CASE("a box of starts is in the set, to the level that it reaches, under the assumed noise and slew") {
  Design design = starts_within(0.0625);
  CHECK(verdict_on({}, design) == Verdict::proved);
  SUBCASE("starts that the box does not contain") {
    design.frequency_error = Ball(0.0626);
  }
  SUBCASE("noise that the starts were not followed under") {
    design.noise = Ball(0.001);
  }
  SUBCASE("slew that the starts were not followed under") {
    design.slew = Ball(0.001);
  }
  SUBCASE("a covariance above that of the set") {
    (*design.covariance)[2][2] = Ball(0.6);
  }
  SUBCASE("a covariance below that of the set") {
    (*design.covariance)[2][2] = Ball(0.0009);
  }
  CHECK(verdict_on({}, design) == Verdict::undecided);
}

TEST_CASE("what is promised of the frequency error is the level that is entered at") {
  Objections objections;
  const Captured found = follow({}, starts_within(0.0625), 0.125, objections);
  REQUIRE(found.bound.has_value());
  CHECK(certainly_at_most(Ball(0x1.1p-4), *found.bound));
}

TEST_CASE("a level beyond the set is none of it") {
  Evidence wide;
  wide.low = "-0x1p-2";
  wide.high = "0x1p-2";
  wide.level = "0x1.1p-2";
  CHECK(verdict_on(wide, starts_within(0.25), 0.27) == Verdict::proved);
  CHECK(verdict_on(wide, starts_within(0.25), 0.26) == Verdict::undecided);
  Evidence other;
  other.level = "-0x1.1p-4";
  CHECK(verdict_on(other, starts_within(0.0625)) == Verdict::undecided);
  other.level = "0x1.fp-5";
  CHECK(verdict_on(other, starts_within(0.0625)) == Verdict::undecided);
}

TEST_CASE("a witness is an assumed start that ends whole turns off, farther than the set reaches") {
  // 0x1.921fb54442d18p+2 is nearly two pi: the tracker cannot tell that from no error.
  Evidence witness;
  witness.name = "witness";
  witness.low = witness.high = "0x1.921fb54442d18p+2";
  witness.turns = "0x1p+0";
  CHECK(verdict_on(witness, starts_within(7.0)) == Verdict::refuted);
  CHECK(verdict_on(witness, starts_within(6.0)) == Verdict::undecided);
  SUBCASE("more turns than rounding is bounded for") {
    witness.low = witness.high = "0x1.921fb54442d18p+4";
    witness.turns = "0x1p+2";
    CHECK(verdict_on(witness, starts_within(26.0)) == Verdict::undecided);
  }
  SUBCASE("a set that reaches half of that decides nothing") {
    CHECK(verdict_on(witness, starts_within(7.0), 3.1) == Verdict::refuted);
    CHECK(verdict_on(witness, starts_within(7.0), 3.2) == Verdict::undecided);
  }
  SUBCASE("nor does a cover of all starts that ends turned") {
    Evidence cover = witness;
    cover.low = "-0x1p-4";
    cover.high = "0x1p-4";
    cover.level = "0x1p+3";
    CHECK(verdict_on(cover, starts_within(0.0625), 8.0) == Verdict::undecided);
  }
}

TEST_CASE("a box stands for its mirror image only when the covariance is symmetric, too") {
  // Phase errors of either sign, in a box each, that are followed for a sample.
  Design design = starts_within(0.0);
  design.phase_error = Ball(0.3);
  const auto verdict = [&](const std::string& level, const std::string& of_image) {
    const auto box = [&](const char* low, const char* high, const std::string& reached) {
      return R"(["0x0p+0","0x0p+0",")" + std::string(low) + "\",\"" + high +
             R"(","0x0p+0","0x0p+0","0x1p+0",")" + reached + "\"]";
    };
    const Tree claimed =
        read_json(R"({"id": "capture", "conditions": [], "quantities": {}, "evidence": [{"name": "cover",)"
                  R"("numbers": {"noise": "0x0p+0", "slew": "0x0p+0"}, "matrices": {"boxes": [)" +
                  box("-0x1.4p-2", "0x0p+0", level) + "," + box("0x0p+0", "0x1.4p-2", of_image) + "]}}]}");
    CertifiedSet set = set_reaching(4.0);
    set.setting.metric.amplitude = Ball(1024.0);
    Objections objections;
    return check_capture(claimed, design, {set}, false, objections).verdict;
  };
  CHECK(verdict("0x1.99999ap+1", "0x1.99999ap+1") == Verdict::proved);
  CHECK(verdict("0x1.99999ap+1", "0x1p-10") == Verdict::undecided);
  SUBCASE("amplitude and phase") {
    (*design.covariance)[0][1] = (*design.covariance)[1][0] = Ball(0.05);
  }
  SUBCASE("amplitude and frequency") {
    (*design.covariance)[0][2] = (*design.covariance)[2][0] = Ball(0.05);
  }
  // The least of a range, of which the largest is symmetric.
  const auto begin_at = [&](std::size_t i, double covariance) {
    design.highest_covariance = design.covariance;
    (*design.highest_covariance)[0][0] = (*design.highest_covariance)[i][i] = Ball(0.4 + covariance);
    (*design.covariance)[0][i] = (*design.covariance)[i][0] = Ball(covariance);
  };
  SUBCASE("amplitude and phase, in a range") {
    begin_at(1, 0.01);
  }
  SUBCASE("amplitude and frequency, in a range") {
    begin_at(2, 0.011);
  }
  CHECK(verdict("0x1.99999ap+1", "0x1.99999ap+1") == Verdict::undecided);
  CHECK(verdict("0x1p+2", "0x1p+2") == Verdict::proved);
}

TEST_CASE("nothing has settled before it is in the set") {
  const Design design = starts_within(0.0625);
  const auto settles = [&](const std::string& samples) {
    Evidence evidence;
    evidence.samples = "0x1p+1";
    evidence.level = "0x1p-3";
    evidence.quantities =
        R"("settling_samples": {"hi": ")" + samples + R"("}, "settled_frequency_error": {"hi": "0x1p-2"})";
    Objections objections;
    const Captured found = follow(evidence, design, 0.125, objections);
    return found.verdict == Verdict::proved && found.settled.has_value();
  };
  CHECK(settles("0x1p+1"));
  CHECK_FALSE(settles("0x1p+0"));
}
