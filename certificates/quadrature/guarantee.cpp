#include "certificates/quadrature/guarantee.hpp"

#include <algorithm>

#include "analysis/quadrature/contraction/quadrature_certificate.hpp"
#include "certificates/quadrature/leak_words.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"
#include "certificates/quadrature/start_covariance.hpp"
#include "certificates/sets/assumptions.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::certificates {

using rigor::Interval;
using rigor::Verdict;

trackers::ToneModel<Interval> enclosed_at_unit_amplitude(const QuadratureEkfTables& tables) {
  const QuadratureDesignTable& chosen = tables.design;
  return trackers::at_unit_amplitude<Interval>(
      {chosen.q1.value, chosen.q2.value, chosen.r.value, chosen.epsilon.value},
      tables.assume.amplitude.value);
}

trackers::ToneModel<double> nearest_at_unit_amplitude(const QuadratureEkfTables& tables) {
  const QuadratureDesignTable& chosen = tables.design;
  return trackers::at_unit_amplitude<double>(
      {chosen.q1.nearest, chosen.q2.nearest, chosen.r.nearest, chosen.epsilon.nearest},
      tables.assume.amplitude.nearest);
}

sets::ContractionQuestion contraction_question(const Design& design) {
  const QuadratureEkfTables& tables = quadrature_tables(design);
  sets::ContractionQuestion question =
      contraction_question(enclosed_at_unit_amplitude(tables), tables.assume, tables.require);
  question.start_covariance = start_covariance(tables);
  for (const auto& end : tables.assume.frequency) {
    question.largest_frequency = std::max(question.largest_frequency, rigor::magnitude(end.value));
  }
  return question;
}

std::string start_covariance_words(const Certificate& certificate) {
  return covariance_words(quadrature_particulars(certificate).start_covariance,
                          certificate.contraction->starts.covariance_multiples);
}

void add_contraction(Certificate& certificate) {
  StartCovarianceText& covariance = quadrature_particulars(certificate).start_covariance;
  {
    const rigor::NearestRounding nearest;
    covariance = start_covariance_text(quadrature_tables(certificate.design));
  }
  const Requirements& require = quadrature_tables(certificate.design).require;
  const bool requires_limits = require.largest_noise_at_least || require.largest_slew_at_least ||
                               require.frequency_error_radius_at_least;
  if (quadrature_tables(certificate.design).design.without_leak()) {
    sets::ContractionQuestion question = contraction_question(certificate.design);
    if (!requires_limits && question.required.any()) {
      question.effort = certificate.extent == Extent::quick      ? sets::SearchEffort::quick
                        : certificate.extent == Extent::verdicts ? sets::SearchEffort::sufficient
                                                                 : sets::SearchEffort::everything;
      question.with_samples = question.effort == sets::SearchEffort::everything;
    }
    quadrature::ContractionCertificate found = quadrature::certify_contraction(question);
    certificate.derivations.push_back(std::move(found.derivation));
    certificate.contraction = std::move(found.result);
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
    sets::ContractionQuestion question = contraction_question(certificate.design);
    question.with_samples = certificate.extent == Extent::everything;
    question.with_limits = certificate.extent == Extent::everything || requires_limits;
    quadrature::LeakCertificate found = quadrature::certify_with_leak(
        {question, rigor::hull(assume.frequency[0].value, assume.frequency[1].value)});
    add_words(found);
    certificate.derivations.push_back(std::move(found.derivation));
    certificate.contraction = std::move(found.result);
  }
  add_start_covariance(covariance, certificate.contraction->starts.covariance_multiples,
                       certificate.derivations.back());
}

}  // namespace veritrack::certificates
