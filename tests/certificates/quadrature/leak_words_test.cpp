#include "certificates/quadrature/leak_words.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace veritrack;
using certificates::add_words;
using quadrature::LeakCertificate;
using quadrature::SteadyStart;

namespace {

theorems::Condition condition(const char* id, const char* reason = "") {
  theorems::Condition one;
  one.id = id;
  one.reason = reason;
  return one;
}

std::string reason_of(const SteadyStart& start, const std::string& covariance_range = {}) {
  LeakCertificate certificate;
  certificate.derivation.conditions = {condition("steady-state", "verified"), condition("start-in-set")};
  certificate.start = quadrature::SteadyStartFinding{start, 0.25, covariance_range};
  add_words(certificate);
  const auto& conditions = certificate.derivation.conditions;
  CHECK(conditions.front().reason == "verified");
  CHECK(conditions.back().statement ==
        "|T (e - e^*)| \\le 1,\\ -\\Delta_{lo} \\le P - P^* \\le \\Delta_{hi}");
  REQUIRE(certificate.result.starts.conditions.size() == 2);
  CHECK(certificate.result.starts.conditions.back().reason == conditions.back().reason);
  return conditions.back().reason;
}

}  // namespace

TEST_CASE("how starts come into the set around a steady state, or what would help") {
  SteadyStart start;
  CHECK(reason_of(start) ==
        "the initial covariance is not proved to lie between the bounds of the certified set.");
  start.failure = "one is lost";
  CHECK(
      reason_of(start, "P(0|0) from M to 2 M") ==
      "P(0|0) from M to 2 M is not proved to lie between the bounds of the certified set, and one is lost.");
  start.level = 1.5;
  CHECK(reason_of(start).ends_with(
      " rad/sample, and one is lost: a smaller leak epsilon, a narrower [assume] frequency or smaller start "
      "errors would help."));
  start.failure.clear();
  CHECK(reason_of(start).starts_with("the assumed starts have level 1.5"));
  start.reached = true;
  CHECK(reason_of(start) ==
        "every assumed start lies in the certified set around the steady state of its frequency.");
  start.samples = 7;
  CHECK(reason_of(start).find(" of its frequency within 7 samples, with a frequency error of at most ") !=
        std::string::npos);
}

TEST_CASE("where the lock branch ends inside the band, everything says what helps") {
  LeakCertificate certificate;
  certificate.derivation.conditions = {condition("steady-state", "it ends")};
  certificate.derivation.quantities = sets::quantities_of(certificate.result);
  for (theorems::Quantity* quantity : sets::quantities_in(certificate.result)) {
    quantity->not_applicable = "it ends";
  }
  const auto advice = [&](double ends_at) {
    LeakCertificate worded = certificate;
    worded.branch_ends_at = ends_at;
    add_words(worded);
    const std::string reason = worded.derivation.conditions.front().reason;
    for (const theorems::Quantity& quantity : sets::quantities_of(worded.result)) {
      CHECK(quantity.not_applicable == reason);
    }
    return reason;
  };
  const std::string end =
      " rad/sample, or take a smaller leak epsilon or a larger q2, which extend the verified branch";
  CHECK(advice(2.38279) == "it ends; restrict [assume] frequency to at most 2.382" + end);
  CHECK(advice(-2.38279) == "it ends; restrict [assume] frequency to at least -2.382" + end);
}
