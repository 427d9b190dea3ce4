#include "analysis/quadrature/contraction/set_search.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "analysis/quadrature/contraction/promises.hpp"
#include "analysis/quadrature/contraction/quadrature_certificate.hpp"
#include "analysis/quadrature/start_covariance.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;
using rigor::Verdict;

constexpr std::array<std::array<double, 2>, 4> kPublishedDesigns{
    {{0.0005, 0.01}, {0.0013, 0.01}, {0.0065, 0.01}, {0.0023, 0.05}}};

/// A start of 0.005 in each coordinate, noise of 0.001; the error is to stay below 0.05 and to settle.
sets::ContractionQuestion question_with_requirements(double q, double r) {
  sets::ContractionQuestion question;
  question.design = {Interval(q), Interval(q), Interval(r), Interval(0.0)};
  question.noise = Interval(0.001);
  question.initial_frequency_error = Interval(0.005);
  question.initial_phase_error = Interval(0.005);
  question.initial_amplitude_error = Interval(0.005);
  question.settled_frequency_error = 0.002;
  question.required = {0.05, 200.0};
  question.with_samples = false;
  return question;
}

/// As certify_contraction asks it, with the start covariance.
sets::ContractionQuestion complete(const sets::ContractionQuestion& asked) {
  return with_start_covariance(asked, 0.0);
}

TEST_CASE("a sufficient set is a certified set that does all that is required") {
  for (const auto& [q, r] : kPublishedDesigns) {
    const sets::ContractionQuestion asked = complete(question_with_requirements(q, r));
    const std::optional<Verification> found = find_sufficient_set(asked);
    REQUIRE(found.has_value());
    CHECK(verify_certified_set(asked.design, found->set).verdict == Verdict::proved);
    const rigor::UpwardRounding upward;
    const Promises promises(asked, {found->set});
    CHECK(promises.satisfy(asked.required));
    CHECK(promises.starts_inside());
    CHECK(promises.frequency_error_bound().upper() < 0.05);
  }
}

TEST_CASE("a search stops there when that is all it is asked for") {
  sets::ContractionQuestion asked = question_with_requirements(0.0023, 0.05);
  asked.effort = sets::SearchEffort::sufficient;
  const ContractionCertificate found = certify_contraction(asked);
  CHECK(found.derivation.verdict == Verdict::proved);
  CHECK(found.set.has_value());
  CHECK_FALSE(found.bound_set.has_value());
  CHECK_FALSE(found.noise_set.has_value());
}

TEST_CASE("what is beyond every set is not proved, quickly or not") {
  // Below the error at the start; below what noise alone does; after no sample at all.
  for (const sets::RequiredBounds& required :
       {sets::RequiredBounds{0.004, std::nullopt}, sets::RequiredBounds{0.05, 0.0},
        sets::RequiredBounds{std::numeric_limits<double>::quiet_NaN(), std::nullopt},
        sets::RequiredBounds{0.05, std::numeric_limits<double>::quiet_NaN()}}) {
    sets::ContractionQuestion asked = question_with_requirements(0.0023, 0.05);
    asked.required = required;
    CHECK_FALSE(find_sufficient_set(complete(asked)).has_value());
    asked.effort = sets::SearchEffort::quick;
    const ContractionCertificate found = certify_contraction(asked);
    CHECK(found.derivation.verdict == Verdict::undecided);
    CHECK_FALSE(found.set.has_value());
  }
  sets::ContractionQuestion asked = question_with_requirements(0.0023, 0.05);
  asked.settled_frequency_error = 1e-6;
  CHECK_FALSE(find_sufficient_set(complete(asked)).has_value());
  asked.settled_frequency_error.reset();
  CHECK_FALSE(find_sufficient_set(complete(asked)).has_value());
}

TEST_CASE("nothing that is required makes nothing sufficient") {
  sets::ContractionQuestion asked = question_with_requirements(0.0023, 0.05);
  asked.required = {};
  CHECK_FALSE(find_sufficient_set(complete(asked)).has_value());
}

TEST_CASE("promises satisfy what they prove, and no less") {
  const sets::ContractionQuestion asked = complete(question_with_requirements(0.0023, 0.05));
  const std::optional<Verification> found = find_sufficient_set(asked);
  REQUIRE(found.has_value());
  const rigor::UpwardRounding upward;
  const Promises promises(asked, {found->set});
  const double bound = promises.frequency_error_bound().upper();
  CHECK(promises.satisfy({std::nextafter(bound, 1.0), std::nullopt}));
  CHECK_FALSE(promises.satisfy({bound, std::nullopt}));
  const auto settling = promises.settling();
  REQUIRE(settling.has_value());
  CHECK(promises.satisfy({std::nullopt, settling->samples.upper()}));
  CHECK_FALSE(promises.satisfy({std::nullopt, settling->samples.upper() - 1.0}));
  CHECK_FALSE(Promises(asked, {}).satisfy({1.0, std::nullopt}));
}

}  // namespace
}  // namespace veritrack::quadrature
