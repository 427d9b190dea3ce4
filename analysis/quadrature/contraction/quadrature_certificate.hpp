// The contraction certificate of the quadrature tracker without a leak (epsilon = 0): one certificate for
// every frequency, since without a leak the frequency does not enter the errors.
#pragma once

#include <optional>

#include "analysis/quadrature/contraction/verification.hpp"
#include "analysis/sets/contraction_question.hpp"
#include "analysis/sets/kalman_filter_result.hpp"
#include "analysis/statements/derivation.hpp"

namespace veritrack::quadrature {

/// The result. Each set is the best on a ladder of proposals that verified; it is evidence that
/// verify_certified_set can check again without a search.
struct ContractionCertificate {
  /// id "contraction"; the quantities of `result`: rate and radii are those of `set`, what is said of the
  /// assumed starts is from the set that promises most. Not proved:
  /// frequency_error_radius_sampled_limit, frequency_error_radius_share_of_limit,
  /// frequency_error_bound_tightness, ultimate_frequency_error_tightness; conditions leak,
  /// controllable-amplitude, invariant-set, start-in-set.
  theorems::Derivation derivation;
  sets::KalmanFilterResult result;
  std::optional<Verification> set;        ///< the largest start error under the assumed noise and slew
  std::optional<Verification> noise_set;  ///< the largest noise, without slew
  std::optional<Verification> slew_set;   ///< the largest slew, without noise
  std::optional<Verification>
      bound_set;  ///< the least bound on the frequency error from the assumed starts on
  std::optional<Verification> ultimate_set;  ///< the least ultimate frequency error
  std::optional<Verification> settling_set;  ///< the fastest to come within twice that
};

/// Proposes, verifies and reports. Never throws for invalid numbers: a number that is not finite proves
/// nothing. Opens its own UpwardRounding scope.
[[nodiscard]] ContractionCertificate certify_contraction(const sets::ContractionQuestion& asked);

}  // namespace veritrack::quadrature
