#include "certificates/quadrature/quadrature_certificate.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "analysis/theorems/other_results/other_results.hpp"
#include "analysis/theorems/theorem_2_9.hpp"
#include "analysis/theorems/theorem_2_9_feasibility.hpp"
#include "analysis/theorems/theorem_2_9_gaps.hpp"
#include "analysis/theorems/theorem_2_9_repaired.hpp"
#include "certificates/quadrature/capture.hpp"
#include "certificates/quadrature/comparison_table.hpp"
#include "certificates/quadrature/guarantee.hpp"
#include "certificates/quadrature/lock.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"
#include "certificates/quadrature/quadrature_simulation.hpp"
#include "certificates/sets/assumptions.hpp"
#include "certificates/sets/guarantee_sentence.hpp"
#include "certificates/sets/required_claims.hpp"
#include "certificates/sets/statement_claim.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;
using rigor::Verdict;

/// The theorem is stated for unit amplitude.
theorems::Theorem29Input theorem_input(const QuadratureEkfTables& tables) {
  const Assumptions& assume = tables.assume;
  const trackers::ToneModel<Interval> model = enclosed_at_unit_amplitude(tables);
  theorems::Theorem29Input input;
  input.q1 = model.q1;
  input.q2 = model.q2;
  input.r = model.r;
  input.epsilon = model.epsilon;
  input.state_bound = tables.theorem_2_9.state_bound.value;
  input.sigma = tables.theorem_2_9.sigma.value;
  input.gamma_fraction = tables.theorem_2_9.gamma_fraction.value;
  input.c1 = tables.theorem_2_9.c1.value;
  input.c2 = tables.theorem_2_9.c2.value;
  input.q1_equals_q2 =
      assume.amplitude.value == Interval(1.0) && same_number(tables.design.q1, tables.design.q2);
  // |w(k)| = |omega(k+1) - (1 - epsilon) omega(k)|: at most the slew plus epsilon |omega|, and at constant
  // frequency the latter.
  const Interval largest_frequency =
      rigor::max(rigor::abs(assume.frequency[0].value), rigor::abs(assume.frequency[1].value));
  const Interval leaked = tables.design.epsilon.value * largest_frequency;
  input.process_noise = rigor::hull(leaked, leaked + assume.slew.value);
  input.measurement_noise = assume.noise.value / assume.amplitude.value;
  input.largest_state = rigor::sqrt(Interval(1.0) + rigor::square(largest_frequency));
  input.initial_error = theorems::largest_initial_error(
      Interval(1.0), assume.initial_amplitude_error.value / assume.amplitude.value,
      assume.initial_phase_error.value, assume.initial_frequency_error.value);
  return input;
}

/// The design for which the other results are evaluated, also at unit amplitude.
theorems::TrackerInput tracker_input(const QuadratureEkfTables& tables,
                                     const theorems::Theorem29Input& theorem) {
  const Assumptions& assume = tables.assume;
  theorems::TrackerInput input{theorem, covariance_at_unit_amplitude(assume)};
  if (const auto& range = assume.covariance_range) {
    input.initial_covariance = covariance_at_unit_amplitude((*range)[0], assume.amplitude);
    input.largest_initial_covariance = covariance_at_unit_amplitude((*range)[1], assume.amplitude);
  }
  input.starts_from_multiples = assume.covariance_multiples.has_value();
  return input;
}

/// "Theorem 2.9 applies", one claim for each reading: the conditions, not the theorem's conclusion.
Claim applicability_claim(const theorems::Derivation& derivation) {
  Claim claim;
  claim.id = derivation.id + "/conditions";
  claim.statement =
      fmt::format("The design and the assumed start satisfy all conditions of {}.", derivation.title);
  claim.verdict = derivation.verdict;
  claim.reason = "All conditions are satisfied.";
  for (const theorems::Condition& condition : derivation.conditions) {
    if (condition.verdict != Verdict::proved && (claim.verdict == condition.verdict)) {
      claim.reason = fmt::format("({}): {}", condition.id, condition.reason);
      break;
    }
  }
  return claim;
}

}  // namespace

void quadrature_published_results(Certificate& certificate) {
  certificate.particulars = QuadratureParticulars{};
  certificate.simulation = simulate_quadrature(certificate.design);
  const QuadratureEkfTables& tables = quadrature_tables(certificate.design);
  const theorems::Theorem29Input input = theorem_input(tables);
  const Number& amplitude = tables.assume.amplitude;
  const theorems::Trajectory trajectory =
      at_unit_amplitude(certificate.simulation.trajectory, amplitude.nearest);
  for (const auto variant : {theorems::Theorem29Variant::printed, theorems::Theorem29Variant::errata}) {
    const theorems::Theorem29 theorem = theorems::evaluate_theorem_2_9(variant, input);
    certificate.derivations.push_back(theorem.derivation);
    certificate.derivations.back().feasibility = theorems::theorem_2_9_feasibility(variant, input);
    quadrature_particulars(certificate)
        .audits.push_back({theorem.derivation.id, theorems::audit_theorem_2_9(theorem, input, trajectory)});
    certificate.claims.push_back(applicability_claim(theorem.derivation));
  }
  certificate.derivations.push_back(theorems::derive_repaired_theorem(tracker_input(tables, input)));
  certificate.derivations.back().notes.emplace_back(
      "The start covariance is the filter's steady state along exact estimates unless the design file gives "
      "a matrix.");
  certificate.claims.push_back(applicability_claim(certificate.derivations.back()));
  for (const theorems::Statement& statement : theorems::theorem_2_9_gaps(input)) {
    certificate.claims.push_back(to_claim(statement));
  }
  for (theorems::Derivation& result : theorems::evaluate_other_results(tracker_input(tables, input))) {
    certificate.claims.push_back(applicability_claim(result));
    certificate.derivations.push_back(std::move(result));
  }
  if (!(amplitude.value == Interval(1.0))) {
    for (theorems::Derivation& derivation : certificate.derivations) {
      derivation.notes.push_back(
          fmt::format("The theorem is stated for a signal of amplitude 1. Its constants are those of the "
                      "equivalent filter at amplitude 1: this filter runs at amplitude {}, and q1, r and the "
                      "noise are scaled by the amplitude.",
                      amplitude.text));
    }
  }
}

void certify_quadrature(Certificate& certificate, const CertifyProgress& progress) {
  const QuadratureEkfTables& tables = quadrature_tables(certificate.design);
  if (tables.assume.gaussian) {
    // The published results are also about noise with a bound.
    certificate.particulars = QuadratureParticulars{};
    certificate.simulation = simulate_quadrature(certificate.design);
    add_lock(certificate);
    return;
  }
  const bool only_verdicts = certificate.extent == Extent::verdicts || certificate.extent == Extent::quick;
  if (only_verdicts) {
    certificate.particulars = QuadratureParticulars{};
  } else {
    quadrature_published_results(certificate);
  }
  add_contraction(certificate);
  if (certificate.extent != Extent::quick) {
    add_capture(certificate, progress);
  }
  if (!only_verdicts) {
    add_comparison(certificate);
  }
  const GuaranteeTerms terms{tables.assume,
                             tables.require,
                             !tables.design.without_leak(),
                             true,
                             start_covariance_words(certificate),
                             kDoublePrecision};
  add_required_claims(certificate, terms);
  certificate.claims.push_back(guarantee_claim(certificate, terms));
  for (Claim& claim : set_claims(certificate, terms)) {
    certificate.claims.push_back(std::move(claim));
  }
}

}  // namespace veritrack::certificates
