#include "certificates/guarantee.hpp"

#include <fmt/format.h>

#include "analysis/contraction/quadrature_certificate.hpp"
#include "analysis/contraction/steady_certificate.hpp"
#include "analysis/rigor/decimal.hpp"
#include "trackers/quadrature_rotating_frame.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;
using rigor::Verdict;

constexpr const char* kContraction = "contraction";
constexpr const char* kCapture = "capture";

trackers::QuadratureEkfDesign<Interval> design_at_unit_amplitude(const Design& design) {
  const QuadratureEkfDesign& chosen = design.quadrature_ekf().design;
  return trackers::at_unit_amplitude<Interval>(
      {chosen.q1.value, chosen.q2.value, chosen.r.value, chosen.epsilon.value},
      design.quadrature_ekf().assume.amplitude.value);
}

const theorems::Quantity* find(const theorems::Derivation& derivation, const std::string& name) {
  for (const theorems::Quantity& quantity : derivation.quantities) {
    if (quantity.name == name && !quantity.not_applicable) {
      return &quantity;
    }
  }
  return nullptr;
}

/// What keeps the contraction certificate from covering the assumptions, as a sentence.
std::string contraction_objection(const theorems::Derivation& derivation) {
  for (const theorems::Condition& condition : derivation.conditions) {
    if (condition.verdict != Verdict::proved) {
      return fmt::format("The contraction certificate does not cover it ({}: {})", condition.id,
                         condition.reason);
    }
  }
  return "The contraction certificate gives no bound for the assumed start.";
}

std::string outward(const Interval& value) {
  return rigor::to_decimal(value.upper(), 4, rigor::Direction::up);
}

Claim frequency_error_claim(const Certificate& certificate, const Number& required) {
  const Assumptions& assume = certificate.design.quadrature_ekf().assume;
  const theorems::Derivation& derivation = deciding_derivation(certificate);
  const std::optional<Interval> bound = proved_frequency_bound(certificate);
  Claim claim;
  claim.id = "ekf/frequency-error-bound";
  claim.statement = fmt::format("the frequency error stays below {} rad/sample for ever", required.text);
  claim.required = true;
  claim.position = required.position;
  if (bound && rigor::certainly_less(*bound, required.value)) {
    claim.verdict = Verdict::proved;
    claim.reason = fmt::format("By contraction it stays at or below {} rad/sample.", outward(*bound));
    claim.evidence = {*find(derivation, "frequency_error_bound")};
  } else if (same_number(required, assume.initial_frequency_error) ||
             rigor::certainly_less_equal(required.value, assume.initial_frequency_error.value)) {
    claim.verdict = Verdict::refuted;
    claim.reason = fmt::format(
        "Witness: a start that is wrong by {} rad/sample is allowed by [assume] (initial_frequency_error) "
        "and is not below the bound at the first sample.",
        assume.initial_frequency_error.text);
  } else if (find(derivation, "wrong_lock_frequency_error") != nullptr &&
             rigor::certainly_less_equal(required.value,
                                         find(derivation, "wrong_lock_frequency_error")->value)) {
    claim.verdict = Verdict::refuted;
    claim.reason = contraction_objection(derivation);
    claim.evidence = {*find(derivation, "wrong_lock_frequency_error")};
  } else if (bound) {
    claim.reason = fmt::format("The certified bound is {} rad/sample, which is not below {}.",
                               outward(*bound), required.text);
  } else {
    claim.reason = contraction_objection(derivation);
  }
  return claim;
}

Claim settling_claim(const Certificate& certificate, const Number& required) {
  const theorems::Derivation& derivation = deciding_derivation(certificate);
  const theorems::Quantity* samples = find(derivation, "settling_samples");
  Claim claim;
  claim.id = "ekf/settling-time";
  claim.statement = fmt::format("within {} samples the frequency error comes within twice its ultimate bound",
                                required.text);
  claim.required = true;
  claim.position = required.position;
  if (derivation.verdict == Verdict::proved && samples != nullptr) {
    const bool soon_enough = rigor::certainly_less_equal(samples->value, required.value);
    claim.verdict = soon_enough ? Verdict::proved : Verdict::undecided;
    claim.reason = fmt::format("By contraction it takes at most {} samples{}.", outward(samples->value),
                               soon_enough ? "" : ", which is more; a sharper certificate might do");
    claim.evidence = {*samples};
  } else if (derivation.verdict == Verdict::proved) {
    claim.reason = "Without noise and slew the ultimate bound is zero, which is approached but not reached.";
  } else {
    claim.reason = contraction_objection(derivation);
  }
  return claim;
}

}  // namespace

contraction::ContractionQuestion contraction_question(const Design& design) {
  const Assumptions& assume = design.quadrature_ekf().assume;
  const Interval& amplitude = assume.amplitude.value;
  contraction::ContractionQuestion question;
  question.design = design_at_unit_amplitude(design);
  question.noise = assume.noise.value / amplitude;
  question.slew = assume.slew.value;
  question.initial_amplitude_error = assume.initial_amplitude_error.value / amplitude;
  question.initial_phase_error = assume.initial_phase_error.value;
  question.initial_frequency_error = assume.initial_frequency_error.value;
  if (assume.initial_covariance) {
    rigor::IntervalMatrix<3> covariance;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const auto& entry =
            (*assume.initial_covariance)[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].value;
        const Interval scale = (i < 2 ? amplitude : Interval(1.0)) * (j < 2 ? amplitude : Interval(1.0));
        covariance(i, j) = entry / scale;
      }
    }
    question.initial_covariance = covariance;
  }
  return question;
}

const theorems::Derivation& deciding_derivation(const Certificate& certificate) {
  const theorems::Derivation* found = &certificate.derivations.back();
  for (const char* id : {kContraction, kCapture}) {
    for (const theorems::Derivation& derivation : certificate.derivations) {
      found = derivation.id == id ? &derivation : found;
    }
  }
  return *found;
}

std::optional<Interval> proved_frequency_bound(const Certificate& certificate) {
  const theorems::Derivation& derivation = deciding_derivation(certificate);
  const theorems::Quantity* bound = find(derivation, "frequency_error_bound");
  const bool covered = (derivation.id == kContraction || derivation.id == kCapture) &&
                       derivation.verdict == Verdict::proved && bound != nullptr;
  return covered && rigor::is_finite(bound->value) ? std::optional(bound->value) : std::nullopt;
}

void add_contraction(Certificate& certificate) {
  if (certificate.design.quadrature_ekf().design.epsilon.value == Interval(0.0)) {
    contraction::ContractionCertificate found =
        contraction::certify_contraction(contraction_question(certificate.design));
    certificate.derivations.push_back(std::move(found.derivation));
    const auto keep = [&](const char* purpose, const std::optional<contraction::Verification>& verification) {
      if (verification && verification->verdict == Verdict::proved) {
        certificate.certified_sets.push_back({purpose, verification->set});
      }
    };
    keep("start-error", found.set);
    keep("largest-noise", found.noise_set);
    keep("largest-slew", found.slew_set);
    keep("frequency-error-bound", found.bound_set);
    keep("ultimate-error", found.ultimate_set);
    keep("settling", found.settling_set);
  } else {
    const Assumptions& assume = certificate.design.quadrature_ekf().assume;
    certificate.derivations.push_back(
        contraction::certify_with_leak({contraction_question(certificate.design),
                                        rigor::hull(assume.frequency[0].value, assume.frequency[1].value)})
            .derivation);
  }
}

void add_required_claims(Certificate& certificate) {
  const Requirements& require = certificate.design.quadrature_ekf().require;
  if (require.frequency_error_below) {
    certificate.claims.push_back(frequency_error_claim(certificate, *require.frequency_error_below));
  }
  if (require.settles_within) {
    certificate.claims.push_back(settling_claim(certificate, *require.settles_within));
  }
  conclude_requirements(certificate);
}

void conclude_requirements(Certificate& certificate) {
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

}  // namespace veritrack::certificates
