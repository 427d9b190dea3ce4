#include <fmt/format.h>

#include <stdexcept>

#include "analysis/rigor/decimal.hpp"
#include "analysis/theorems/theorem_2_9.hpp"
#include "certificates/certificate.hpp"
#include "certificates/design_reader.hpp"
#include "certificates/simulation.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;
using rigor::Verdict;

/// The same decimal, and so the same real number.
bool same_number(const Number& a, const Number& b) {
  return a.text == b.text || a.value == b.value;
}

/// The theorem is stated for unit amplitude. The filter (q1, r, noise v) at amplitude A is the filter
/// (q1/A^2, r/A^2, v/A) at amplitude 1.
theorems::Theorem29Input theorem_input(const Design& design) {
  const Assumptions& assume = design.assume;
  const Interval amplitude_squared = rigor::square(assume.amplitude.value);
  theorems::Theorem29Input input;
  input.q1 = design.design.q1.value / amplitude_squared;
  input.q2 = design.design.q2.value;
  input.r = design.design.r.value / amplitude_squared;
  input.epsilon = design.design.epsilon.value;
  input.state_bound = design.theorem_2_9.state_bound.value;
  input.sigma = design.theorem_2_9.sigma.value;
  input.gamma_fraction = design.theorem_2_9.gamma_fraction.value;
  input.c1 = design.theorem_2_9.c1.value;
  input.c2 = design.theorem_2_9.c2.value;
  input.q1_equals_q2 =
      assume.amplitude.value == Interval(1.0) && same_number(design.design.q1, design.design.q2);
  // |w(k)| = |omega(k+1) - (1 - epsilon) omega(k)|: at most the slew plus epsilon |omega|, and at constant
  // frequency the latter.
  const Interval largest_frequency =
      rigor::max(rigor::abs(assume.frequency[0].value), rigor::abs(assume.frequency[1].value));
  const Interval leaked = design.design.epsilon.value * largest_frequency;
  input.process_noise = rigor::hull(leaked, leaked + assume.slew.value);
  input.measurement_noise = assume.noise.value / assume.amplitude.value;
  input.largest_state = rigor::sqrt(Interval(1.0) + rigor::square(largest_frequency));
  input.initial_error = theorems::largest_initial_error(
      Interval(1.0), assume.initial_amplitude_error.value / assume.amplitude.value,
      assume.initial_phase_error.value, assume.initial_frequency_error.value);
  return input;
}

/// "Theorem 2.9 applies", one claim a reading: the conditions, not what the theorem concludes from them.
Claim applicability_claim(const theorems::Derivation& derivation) {
  Claim claim;
  claim.id = derivation.id + "/conditions";
  claim.statement =
      fmt::format("All conditions of {} hold for the design and the assumed start.", derivation.title);
  claim.verdict = derivation.verdict;
  claim.reason = "All conditions are PROVED.";
  for (const theorems::Condition& condition : derivation.conditions) {
    if (condition.verdict != Verdict::proved && (claim.verdict == condition.verdict)) {
      claim.reason = fmt::format("({}): {}", condition.id, condition.reason);
      break;
    }
  }
  return claim;
}

/// Why nothing that this program knows establishes a requirement.
std::string no_method_reason(const Certificate& certificate) {
  std::string readings;
  for (const theorems::Derivation& derivation : certificate.derivations) {
    readings += readings.empty() ? "" : ", ";
    readings += fmt::format("{}: {}", derivation.id, rigor::to_string(derivation.verdict));
  }
  return fmt::format(
      "No method of this version establishes it. Theorem 2.9 could, if its conditions held and its proof "
      "were sound; the "
      "verdicts on its conditions are: {}.",
      readings);
}

Claim frequency_error_claim(const Certificate& certificate, const Number& required) {
  const Assumptions& assume = certificate.design.assume;
  Claim claim;
  claim.id = "ekf/frequency-error-bound";
  claim.statement = fmt::format("the frequency error stays below {} rad/sample for ever", required.text);
  claim.required = true;
  claim.position = required.position;
  if (same_number(required, assume.initial_frequency_error) ||
      rigor::certainly_less_equal(required.value, assume.initial_frequency_error.value)) {
    claim.verdict = Verdict::refuted;
    claim.reason = fmt::format(
        "Witness: a start that is wrong by {} rad/sample is allowed by [assume] (initial_frequency_error) "
        "and is not "
        "below the bound at the first sample.",
        assume.initial_frequency_error.text);
  } else {
    claim.reason = no_method_reason(certificate);
  }
  return claim;
}

Claim settling_claim(const Certificate& certificate, const Number& required) {
  Claim claim;
  claim.id = "ekf/settling-time";
  claim.statement = fmt::format("within {} samples the frequency error comes within twice its ultimate bound",
                                required.text);
  claim.required = true;
  claim.position = required.position;
  claim.reason = no_method_reason(certificate);
  return claim;
}

void add_required_claims(Certificate& certificate) {
  const Requirements& require = certificate.design.require;
  if (require.frequency_error_below) {
    certificate.claims.push_back(frequency_error_claim(certificate, *require.frequency_error_below));
  }
  if (require.settles_within) {
    certificate.claims.push_back(settling_claim(certificate, *require.settles_within));
  }
  std::vector<Verdict> verdicts;
  for (const Claim& claim : certificate.claims) {
    if (claim.required) {
      verdicts.push_back(claim.verdict);
    }
  }
  if (!verdicts.empty()) {
    certificate.verdict = rigor::conjunction(verdicts);
  }
}

}  // namespace

std::string verdict_text(const Certificate& certificate) {
  return certificate.verdict ? std::string(rigor::to_string(*certificate.verdict)) : "nothing-required";
}

Certificate certify(const Design& design, const std::string& design_file, const std::string& design_text) {
  if (design.tracker != "quadrature-ekf") {
    throw std::invalid_argument("no certificates for tracker " + design.tracker);
  }
  const rigor::UpwardRounding upward;
  Certificate certificate;
  certificate.design = design;
  certificate.design_file = design_file;
  certificate.design_text = design_text;

  const theorems::Theorem29Input input = theorem_input(design);
  certificate.simulation = simulate(design);
  const theorems::Trajectory trajectory =
      at_unit_amplitude(certificate.simulation.trajectory, design.assume.amplitude.nearest);
  for (const auto variant : {theorems::Theorem29Variant::printed, theorems::Theorem29Variant::errata}) {
    const theorems::Theorem29 theorem = theorems::evaluate_theorem_2_9(variant, input);
    certificate.derivations.push_back(theorem.derivation);
    certificate.audits.push_back(
        {theorem.derivation.id, theorems::audit_theorem_2_9(theorem, input, trajectory)});
    certificate.claims.push_back(applicability_claim(theorem.derivation));
  }
  if (!(design.assume.amplitude.value == Interval(1.0))) {
    for (theorems::Derivation& derivation : certificate.derivations) {
      derivation.notes.push_back(
          fmt::format("The theorem is stated for a signal of amplitude 1. Its constants are those of the "
                      "filter that does at amplitude 1 "
                      "what this one does at amplitude {}: q1, r and the noise scaled by the amplitude.",
                      design.assume.amplitude.text));
    }
  }
  add_required_claims(certificate);
  return certificate;
}

Certificate certify_file(const std::filesystem::path& path) {
  const std::string text = read_design_text(path);
  return certify(read_design(text, path.string()), path.filename().string(), text);
}

}  // namespace veritrack::certificates
