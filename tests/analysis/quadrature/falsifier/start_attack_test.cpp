#include "analysis/quadrature/falsifier/start_attack.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

#include "analysis/quadrature/capture/capture_starts.hpp"
#include "analysis/quadrature/contraction/quadrature_certificate.hpp"
#include "analysis/quadrature/leak/steady_certificate.hpp"
#include "analysis/quadrature/start_covariance.hpp"
#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

/// q1 = q2, a start, noise and slew.
sets::ContractionQuestion question(double q, double r, double start, double noise, double slew) {
  sets::ContractionQuestion asked;
  asked.design = {Interval(q), Interval(q), Interval(r), Interval(0.0)};
  asked.initial_amplitude_error = asked.initial_phase_error = asked.initial_frequency_error = Interval(start);
  asked.noise = Interval(noise);
  asked.slew = Interval(slew);
  asked.search_evaluations = 20;
  asked.with_samples = false;
  return asked;
}

/// With all P(0|0) between these multiples of near_steady_covariance.
sets::ContractionQuestion with_multiples(const sets::ContractionQuestion& asked, double frequency,
                                         const Interval& multiples) {
  sets::ContractionQuestion wide = with_start_covariance(asked, frequency);
  wide.start_covariance->multiples = multiples;
  wide.start_covariance->is_given = true;
  return wide;
}

StartAttackOptions options(std::int64_t starts) {
  StartAttackOptions found;
  found.starts = test::effort(starts);
  return found;
}

/// No start exceeds the bound; and they come near to it.
void holds(const char* name, const sets::ContractionQuestion& asked, const Interval& band, double bound,
           double least_ratio) {
  const StartAttack found = attack_starts(asked, band, options(60));
  CAPTURE(name);
  CAPTURE(test::kSeed);
  CHECK(found.at_start <= bound);
  CHECK(found.frequency_error <= bound);
  CHECK(found.frequency_error >= least_ratio * bound);
  MESSAGE(std::string(name) << ": P(0|0) from " << asked.start_covariance->multiples.lower() << " M to "
                            << asked.start_covariance->multiples.upper() << " M, " << found.runs << " runs, "
                            << found.steps << " steps; the frequency error reaches "
                            << found.frequency_error / bound << " of the bound " << bound);
}

TEST_CASE("no P(0|0) of the certified range exceeds the bound") {
  struct Design {
    const char* name;
    double q, r, start, noise, slew;
  };
  const Interval band = Interval::from_bounds(0.05, 3.0);
  for (const Design& d : {Design{"La Scala 3.5", 0.0023, 0.05, 0.005, 0.001, 0.0},
                          Design{"fast, with slew", 0.0013, 0.01, 0.01, 0.003, 1e-4}}) {
    const sets::ContractionQuestion asked = question(d.q, d.r, d.start, d.noise, d.slew);
    const ContractionCertificate found = certify_contraction(asked);
    REQUIRE(found.result.starts.proved_bound().has_value());
    const Interval multiples = found.result.starts.covariance_multiples.value();
    CHECK(multiples.lower() < 1.0);
    CHECK(multiples.upper() > 1.0);
    holds(d.name, with_multiples(asked, 0.0, multiples), band, found.result.starts.proved_bound()->upper(),
          0.5);
  }
}

TEST_CASE("a range that is asked for is covered, and no P(0|0) in it exceeds the bound") {
  const sets::ContractionQuestion asked =
      with_multiples(question(0.0023, 0.05, 0.005, 0.001, 0.0), 0.0, Interval::from_bounds(0.6, 1.6));
  const ContractionCertificate found = certify_contraction(asked);
  REQUIRE(found.result.starts.proved_bound().has_value());
  CHECK(rigor::identical(found.result.starts.covariance_multiples.value(), Interval::from_bounds(0.6, 1.6)));
  holds("asked for", asked, Interval::from_bounds(0.05, 3.0), found.result.starts.proved_bound()->upper(),
        0.4);
}

TEST_CASE("with a leak, no P(0|0) of the range that is asked for exceeds the bound") {
  sets::ContractionQuestion asked = question(0.0013, 0.01, 0.0005, 0.001, 0.0);
  asked.design.epsilon = Interval(0.01);
  const Interval band = Interval::from_bounds(0.02, 0.03);
  asked = with_multiples(asked, midpoint(band), Interval::from_bounds(0.97, 1.03));
  const LeakCertificate found = certify_with_leak({asked, band});
  REQUIRE(found.result.starts.proved_bound().has_value());
  holds("with a leak", asked, band, found.result.starts.proved_bound()->upper(), 0.02);
}

TEST_CASE("starts that are followed keep the bound from the printed matrix, and not from 100 times it") {
  sets::ContractionQuestion asked = question(0.0023, 0.05, 0.1, 0.001, 0.0);
  asked.initial_phase_error = Interval(0.8);
  asked.initial_frequency_error = Interval(0.5);
  asked = with_start_covariance(asked, 0.0);
  const ContractionCertificate certificate = certify_contraction(asked);
  REQUIRE(certificate.set.has_value());
  const StartCapture found = capture_starts(asked, certificate.set->set, "capture", 4000);
  REQUIRE(found.result.proved_bound().has_value());
  const double bound = found.result.proved_bound()->upper();
  const Interval band = Interval::from_bounds(0.05, 3.0);
  holds("followed", asked, band, bound, 0.8);
  const StartAttack far = attack_starts(with_multiples(asked, 0.0, Interval(100.0)), band, options(30));
  MESSAGE("from 100 M the frequency error reaches " << far.frequency_error / bound << " of the bound "
                                                    << bound);
  CHECK(far.frequency_error > bound);
}

TEST_CASE("the same question gets the same answer, and an empty one is refused") {
  const sets::ContractionQuestion asked =
      with_multiples(question(0.0023, 0.05, 0.005, 0.001, 1e-4), 0.0, Interval::from_bounds(0.5, 2.0));
  StartAttackOptions few;
  few.starts = 6;
  const StartAttack one = attack_starts(asked, Interval(1.0), few);
  const StartAttack two = attack_starts(asked, Interval(1.0), few);
  CHECK(one.frequency_error == two.frequency_error);
  CHECK(one.runs == two.runs);
  CHECK(one.attack.inputs.size() == static_cast<std::size_t>(few.steps));
  sets::ContractionQuestion none = asked;
  none.start_covariance.reset();
  CHECK_THROWS_AS(static_cast<void>(attack_starts(none, Interval(1.0))), std::invalid_argument);
  sets::ContractionQuestion reversed = asked;
  reversed.start_covariance->highest = asked.start_covariance->matrix * Interval(0.1);
  CHECK_THROWS_AS(static_cast<void>(attack_starts(reversed, Interval(1.0))), std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::quadrature
