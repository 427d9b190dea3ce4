#include "certificates/sets/contraction.hpp"

#include <cmath>

namespace veritrack::certificates {

using rigor::Interval;

rigor::IntervalMatrix<3> covariance_at_unit_amplitude(const CovarianceArray& array, const Number& given) {
  const Interval& amplitude = given.value;
  rigor::IntervalMatrix<3> covariance;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const auto& entry = array[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].value;
      const Interval scale = (i < 2 ? amplitude : Interval(1.0)) * (j < 2 ? amplitude : Interval(1.0));
      covariance(i, j) = entry / scale;
    }
  }
  return covariance;
}

std::optional<rigor::IntervalMatrix<3>> covariance_at_unit_amplitude(const Assumptions& assume) {
  return assume.initial_covariance
             ? std::optional(covariance_at_unit_amplitude(*assume.initial_covariance, assume.amplitude))
             : std::nullopt;
}

sets::ContractionQuestion contraction_question(const trackers::ToneModel<Interval>& model,
                                               const Assumptions& assume, const Requirements& require) {
  const Interval& amplitude = assume.amplitude.value;
  sets::ContractionQuestion question;
  question.design = model;
  question.amplitude = amplitude;
  // A little more than is assumed, so that a checker with another arithmetic also finds it covered.
  const Interval margin = Interval::from_bounds(1.0, 1.0 + 0x1p-48);
  question.noise = assume.noise.value / amplitude * margin;
  question.slew = assume.slew.value * margin;
  question.initial_amplitude_error = assume.initial_amplitude_error.value / amplitude * margin;
  question.initial_phase_error = assume.initial_phase_error.value * margin;
  question.initial_frequency_error = assume.initial_frequency_error.value * margin;
  if (const auto given = covariance_at_unit_amplitude(assume)) {
    question.start_covariance = sets::StartCovariance{*given, Interval(1.0), true, std::nullopt, {}};
  }
  if (require.frequency_error_below) {
    question.required.frequency_error = require.frequency_error_below->value.lower();
  }
  if (require.settles_within) {
    question.required.samples = require.settles_within->value.lower();
  }
  if (require.settled_below) {
    question.settled_frequency_error = std::nextafter(require.settled_below->value.lower(), 0.0);
  }
  return question;
}

std::optional<Interval> proved_frequency_bound(const Certificate& certificate) {
  return certificate.contraction ? certificate.contraction->starts.proved_bound() : std::nullopt;
}

}  // namespace veritrack::certificates
