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

trackers::ToneModel<Interval> design_at_unit_amplitude(const Design& design) {
  const QuadratureDesignTable& chosen = quadrature_tables(design).design;
  return trackers::at_unit_amplitude<Interval>(
      {chosen.q1.value, chosen.q2.value, chosen.r.value, chosen.epsilon.value},
      quadrature_tables(design).assume.amplitude.value);
}

}  // namespace

sets::ContractionQuestion contraction_question(const Design& design) {
  return contraction_question(design_at_unit_amplitude(design), quadrature_tables(design).assume);
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
