#include "checker/sets/guarantee.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>

using namespace veritrack::checker;

namespace {

std::string number(const std::string& text, const std::string& lo, const std::string& hi) {
  return R"({"text": ")" + text + R"(", "lo": ")" + lo + R"(", "hi": ")" + hi + R"("})";
}
std::string exactly(const std::string& text, const std::string& value) {
  return number(text, value, value);
}

/// A tracker whose starts may be off by 0.5 rad/sample.
std::string design(const std::string& require) {
  return R"({"assume": {"amplitude": )" + exactly("2.0", "0x1p+1") + R"(, "frequency": [)" +
         exactly("0.25", "0x1p-2") + "," + exactly("3.0", "0x1.8p+1") + R"(], "noise": )" +
         exactly("0.125", "0x1p-3") + R"(, "slew": )" + exactly("0.0", "0x0p+0") +
         R"(, "initial_frequency_error": )" + exactly("0.5", "0x1p-1") + R"(, "initial_phase_error": )" +
         exactly("0.25", "0x1p-2") + R"(, "initial_amplitude_error": )" + exactly("0.25", "0x1p-2") +
         R"(}, "require": )" + require + "}";
}

const std::string below = R"({"frequency_error_below": )" + exactly("0.75", "0x1.8p-1") + "}";

/// What is found of a claim with this evidence: its sentence and what is objected to.
struct Answer {
  Claim claim;
  Objections objections;
  [[nodiscard]] bool says(const std::string& words) const {
    return claim.statement.find(words) != std::string::npos;
  }
};
Answer answer(const std::string& id, const std::string& verdict, const std::string& tables,
              const Promises& promises, const std::string& evidence = "{}",
              const Wording& wording = {false, true, kExactArithmetic}) {
  const Tree design = read_json(tables);
  Answer found;
  const Guarantee guarantee(design, wording, found.objections);
  const Tree claim =
      read_json(R"({"id": ")" + id + R"(", "verdict": ")" + verdict + R"(", "evidence": )" + evidence + "}");
  found.claim = guarantee.check(claim, promises, found.objections);
  return found;
}

bool is_verified(const std::string& id, const std::string& verdict, const std::string& tables,
                 const Promises& promises, const std::string& evidence = "{}") {
  return answer(id, verdict, tables, promises, evidence).objections.empty();
}

std::string at_most(const std::string& name, const std::string& value) {
  return "\"" + name + R"(": {"hi": ")" + value + R"("})";
}

Promises bound(double value) {
  Promises promises;
  promises.bound = Ball(value);
  promises.covariance = "and with P(0|0) = M";
  return promises;
}

/// Of sets in which the frequency error stays below that, rad/sample.
Promises in_lock(double error = 3.0) {
  Promises promises;
  promises.noise_error = promises.slew_error = promises.reach_error = promises.lock_reach = Ball(error);
  return promises;
}

}  // namespace

TEST_CASE("a sentence about lock names the lock, or is not verified") {
  const auto require = [](const char* key) {
    return design(std::string(R"({")") + key + R"(": )" + exactly("0.125", "0x1p-3") + "}");
  };
  const auto is_proved_at = [&](double error) {
    Promises promises = in_lock(error);
    promises.noise = promises.slew = promises.reach = Ball(0.25);
    const std::string limits = R"({"largest_noise": {"lo": "0x1p-3"}, "largest_slew": {"lo": "0x1p-3"}})";
    const std::string set = R"({"frequency_error_radius": {"lo": "0x1p-3"}})";
    int proved = 0;
    proved += is_verified("ekf/limits", "proved", design("{}"), promises, limits) ? 1 : 0;
    proved += is_verified("ekf/invariant-set", "proved", design("{}"), promises, set) ? 1 : 0;
    for (const auto& [id, key] : {std::pair("ekf/largest-noise", "largest_noise_at_least"),
                                  {"ekf/largest-slew", "largest_slew_at_least"},
                                  {"ekf/frequency-error-radius", "frequency_error_radius_at_least"}}) {
      proved += is_verified(id, "proved", require(key), promises) ? 1 : 0;
    }
    return proved;
  };
  CHECK(is_proved_at(3.139) == 5);
  CHECK(is_proved_at(3.14) == 0);
  CHECK(is_proved_at(6.5) == 0);
  Promises unknown;
  unknown.noise = unknown.slew = unknown.reach = Ball(0.25);
  CHECK(!is_verified("ekf/largest-noise", "proved", require("largest_noise_at_least"), unknown));
  // Without a limit that is asked for, the lock is kept only with a number that says which.
  const auto keeps = [](double found, const std::string& evidence) {
    return is_verified("ekf/guarantee", "proved", design("{}"), bound(found), "{" + evidence + "}");
  };
  CHECK(keeps(0.7, at_most("frequency_error_bound", "0x1.8p-1")));
  CHECK_FALSE(keeps(0.7, ""));
  CHECK_FALSE(keeps(0.7, at_most("frequency_error_bound", "0x1.ap+1")));
  CHECK_FALSE(keeps(3.2, at_most("frequency_error_bound", "0x1.ap+1")));
}

TEST_CASE("one channel shows a tone as one of the mirrored frequency, too") {
  // The band is [0.25, 3]: pi less it begins at 0.1415.
  const auto is_proved_at = [](double error) {
    Promises promises = in_lock(error);
    promises.noise = Ball(0.25);
    const std::string tables = design(R"({"largest_noise_at_least": )" + exactly("0.125", "0x1p-3") + "}");
    const Answer found =
        answer("ekf/largest-noise", "proved", tables, promises, "{}", {true, false, kExactArithmetic});
    CHECK(found.says("the frequency error stays below 0.141 rad/sample"));
    return found.objections.empty();
  };
  CHECK(is_proved_at(0.1405));
  CHECK_FALSE(is_proved_at(0.1412));
}

TEST_CASE("the frequency error stays below what is asked") {
  const std::string tables = design(below);
  const char* id = "ekf/frequency-error-bound";
  CHECK(is_verified(id, "proved", tables, bound(0.7)));
  CHECK(!is_verified(id, "proved", tables, bound(0.75)));
  CHECK(!is_verified(id, "proved", tables, Promises{}));
  CHECK(!is_verified(id, "refuted", tables, Promises{}));
  // A start that is off by as much as the limit refutes it.
  const std::string less = design(R"({"frequency_error_below": )" + exactly("0.5", "0x1p-1") + "}");
  CHECK(is_verified(id, "refuted", less, Promises{}));
  // So does a start that ends farther off, and none that ends nearer.
  Promises wrong;
  wrong.wrong_lock = Ball(0.75);
  CHECK(is_verified(id, "refuted", tables, wrong));
  wrong.wrong_lock = Ball(0.74);
  CHECK(!is_verified(id, "refuted", tables, wrong));
  // Nobody has asked for it.
  CHECK(!is_verified(id, "proved", design("{}"), bound(0.7)));
}

TEST_CASE("the sentence names every hypothesis") {
  const Answer found = answer("ekf/guarantee", "proved", design(below), bound(0.7));
  CHECK(found.objections.empty());
  for (const char* words :
       {"In exact arithmetic", "constant amplitude 2.0", "is at most pi rad/sample", "is constant",
        "noise of at most 0.125", "0.0883 in each is enough", "within 0.5 rad/sample of the true frequency",
        "0.25 rad of the phase", "0.25 of the amplitude", "and with P(0|0) = M",
        "the frequency error stays below 0.75 rad/sample for ever"}) {
    CAPTURE(words);
    CHECK(found.says(words));
  }
  const Answer banded =
      answer("ekf/guarantee", "proved", design(below), bound(0.7), "{}", {true, false, "X"});
  CHECK(banded.says("X, for a tone"));
  CHECK(banded.says("lies between 0.25 and 3.0 rad/sample"));
  CHECK_FALSE(banded.says("in each"));
}

TEST_CASE("the sentence says no number that its evidence does not have, and evidence is established") {
  Promises promises = bound(0.7);
  promises.ultimate = Ball(0.1);
  promises.settled = Settled{Ball(14.0), Ball(0.2)};
  const auto with = [&](const std::string& evidence) {
    return answer("ekf/guarantee", "proved", design(below), promises, "{" + evidence + "}");
  };
  CHECK_FALSE(with("").says("never exceeds"));
  CHECK(with(at_most("frequency_error_bound", "0x1.7p-1")).says("never exceeds 0.719 rad/sample"));
  CHECK(with(at_most("frequency_error_bound", "0x1.7p-1")).objections.empty());
  CHECK(!with(at_most("frequency_error_bound", "0x1.6p-1")).objections.empty());
  const auto settled = [&](const std::string& samples, const std::string& error) {
    return with(at_most("settling_samples", samples) + "," + at_most("settled_frequency_error", error));
  };
  CHECK(settled("0x1.cp+3", "0x1.ap-3").says("from sample 14 on it stays at or below 0.204 rad/sample"));
  CHECK(settled("0x1.cp+3", "0x1.ap-3").objections.empty());
  CHECK(!settled("0x1.ap+3", "0x1.ap-3").objections.empty());
  CHECK(!settled("0x1.cp+3", "0x1.8p-3").objections.empty());
  // What is no less than what is never exceeded, or reads the same, is not repeated.
  const auto bounded = [&](const std::string& error) {
    return with(at_most("frequency_error_bound", "0x1.7p-1") + "," + at_most("settling_samples", "0x1.cp+3") +
                "," + at_most("settled_frequency_error", error));
  };
  CHECK(bounded("0x1.ap-3").says("never exceeds 0.719 rad/sample; from sample 14 on"));
  CHECK_FALSE(bounded("0x1.8p-1").says("from sample 14 on"));
  CHECK(bounded("0x1.8p-1").objections.empty());
  CHECK_FALSE(bounded("0x1.7p-1").says("from sample 14 on"));
  CHECK_FALSE(bounded("0x1.6ffffp-1").says("from sample 14 on"));
  CHECK(with(at_most("ultimate_frequency_error", "0x1.ap-4"))
            .says("in the long run it is at most 0.102 rad/sample"));
  CHECK(!with(at_most("ultimate_frequency_error", "0x1.8p-4")).objections.empty());
}

TEST_CASE("settling takes two numbers, and both are met") {
  const std::string tables = design(R"({"settles_within": )" + exactly("16", "0x1p+4") +
                                    R"(, "settled_below": )" + exactly("0.25", "0x1p-2") + "}");
  Promises promises = bound(0.7);
  const auto settles = [&](double samples, double error) {
    promises.settled = Settled{Ball(samples), Ball(error)};
    return is_verified("ekf/settling-time", "proved", tables, promises);
  };
  CHECK(settles(16.0, 0.24));
  CHECK_FALSE(settles(17.0, 0.24));
  CHECK_FALSE(settles(16.0, 0.25));
  const std::string half = design(R"({"settles_within": )" + exactly("16", "0x1p+4") + "}");
  CHECK_FALSE(is_verified("ekf/settling-time", "proved", half, promises));
}

TEST_CASE("sizes of sets: noise is certified relative to the amplitude") {
  const std::string tables = design(R"({"largest_noise_at_least": )" + exactly("0.5", "0x1p-1") + "}");
  Promises promises = in_lock();
  promises.noise = Ball(0.25);
  CHECK(is_verified("ekf/largest-noise", "proved", tables, promises));
  promises.noise = Ball(0.24);
  CHECK(!is_verified("ekf/largest-noise", "proved", tables, promises));
  CHECK(!is_verified("ekf/largest-noise", "proved", tables, Promises{}));
}

TEST_CASE("sizes of sets: slew, and the reach") {
  const std::string slew = design(R"({"largest_slew_at_least": )" + exactly("0.5", "0x1p-1") + "}");
  const std::string reach =
      design(R"({"frequency_error_radius_at_least": )" + exactly("0.5", "0x1p-1") + "}");
  Promises promises = in_lock();
  promises.slew = promises.reach = Ball(0.5);
  CHECK(is_verified("ekf/largest-slew", "proved", slew, promises));
  CHECK(is_verified("ekf/frequency-error-radius", "proved", reach, promises));
  promises.slew = promises.reach = Ball(0.49);
  CHECK(!is_verified("ekf/largest-slew", "proved", slew, promises));
  CHECK(!is_verified("ekf/frequency-error-radius", "proved", reach, promises));
}

TEST_CASE("nothing below zero is asked for, and a set of no size is none") {
  for (const auto* value : {"0x0p+0", "-0x1p-1"}) {
    Objections objections;
    const Tree tables = read_json(
        design(R"({"frequency_error_below": )" + exactly(*value == '-' ? "-0.5" : "0", value) + "}"));
    const Guarantee guarantee(tables, {}, objections);
    CHECK(objections.size() == 1);
  }
  Promises promises = in_lock();
  promises.reach = Ball(0.25);
  promises.rate = Ball(0.9);
  CHECK(!is_verified(
      "ekf/invariant-set", "proved", design("{}"), promises,
      R"({"frequency_error_radius": {"lo": "0x0p+0"}, "contraction_rate": {"hi": "0x1.dp-1"}})"));
}

TEST_CASE("a claim on settling is one from a sample on, below an error") {
  const auto claim = [](const std::string& samples, const std::string& error) {
    return settling_claim(read_json("{" + at_most("settling_samples", samples) + "," +
                                    at_most("settled_frequency_error", error) + "}"));
  };
  CHECK(claim("0x0p+0", "0x1p-3").has_value());
  CHECK_FALSE(claim("-0x1p+0", "0x1p-3").has_value());
  CHECK_FALSE(claim("0x1p+0", "0x0p+0").has_value());
}

TEST_CASE("the size of the set and the limits are sentences of their own") {
  Promises promises = in_lock();
  promises.reach = Ball(0.25);
  promises.rate = Ball(0.9);
  const std::string set =
      R"({"frequency_error_radius": {"lo": "0x1p-2"}, "contraction_rate": {"hi": "0x1.dp-1"}})";
  const Answer found = answer("ekf/invariant-set", "proved", design("{}"), promises, set);
  CHECK(found.objections.empty());
  CHECK(
      found.says("contains frequency errors up to 0.25 rad/sample and none of 3.14 rad/sample or more; in "
                 "it, each sample multiplies the error by at "
                 "most 0.907"));
  promises.reach = Ball(0.24);
  CHECK(!is_verified("ekf/invariant-set", "proved", design("{}"), promises, set));
  const std::string limits = R"({"largest_noise": {"lo": "0x1p-2"}, "largest_slew": {"lo": "0x1p-3"}})";
  promises.noise = Ball(0.25);
  promises.slew = Ball(0.125);
  CHECK(is_verified("ekf/limits", "proved", design("{}"), promises, limits));
  promises.slew = Ball(0.12);
  CHECK(!is_verified("ekf/limits", "proved", design("{}"), promises, limits));
}

TEST_CASE("a requirement that is not known is no requirement of a design") {
  Objections objections;
  const Tree tables = read_json(design(R"({"moon": )" + exactly("1", "0x1p+0") + "}"));
  const Guarantee guarantee(tables, {}, objections);
  CHECK(objections.size() == 1);
  CHECK(guarantee.required().empty());
  CHECK_FALSE(Guarantee::is_guarantee("moon"));
}
