#include "certificates/single_channel/phase_words.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace veritrack;
using certificates::add_words;
using single_channel::PhaseCertificate;
using single_channel::StartFinding;

namespace {

theorems::Condition condition(const char* id, const char* reason = "") {
  theorems::Condition one;
  one.id = id;
  one.reason = reason;
  return one;
}

PhaseCertificate certificate_with(StartFinding::Kind kind) {
  PhaseCertificate certificate;
  certificate.derivation.conditions = {condition("leak", "no leak."), condition("start-in-set")};
  certificate.derivation.conditions.back().rhs = rigor::Interval(0.5);
  certificate.start = StartFinding{kind, 1.25};
  return certificate;
}

}  // namespace

TEST_CASE("the reason why starts are in the set of a contraction over phases, or what would help") {
  const auto reason = [](StartFinding::Kind kind) {
    PhaseCertificate certificate = certificate_with(kind);
    add_words(certificate);
    const theorems::Condition& start = certificate.derivation.conditions.back();
    CHECK(start.statement == "e(0)' P(0)^{-1} e(0) \\le R_0^2");
    REQUIRE(certificate.result.starts.conditions.size() == 2);
    CHECK(certificate.result.starts.conditions.back().reason == start.reason);
    CHECK(certificate.derivation.conditions.front().reason == "no leak.");
    return start.reason;
  };
  CHECK(reason(StartFinding::Kind::in_set) == "every assumed start lies in a certified set.");
  CHECK(reason(StartFinding::Kind::covariance_is_given) ==
        "a given P(0) is not covered; omit initial_covariance to start with the steady state.");
  CHECK(reason(StartFinding::Kind::outside) ==
        "the assumed starts have level about 1.25; the certified set of starts has level 0.5. Smaller "
        "start errors or a narrower [assume] frequency would help.");
}

TEST_CASE("without a set of a contraction over phases nothing is said of starts") {
  PhaseCertificate certificate = certificate_with(StartFinding::Kind::outside);
  certificate.start.reset();
  add_words(certificate);
  CHECK(certificate.derivation.conditions.back().reason.empty());
}
