#include "certificates/sets/contraction.hpp"

namespace veritrack::certificates {

using rigor::Interval;

std::optional<rigor::IntervalMatrix<3>> covariance_at_unit_amplitude(const Assumptions& assume) {
  if (!assume.initial_covariance) {
    return std::nullopt;
  }
  const Interval& amplitude = assume.amplitude.value;
  rigor::IntervalMatrix<3> covariance;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const auto& entry =
          (*assume.initial_covariance)[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].value;
      const Interval scale = (i < 2 ? amplitude : Interval(1.0)) * (j < 2 ? amplitude : Interval(1.0));
      covariance(i, j) = entry / scale;
    }
  }
  return covariance;
}

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
  question.initial_covariance = covariance_at_unit_amplitude(assume);
  return question;
}

std::optional<Interval> proved_frequency_bound(const Certificate& certificate) {
  return certificate.contraction ? certificate.contraction->starts.proved_bound() : std::nullopt;
}

}  // namespace veritrack::certificates
