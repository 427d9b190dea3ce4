#include "checker/sets/guarantee.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace veritrack::checker;

namespace {

std::string number(const std::string& text, const std::string& lo, const std::string& hi) {
  return R"({"text": ")" + text + R"(", "lo": ")" + lo + R"(", "hi": ")" + hi + R"(", "decimal": "[-9, 9]"})";
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

const std::string start =
    "started within 0.5 rad/sample of the true frequency, 0.25 rad of the phase and 0.25 of the amplitude "
    "(2.0), ";
const std::string below = R"({"frequency_error_below": )" + exactly("0.75", "0x1.8p-1") + "}";

bool is_verified(const std::string& id, const std::string& statement, const std::string& verdict,
                 const std::string& tables, const Promises& promises,
                 Frequencies frequencies = Frequencies::every) {
  const Tree certificate = read_json(R"({"design": )" + tables + "}");
  const Tree claim = read_json(R"({"id": ")" + id + R"(", "statement": ")" + statement +
                               R"(", "verdict": ")" + verdict + R"(", "evidence": {}})");
  Objections objections;
  check_guarantee(claim, certificate, promises, frequencies, objections);
  return objections.empty();
}

Promises bound(double value) {
  Promises promises;
  promises.bound = Ball(value);
  return promises;
}

}  // namespace

TEST_CASE("the frequency error stays below what is asked") {
  const std::string tables = design(below);
  const std::string statement = "the frequency error stays below 0.75 rad/sample for ever";
  const char* id = "ekf/frequency-error-bound";
  CHECK(requirements(read_json(tables)) == std::vector<std::string>{id});
  CHECK(is_verified(id, statement, "proved", tables, bound(0.7)));
  CHECK(!is_verified(id, statement, "proved", tables, bound(0.75)));
  CHECK(!is_verified(id, statement, "proved", tables, Promises{}));
  CHECK(!is_verified(id, statement, "refuted", tables, Promises{}));
  CHECK(!is_verified(id, "the frequency error stays below 0.7 rad/sample for ever", "proved", tables,
                     bound(0.6)));
  // A start that is off by as much as the limit refutes it.
  const std::string less = design(R"({"frequency_error_below": )" + exactly("0.5", "0x1p-1") + "}");
  CHECK(is_verified(id, "the frequency error stays below 0.5 rad/sample for ever", "refuted", less,
                    Promises{}));
}

TEST_CASE("the sentence is the one that the assumptions make") {
  const std::string assumed = "With measurement noise of at most 0.125 and at a constant frequency, ";
  const std::string stays = "the frequency error stays below 0.75 rad/sample for ever: it never exceeds ";
  const std::string tables = design(below);
  const auto sentence = [&](const std::string& number) {
    return assumed + start + stays + number + " rad/sample.";
  };
  CHECK(is_verified("ekf/guarantee", sentence("0.7"), "proved", tables, bound(0.7)));
  CHECK(!is_verified("ekf/guarantee", sentence("0.69"), "proved", tables, bound(0.7)));
  CHECK(!is_verified("ekf/guarantee", sentence("0.8"), "proved", tables, bound(0.8)));
  CHECK(!is_verified("ekf/guarantee", sentence("0.7"), "proved", tables, Promises{}));
  const std::string quieter = "With measurement noise of at most 0.25 and at a constant frequency, ";
  CHECK(!is_verified("ekf/guarantee", quieter + start + stays + "0.7 rad/sample.", "proved", tables,
                     bound(0.7)));
}

TEST_CASE("a guarantee for the assumed band says so, and no other") {
  const std::string banded =
      "With measurement noise of at most 0.125 and at a constant frequency between 0.25 and 3.0 rad/sample, ";
  const std::string unbanded = "With measurement noise of at most 0.125 and at a constant frequency, ";
  const std::string ends = "the frequency error never exceeds 0.7 rad/sample.";
  const auto is_proved = [&](const std::string& assumed, Frequencies frequencies) {
    return is_verified("ekf/guarantee", assumed + start + ends, "proved", design("{}"), bound(0.7),
                       frequencies);
  };
  CHECK(is_proved(banded, Frequencies::assumed_band));
  CHECK(!is_proved(unbanded, Frequencies::assumed_band));
  CHECK(is_proved(unbanded, Frequencies::every));
  CHECK(!is_proved(banded, Frequencies::every));
}

TEST_CASE("sizes of sets: noise is certified relative to the amplitude") {
  const std::string tables = design(R"({"largest_noise_at_least": )" + exactly("0.5", "0x1p-1") + "}");
  const std::string statement =
      "at a constant frequency, the tracker tolerates noise up to 0.5: a certified invariant set exists";
  Promises promises;
  promises.noise = Ball(0.25);
  CHECK(is_verified("ekf/largest-noise", statement, "proved", tables, promises));
  promises.noise = Ball(0.24);
  CHECK(!is_verified("ekf/largest-noise", statement, "proved", tables, promises));
  CHECK(!is_verified("ekf/largest-noise", statement, "proved", tables, Promises{}));
}

TEST_CASE("a requirement that is not known has no claim") {
  const Tree tables = read_json(design(R"({"moon": {}})"));
  CHECK(requirements(tables) == std::vector<std::string>{"moon"});
  CHECK(!is_guarantee("moon"));
}
