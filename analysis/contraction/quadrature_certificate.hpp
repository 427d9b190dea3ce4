// The contraction certificate of the quadrature tracker without a leak (epsilon = 0): one certificate for
// every frequency, since without a leak the frequency does not enter the errors.
#pragma once

#include <optional>

#include "analysis/contraction/verification.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/theorems/derivation.hpp"

namespace veritrack::contraction {

/// What is asked, for a signal of amplitude 1: design, noise and amplitudes relative to the true one
/// (trackers::at_unit_amplitude).
struct ContractionQuestion {
  trackers::QuadratureEkfDesign<rigor::Interval> design;
  rigor::Interval noise = rigor::Interval(0.0);  ///< |v(k)| <= noise
  rigor::Interval slew = rigor::Interval(0.0);   ///< |omega(k+1) - omega(k)| <= slew, rad/sample per sample
  rigor::Interval initial_amplitude_error = rigor::Interval(0.0);  ///< bounds on absolute values
  rigor::Interval initial_phase_error = rigor::Interval(0.0);      ///< rad
  rigor::Interval initial_frequency_error = rigor::Interval(0.0);  ///< rad/sample
  /// P(0|0) in the frame of the estimated phase; none: the filter's steady state.
  std::optional<rigor::IntervalMatrix<3>> initial_covariance;
  int search_evaluations = 40;  ///< per set
};

/// What was found. Each set is the largest on a ladder of proposals that verified; it is evidence that
/// verify_certified_set can check again without a search.
struct ContractionCertificate {
  /// id "contraction"; quantities contraction_rate, radius, frequency_error_radius, phase_error_radius,
  /// amplitude_error_radius, ultimate_frequency_error, frequency_error_bound, settling_samples,
  /// largest_noise, largest_slew; conditions leak, controllable-amplitude, invariant-set, start-in-set.
  theorems::Derivation derivation;
  std::optional<Verification> set;        ///< the largest start error under the assumed noise and slew
  std::optional<Verification> noise_set;  ///< the largest noise, without slew
  std::optional<Verification> slew_set;   ///< the largest slew, without noise
};

/// Proposes, verifies and reports. Never throws for odd numbers: what is not finite proves nothing. Opens its
/// own UpwardRounding scope.
[[nodiscard]] ContractionCertificate certify_contraction(const ContractionQuestion& question);

}  // namespace veritrack::contraction
