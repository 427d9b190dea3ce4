// The contraction certificate of the quadrature tracker with a leak (epsilon > 0): around its steady state,
// which depends on the frequency, over a band of frequencies. docs/leak.md.
#pragma once

#include <optional>

#include "analysis/quadrature/contraction/quadrature_certificate.hpp"
#include "analysis/quadrature/leak/steady_report.hpp"
#include "analysis/quadrature/leak/steady_verification.hpp"

namespace veritrack::quadrature {

/// The question, at amplitude 1.
struct LeakQuestion {
  sets::ContractionQuestion
      tracker;  ///< design, noise, slew and start, by default from near the steady state at the middle
  rigor::Interval band;  ///< true frequencies, rad/sample
};

struct LeakCertificate {
  /// id "contraction"; the quantities of `result`, about the steady state where they are radii and about the
  /// truth where they are bounds; conditions steady-state, invariant-set, and start-in-set, which is without
  /// words.
  theorems::Derivation derivation;
  sets::KalmanFilterResult result;
  std::optional<SteadyVerification> set;    ///< PROVED, or the last attempt
  std::optional<SteadyStartFinding> start;  ///< the reason of start-in-set, where a set is PROVED
  /// rad/sample; the lock branch ends there, inside the band, which is why nothing applies.
  std::optional<double> branch_ends_at;
};

/// Proposes, verifies and reports. Never throws for invalid numbers: a number that is not finite proves
/// nothing. Opens its own UpwardRounding scope.
[[nodiscard]] LeakCertificate certify_with_leak(const LeakQuestion& asked);

}  // namespace veritrack::quadrature
