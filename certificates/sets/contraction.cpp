#include "certificates/sets/contraction.hpp"

namespace veritrack::certificates {

using rigor::Interval;
using rigor::Verdict;

sets::ContractionQuestion contraction_question(const trackers::ToneModel<Interval>& model,
                                               const Assumptions& assume) {
  const Interval& amplitude = assume.amplitude.value;
  sets::ContractionQuestion question;
  question.design = model;
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

}  // namespace veritrack::certificates
