#include "certificates/quadrature/guarantee.hpp"

#include "analysis/quadrature/contraction/quadrature_certificate.hpp"
#include "analysis/quadrature/leak/steady_certificate.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"
#include "certificates/sets/assumptions.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;
using rigor::Verdict;

trackers::QuadratureEkfDesign<Interval> design_at_unit_amplitude(const Design& design) {
  const QuadratureDesignTable& chosen = quadrature_tables(design).design;
  return trackers::at_unit_amplitude<Interval>(
      {chosen.q1.value, chosen.q2.value, chosen.r.value, chosen.epsilon.value},
      quadrature_tables(design).assume.amplitude.value);
}

}  // namespace

sets::ContractionQuestion contraction_question(const Design& design) {
  return contraction_question(design_at_unit_amplitude(design), quadrature_tables(design).assume);
}

sets::ContractionQuestion contraction_question(const trackers::QuadratureEkfDesign<Interval>& design,
                                               const Assumptions& assume) {
  const Interval& amplitude = assume.amplitude.value;
  sets::ContractionQuestion question;
  question.design = design;
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

const theorems::Derivation* deciding_derivation(const Certificate& certificate) {
  const theorems::Derivation* capture = find_derivation(certificate, "capture");
  return capture != nullptr ? capture : find_derivation(certificate, "contraction");
}

std::optional<Interval> proved_frequency_bound(const Certificate& certificate) {
  const theorems::Derivation* derivation = deciding_derivation(certificate);
  if (derivation == nullptr || derivation->verdict != Verdict::proved) {
    return std::nullopt;
  }
  const theorems::Quantity* bound = theorems::applicable_quantity(*derivation, "frequency_error_bound");
  return bound != nullptr && rigor::is_finite(bound->value) ? std::optional(bound->value) : std::nullopt;
}

void add_contraction(Certificate& certificate) {
  if (quadrature_tables(certificate.design).design.epsilon.value == Interval(0.0)) {
    quadrature::ContractionCertificate found =
        quadrature::certify_contraction(contraction_question(certificate.design));
    certificate.derivations.push_back(std::move(found.derivation));
    const auto keep = [&](const char* purpose, const std::optional<quadrature::Verification>& verification) {
      if (verification && verification->verdict == Verdict::proved) {
        quadrature_particulars(certificate).certified_sets.push_back({purpose, verification->set});
      }
    };
    keep("start-error", found.set);
    keep("largest-noise", found.noise_set);
    keep("largest-slew", found.slew_set);
    keep("frequency-error-bound", found.bound_set);
    keep("ultimate-error", found.ultimate_set);
    keep("settling", found.settling_set);
  } else {
    const Assumptions& assume = quadrature_tables(certificate.design).assume;
    certificate.derivations.push_back(
        quadrature::certify_with_leak({contraction_question(certificate.design),
                                       rigor::hull(assume.frequency[0].value, assume.frequency[1].value)})
            .derivation);
  }
}

}  // namespace veritrack::certificates
